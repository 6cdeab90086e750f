/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables with a row for each time. Of sensors: a row for each time, a column for the force on each bead with a sensor, or for the
 * places asked for. */
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/measure/energy_parts.h"
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

/* Tables of modes: a row for each time, a column for the energy of each mode. */

static enum bead_error modes_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    char text[40];
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t k = 1; k <= sink->output->curves.modes; k++) {
            snprintf(text, sizeof text, "mode_%zu", k);
            BEAD_TRY(bead_table_add_column(sink, c, 0, text, msg));
        }
    }
    snprintf(text, sizeof text, "energies of %zu modes", sink->output->curves.modes);
    return bead_table_choose_times(sink, text, msg);
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

/* Tables of the energy budget: the energy in each form, or at each place, at each time, and the energy dissipated. */

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
