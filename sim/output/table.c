/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sink of `table:` outputs: comma-separated values as RFC 4180 has them, numbers with the fewest digits that give
 * the same double when read again. */
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/file.h"
#include "sim/base/number.h"
#include "sim/output/data_sinks.h"
#include "sim/output/sink_grid.h"
#include "sim/output/table.h"

/* ---- writing: failures are remembered by the FILE and found when it is closed ---- */

void bead_table_text(FILE *file, const char *text)
{
    if (!text[strcspn(text, ",\"\r\n")]) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

void bead_table_numbers(FILE *file, size_t count, const double *numbers)
{
    for (size_t i = 0; i < count; i++) {
        fputc(',', file);
        bead_write_number(file, numbers[i]);
    }
}

static bool several(const struct bead_sink *sink)
{
    return sink->context.chain_count > 1;
}

void bead_table_chain_name(const struct bead_sink *sink, size_t chain)
{
    if (!several(sink))
        return;
    bead_table_text(sink->file, bead_chain_name(sink->context.chains[chain]));
    fputc(',', sink->file);
}

/* ---- peaks of contacts or beads, at the end ---- */

static void peaks_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->contact_peaks = sink->output->curves.show == BEAD_SHOW_PEAKS;
    needs->bead_peaks = sink->output->curves.show == BEAD_SHOW_BEAD_PEAKS;
    needs->uncertainty = sink->output->curves.uncertainty;
    needs->deviation = bead_scene_tolerances(sink->context.scene);
    needs->until = INFINITY;
}

static void peaks_header(struct bead_sink *sink)
{
    fprintf(sink->file, "%s%s,peak_force_N,time_s,state%s%s\n", several(sink) ? "chain," : "",
            sink->output->curves.show == BEAD_SHOW_PEAKS ? "contact" : "bead",
            sink->output->curves.uncertainty ? ",uncertainty_N" : "",
            bead_scene_tolerances(sink->context.scene) ? ",deviation_N" : "");
}

/* The peaks of a chain, and what is known of them; NULL: is not, or nobody asked. */
struct listed {
    const struct bead_peak *peaks;
    const double *uncertainty, *deviation;
};

static void write_column(FILE *file, bool wanted, const double *numbers, size_t index)
{
    const double unknown = NAN;
    if (wanted)
        bead_table_numbers(file, 1, numbers ? &numbers[index] : &unknown);
}

static void write_peak(const struct bead_sink *sink, const struct listed *listed, size_t index)
{
    const struct bead_peak *peak = &listed->peaks[index];
    fprintf(sink->file, "%zu", index);
    bead_table_numbers(sink->file, 2, (const double[]){peak->value, peak->time});
    fprintf(sink->file, ",%s", peak->open ? "open" : "");
    write_column(sink->file, sink->output->curves.uncertainty, listed->uncertainty, index);
    write_column(sink->file, bead_scene_tolerances(sink->context.scene), listed->deviation, index);
    fputc('\n', sink->file);
}

static void peaks_end(struct bead_sink *sink, const struct bead_outcome *outcomes)
{
    const bool contacts = sink->output->curves.show == BEAD_SHOW_PEAKS;
    for (size_t c = 0; outcomes && c < sink->context.chain_count; c++) {
        const struct bead_chain *chain = sink->context.chains[c];
        const struct bead_outcome *o = &outcomes[c];
        const struct listed listed = contacts ? (struct listed){o->contact_peaks, o->contact_uncertainty, o->contact_deviation}
                                              : (struct listed){o->bead_peaks, o->bead_uncertainty, o->bead_deviation};
        size_t first = sink->output->shown.beads.first;
        size_t count = bead_span_rows(&sink->output->shown.beads, contacts ? bead_chain_contacts(chain) : bead_chain_beads(chain));
        for (size_t i = first; listed.peaks && i < first + count; i++) {
            bead_table_chain_name(sink, c);
            write_peak(sink, &listed, i);
            sink->rows++;
        }
    }
}

/* ---- sensors, sample by sample ---- */

