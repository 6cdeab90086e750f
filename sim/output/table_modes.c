/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of modes: a row for each time, a column for the energy of each mode. */
#include <math.h>
#include <stdlib.h>

#include "sim/output/sink_grid.h"
#include "sim/output/table.h"

static enum bead_error modes_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    size_t chains = sink->context.chain_count, modes = sink->output->curves.modes;
    char every[32], word[32];
    sink->columns = calloc(chains * modes, sizeof *sink->columns);
    for (size_t i = 0; sink->columns && i < chains * modes; i++) {
        snprintf(word, sizeof word, "mode_%zu", i % modes + 1);
        char *name = bead_table_column(sink, i / modes, word);
        if (!name)
            return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
        sink->columns[sink->column_count++] = (struct column){i / modes, 0, name, 0};
    }
    if (!sink->columns)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    enum bead_error err = bead_sink_grid(sink->output, &sink->context, &sink->grid, msg);
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    snprintf(sink->why, sizeof sink->why, "energies of %zu modes, %zu times every %s", modes, bead_grid_count(&sink->grid), every);
    return err;
}

static void modes_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    for (size_t c = 0; c < sink->context.chain_count; c++)
        needs->fields |= bead_chain_mode_fields(sink->context.chains[c]);
    needs->grid = sink->grid;
    needs->until = sink->grid.end;
    needs->beads = (struct bead_span){0, SIZE_MAX};
}

static void modes_header(struct bead_sink *sink)
{
    bead_table_columns(sink, "time");
}

static enum bead_error modes_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    double energy[BEAD_MODES];
    size_t modes = sink->output->curves.modes;
    (void)msg;
    bead_chain_mode_energies(sink->context.chains[sample->chain], sample->field, modes, energy);
    for (size_t k = 0; k < modes; k++)
        sink->columns[sample->chain * modes + k].value = energy[k];
    if (sample->chain + 1 == sink->context.chain_count)
        bead_table_row(sink, sample->time);
    return BEAD_OK;
}

const struct table bead_table_modes = {
    .why = "energies of modes", .prepare = modes_prepare, .needs = modes_needs, .header = modes_header, .sample = modes_sample};
