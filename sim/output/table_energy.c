/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the energy budget: the energy in each form, or at each place, at each time, and the energy dissipated. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/measure/energy_parts.h"
#include "sim/output/table.h"

static enum bead_error energy_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    const size_t parts = bead_energy_parts_count(sink->output);
    char name[48];
    BEAD_TRY(bead_new(&sink->fronts, sink->context.chain_count, msg, "a table"));
    for (size_t i = 0; i < sink->context.chain_count * parts; i++) {
        bead_energy_part_name(sink->output, i % parts, name);
        for (char *c = name; *c; c++)
            *c = *c == ' ' ? '_' : *c;
        strcat(name, "_J");
        BEAD_TRY(bead_table_add_column(sink, i / parts, 0, name, msg));
    }
    return bead_table_choose_times(sink, "the energy budget", msg);
}

static void energy_needs(const struct bead_sink *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    needs->budget = true;
}

static enum bead_error energy_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    const size_t parts = bead_energy_parts_count(sink->output);
    BEAD_FREED double *part = NULL;
    BEAD_TRY(bead_new(&part, parts, msg, "a table"));
    bead_energy_parts_find(sink->output, sink->context.chains[sample->chain], sample, &sink->fronts[sample->chain], part);
    for (size_t i = 0; i < parts; i++)
        sink->columns[sample->chain * parts + i].value = part[i];
    bead_table_end_sample(sink, sample);
    return BEAD_OK;
}

/* The sum is constant to 1e-10 of the input. Runs may lose twice their accuracy of the energy before they shorten steps (drift_part
 * in run/run.c), as much again until they notice, and with damping, where they do not, up to four times: a tenth is asked for. */
const struct table bead_table_energy = {.accuracy = 1e-11,
                                        .why = "the energy budget",
                                        .prepare = energy_prepare,
                                        .needs = energy_needs,
                                        .header = bead_table_columns_header,
                                        .checked = true,
                                        .sample = energy_sample};