char *bead_table_column(const struct bead_sink *sink, size_t chain, const char *sensor)
{
    char *name = NULL;
    const char *owner = several(sink) ? bead_chain_name(sink->context.chains[chain]) : "";
    return asprintf(&name, "%s%s%s", owner, *owner ? "/" : "", sensor) < 0 ? NULL : name;
}

static enum bead_error sensors_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    size_t count = 0, total = 0;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        bead_chain_sensors(sink->context.chains[c], &count);
        total += count;
    }
    if (total == 0)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: show: sensors, but no bead of the chain has a `sensor`",
                         sink->context.scene->file, sink->output->place.line, sink->output->place.column);
    sink->columns = calloc(total, sizeof *sink->columns);
    for (size_t c = 0; sink->columns && c < sink->context.chain_count; c++) {
        const struct bead_sensor *sensors = bead_chain_sensors(sink->context.chains[c], &count);
        for (size_t i = 0; i < count; i++) {
            char *name = bead_table_column(sink, c, sensors[i].name);
            if (!name)
                return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
            sink->columns[sink->column_count++] = (struct column){c, sensors[i].bead, name, 0};
        }
    }
    if (!sink->columns)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    char every[32];
    enum bead_error error = bead_sink_grid(sink->output, &sink->context, &sink->grid, msg);
    bead_time_text(sink->grid.every, bead_chain_time_unit(sink->context.chains[0]), every, sizeof every);
    snprintf(sink->why, sizeof sink->why, "%zu samples of %zu sensor%s, every %s", bead_grid_count(&sink->grid), total,
             total == 1 ? "" : "s", every);
    return error;
}

static void sensors_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_FORCE);
    needs->grid = sink->grid;
    needs->until = sink->grid.end;
    needs->beads = (struct bead_span){SIZE_MAX, 0};
    for (size_t i = 0; i < sink->column_count; i++) {
        size_t bead = sink->columns[i].bead;
        needs->beads.first = bead < needs->beads.first ? bead : needs->beads.first;
        needs->beads.last = bead > needs->beads.last ? bead : needs->beads.last;
    }
}

void bead_table_columns(struct bead_sink *sink, const char *time)
{
    fputs(time, sink->file);
    for (size_t i = 0; i < sink->column_count; i++) {
        fputc(',', sink->file);
        bead_table_text(sink->file, sink->columns[i].name);
    }
    fputc('\n', sink->file);
}

void bead_table_row(struct bead_sink *sink, double time)
{
    bead_write_number(sink->file, time);
    for (size_t i = 0; i < sink->column_count; i++)
        bead_table_numbers(sink->file, 1, &sink->columns[i].value);
    fputc('\n', sink->file);
    sink->rows++;
}

static void sensors_header(struct bead_sink *sink)
{
    bead_table_columns(sink, "time_s");
}

/* A row is written when the values of all chains are there, so that a stopped run leaves no incomplete row. */
static enum bead_error sensors_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)msg;
    for (size_t i = 0; i < sink->column_count; i++)
        if (sink->columns[i].chain == sample->chain)
            sink->columns[i].value = sample->field[BEAD_FIELD_FORCE][sink->columns[i].bead];
    if (sample->chain + 1 == sink->context.chain_count)
        bead_table_row(sink, sample->time);
    return BEAD_OK;
}

static const struct table sensors = {.why = "forces at the sensors",
                                     .prepare = sensors_prepare,
                                     .needs = sensors_needs,
                                     .header = sensors_header,
                                     .sample = sensors_sample},
                          peaks = {.why = "largest force of every contact",
                                   .needs = peaks_needs,
                                   .header = peaks_header,
                                   .end = peaks_end},
                          bead_peaks = {
                              .why = "largest force of every bead", .needs = peaks_needs, .header = peaks_header, .end = peaks_end};

static const struct table *const tables[] = {
    [BEAD_SHOW_SENSORS] = &sensors,
    [BEAD_SHOW_PEAKS] = &peaks,
    [BEAD_SHOW_BEAD_PEAKS] = &bead_peaks,
    [BEAD_SHOW_MEASURES] = &bead_table_measures,
    [BEAD_SHOW_MODES] = &bead_table_modes,
    [BEAD_SHOW_PROFILES] = &bead_table_profiles,
    [BEAD_SHOW_CHAIN] = &bead_table_chain,
    [BEAD_SHOW_ENERGY] = &bead_table_energy,
    [BEAD_SHOW_SENSITIVITIES] = &bead_table_sensitivities,
};

