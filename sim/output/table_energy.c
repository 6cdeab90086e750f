/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the energy budget: the energy in each form at each time, and the energy dissipated. */
#include "sim/output/table.h"

enum { PARTS = 8 };
static const char *const names[PARTS] = {"kinetic_J", "contacts_J",   "wall_J", "gravity_J",
                                         "springs_J", "dissipated_J", "work_J", "total_J"};

static enum bead_error energy_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    enum bead_error error = BEAD_OK;
    for (size_t i = 0; i < sink->context.chain_count * PARTS && !error; i++)
        error = bead_table_add_column(sink, i / PARTS, 0, names[i % PARTS], msg);
    return error ? error : bead_table_choose_times(sink, "the energy budget", msg);
}

static void energy_needs(const struct bead_sink *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    needs->budget = true;
}

static enum bead_error energy_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    const struct bead_budget *b = sample->budget;
    const double total = b->kinetic + b->contacts + b->wall + b->gravity + b->springs + b->dissipated - b->work,
                 part[PARTS] = {b->kinetic, b->contacts, b->wall, b->gravity, b->springs, b->dissipated, b->work, total};
    for (size_t i = 0; i < PARTS; i++)
        sink->columns[sample->chain * PARTS + i].value = part[i];
    bead_table_end_sample(sink, sample);
    return BEAD_OK;
}

/* The sum is constant to 1e-10 of the input. Runs may lose twice their accuracy of the energy before they shorten steps (drift_part
 * in run/run.c) and as much until they see it, and those with damping, which do not see it, up to four times: a tenth is asked for.
 */
const struct table bead_table_energy = {.accuracy = 1e-11,
                                        .why = "the energy budget",
                                        .prepare = energy_prepare,
                                        .needs = energy_needs,
                                        .header = bead_table_columns_header,
                                        .sample = energy_sample};
