/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of sensors: a row for each time, a column for the force on each bead with a sensor. */
#include "sim/output/table.h"

static enum bead_error sensors_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    enum bead_error error = BEAD_OK;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        size_t count = 0;
        const struct bead_sensor *sensors = bead_chain_sensors(sink->context.chains[c], &count);
        for (size_t i = 0; i < count && !error; i++)
            error = bead_table_add_column(sink, c, sensors[i].bead, sensors[i].name, msg);
    }
    if (error)
        return error;
    if (sink->column_count == 0)
        return bead_output_wrong(sink->output, msg, "show: sensors, but no bead of the chain has a `sensor`");
    char what[40];
    snprintf(what, sizeof what, "%zu sensor%s", sink->column_count, sink->column_count == 1 ? "" : "s");
    return bead_table_choose_times(sink, what, msg);
}

static void sensors_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
    needs->beads = (struct bead_span){SIZE_MAX, 0};
    for (size_t i = 0; i < sink->column_count; i++) {
        size_t bead = sink->columns[i].bead;
        needs->beads.first = bead < needs->beads.first ? bead : needs->beads.first;
        needs->beads.last = bead > needs->beads.last ? bead : needs->beads.last;
    }
}

static enum bead_error sensors_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    for (size_t i = 0; i < sink->column_count; i++)
        if (sink->columns[i].chain == sample->chain)
            sink->columns[i].value = sample->field[BEAD_FIELD_FORCE][sink->columns[i].bead];
    bead_table_end_sample(sink, sample);
    return BEAD_OK;
}

const struct table bead_table_sensors = {.why = "forces at the sensors",
                                         .prepare = sensors_prepare,
                                         .needs = sensors_needs,
                                         .header = bead_table_columns_header,
                                         .sample = sensors_sample};