/* ---- the sink ---- */

static void table_destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    if (sink->file)
        fclose(sink->file);
    if (sink->open && !sink->finished)
        bead_file_discard(sink->part);
    if (sink->locale != (locale_t)0)
        freelocale(sink->locale);
    for (size_t i = 0; i < sink->column_count; i++)
        free(sink->columns[i].name);
    for (size_t i = 0; sink->measures && i < sink->context.chain_count; i++)
        bead_measures_destroy(sink->measures[i]);
    bead_profile_times_destroy(sink->moments);
    free(sink->measures);
    free(sink->columns);
    free(sink->path);
    free(sink->part);
    free(sink);
}

static enum bead_error table_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **made, struct bead_message *msg)
{
    *made = NULL;
    if ((size_t)output->curves.show >= sizeof tables / sizeof *tables || !tables[output->curves.show])
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "%s:%zu:%zu: show: not known to tables", context->scene->file,
                         output->place.line, output->place.column);
    struct bead_sink *sink = calloc(1, sizeof *sink);
    if (!sink)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    sink->context = *context;
    sink->output = output;
    sink->table = tables[output->curves.show];
    snprintf(sink->why, sizeof sink->why, "%s", sink->table->why);
    enum bead_error error = bead_file_join(context->directory, output->path, &sink->path, msg);
    if (!error)
        error = bead_file_part_name(sink->path, &sink->part, msg);
    if (!error && sink->table->prepare)
        error = sink->table->prepare(sink, msg);
    if (!error && (sink->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0)) == (locale_t)0)
        error = bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
    if (error)
        table_destroy(sink);
    else
        *made = sink;
    return error;
}

static void table_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.beads = {0, 0}, .why = sink->why};
    sink->table->needs(sink, needs);
}

static enum bead_error table_begin(struct bead_sink *sink, struct bead_range range, struct bead_message *msg)
{
    (void)range;
    enum bead_error error = sink->table->begin ? sink->table->begin(sink, msg) : BEAD_OK;
    if (!error)
        error = bead_file_create(sink->part, &sink->file, msg);
    if (error)
        return error;
    sink->open = true;
    sink->table->header(sink);
    return BEAD_OK;
}

static enum bead_error table_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    if (!sink->table->sample)
        return BEAD_OK;
    if (sample->chain != sink->next_chain || sample->index != sink->next_sample)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: sample %zu of chain %zu came out of order", sink->path, sample->index,
                         sample->chain);
    sink->next_chain = (sink->next_chain + 1) % sink->context.chain_count;
    sink->next_sample += sink->next_chain == 0;
    locale_t before = uselocale(sink->locale);
    enum bead_error error = sink->table->sample(sink, sample, msg);
    uselocale(before);
    if (error)
        return error;
    return ferror(sink->file) ? bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written", sink->part) : BEAD_OK;
}

static enum bead_error table_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    locale_t before = uselocale(sink->locale);
    if (sink->table->end)
        sink->table->end(sink, outcomes);
    uselocale(before);
    FILE *file = sink->file;
    sink->file = NULL;
    enum bead_error error = bead_file_close(file, sink->part, msg);
    if (error)
        return error;
    sink->finished = true; /* a failing commit removes the part itself */
    return bead_file_commit(sink->part, sink->path, msg);
}

static void table_result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = bead_file_bytes(sink->finished ? sink->path : sink->part);
    *items = sink->rows;
}

const struct bead_sink_type bead_table_sink = {
    .name = "table",
    .help = "peaks, forces at sensors, measures, energies, modes, profiles or the beads of chains, as comma-separated values",
    .kind = BEAD_OUTPUT_TABLE,
    .create = table_create,
    .needs = table_needs,
    .begin = table_begin,
    .sample = table_sample,
    .end = table_end,
    .destroy = table_destroy,
    .result = table_result,
};
