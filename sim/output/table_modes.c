/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of modes: a row for each time, a column for the energy of each mode. */
#include "sim/chain/chain_internal.h"
#include "sim/output/table.h"

static enum bead_error modes_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    char text[40];
    enum bead_error error = BEAD_OK;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t k = 1; k <= sink->output->curves.modes && !error; k++) {
            snprintf(text, sizeof text, "mode_%zu", k);
            error = bead_table_add_column(sink, c, 0, text, msg);
        }
    }
    snprintf(text, sizeof text, "energies of %zu modes", sink->output->curves.modes);
    return error ? error : bead_table_choose_times(sink, text, msg);
}

static void modes_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    for (size_t c = 0; c < sink->context.chain_count; c++)
        needs->fields |= bead_chain_mode_fields(sink->context.chains[c]);
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

static enum bead_error modes_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    double energy[BEAD_MODES];
    size_t modes = sink->output->curves.modes;
    bead_chain_mode_energies(sink->context.chains[sample->chain], sample->field, modes, energy);
    for (size_t k = 0; k < modes; k++)
        sink->columns[sample->chain * modes + k].value = energy[k];
    bead_table_end_sample(sink, sample);
    return BEAD_OK;
}

const struct table bead_table_modes = {.why = "energies of modes",
                                       .prepare = modes_prepare,
                                       .needs = modes_needs,
                                       .header = bead_table_columns_header,
                                       .checked = true,
                                       .sample = modes_sample};
