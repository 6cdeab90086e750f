/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of sensors: a row for each time, a column for the force on each bead with a sensor, or for the places asked for. */
#include "sim/measure/places.h"
#include "sim/output/table.h"

void bead_table_place_name(const struct bead_place_shown *place, bool listed, char *name, size_t size)
{
    const bool force = place->field == BEAD_FIELD_FORCE || place->field == BEAD_FIELD_CONTACT_FORCE;
    snprintf(name, size, "%s%s%s", place->name, force ? "" : "_", force ? "" : bead_field_info(place->field)->name);
    for (char *c = name; listed && *c; c++)
        *c = *c == ' ' ? '_' : *c;
}

enum bead_error bead_table_place_columns(struct bead_sink *sink, struct bead_message *msg)
{
    const struct bead_curves_asked *curves = &sink->output->curves;
    char name[160];
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        const size_t count = bead_places_count(sink->output, sink->context.chains[c]);
        for (size_t i = 0; i < count; i++) {
            const struct bead_place_shown place = bead_place_shown(sink->output, sink->context.chains[c], i);
            bead_table_place_name(&place, curves->beads.all || curves->contacts.all, name, sizeof name);
            BEAD_TRY(bead_table_add_column(sink, c, place.index, name, msg));
            sink->columns[sink->column_count - 1].field = place.field;
        }
    }
    return BEAD_OK;
}

static enum bead_error sensors_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    const struct bead_curves_asked *curves = &sink->output->curves;
    const bool listed = curves->beads.all || curves->contacts.all;
    BEAD_TRY(bead_table_place_columns(sink, msg));
    if (sink->column_count == 0)
        return bead_output_wrong(sink->output, msg, "show: sensors, but no bead of the chain has a `sensor`");
    char what[40];
    snprintf(what, sizeof what, "%zu %s%s", sink->column_count, listed ? "place" : "sensor", sink->column_count == 1 ? "" : "s");
    return bead_table_choose_times(sink, what, msg);
}

static void sensors_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->beads = (struct bead_span){SIZE_MAX, 0};
    for (size_t c = 0; c < sink->context.chain_count; c++)
        bead_places_need(sink->output, sink->context.chains[c], needs);
}

static enum bead_error sensors_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *)
{
    for (size_t i = 0; i < sink->column_count; i++) {
        struct column *column = &sink->columns[i];
        if (column->chain == sample->chain)
            column->value = sample->field[column->field][column->bead];
    }
    bead_table_end_sample(sink, sample);
    return BEAD_OK;
}

const struct table bead_table_sensors = {.why = "curves of sensors, or of the beads and contacts listed",
                                         .prepare = sensors_prepare,
                                         .needs = sensors_needs,
                                         .header = bead_table_columns_header,
                                         .checked = true,
                                         .of_fields = true,
                                         .sample = sensors_sample};
