/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the energy budget: where the energy is at each time, and what has left. */
#include <stdlib.h>

#include "sim/output/sink_grid.h"
#include "sim/output/table.h"

enum { PARTS = 6 };
static const char *const names[PARTS] = {"kinetic_J", "contacts_J", "wall_J", "gravity_J", "dissipated_J", "total_J"};

static enum bead_error energy_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    const size_t chains = sink->context.chain_count;
    char every[32];
    sink->columns = calloc(chains * PARTS, sizeof *sink->columns);
    for (size_t i = 0; sink->columns && i < chains * PARTS; i++) {
        char *name = bead_table_column(sink, i / PARTS, names[i % PARTS]);
        if (!name)
            return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
        sink->columns[sink->column_count++] = (struct column){i / PARTS, 0, name, 0};
    }
    if (!sink->columns)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    enum bead_error err = bead_sink_grid(sink->output, &sink->context, &sink->grid, msg);
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    snprintf(sink->why, sizeof sink->why, "the energy budget at %zu times every %s", bead_grid_count(&sink->grid), every);
    return err;
}

static void energy_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    needs->grid = sink->grid;
    needs->until = sink->grid.end;
    needs->budget = true;
}

static void energy_header(struct bead_sink *sink)
{
    bead_table_columns(sink, "time_s");
}

static enum bead_error energy_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    const struct bead_budget *b = sample->budget;
    (void)msg;
    const double total = b->kinetic + b->contacts + b->wall + b->gravity + b->dissipated,
                 part[PARTS] = {b->kinetic, b->contacts, b->wall, b->gravity, b->dissipated, total};
    for (size_t i = 0; i < PARTS; i++)
        sink->columns[sample->chain * PARTS + i].value = part[i];
    if (sample->chain + 1 == sink->context.chain_count)
        bead_table_row(sink, sample->time);
    return BEAD_OK;
}

const struct table bead_table_energy = {
    .why = "the energy budget", .prepare = energy_prepare, .needs = energy_needs, .header = energy_header, .sample = energy_sample};
