/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sink of `table:` outputs: comma-separated values as in RFC 4180, numbers with the fewest digits that read back as the same
 * double. */
#include <stdlib.h>

#include "sim/base/file.h"
#include "sim/base/memory.h"
#include "sim/measure/spectra.h"
#include "sim/output/table.h"

/* Word of `show` and `const struct table bead_table_NAME`. */
#define TABLES(TABLE)                                                                                                         \
    TABLE(SENSORS, sensors), TABLE(PEAKS, contact_peaks), TABLE(BEAD_PEAKS, bead_peaks), TABLE(MEASURES, measures),           \
        TABLE(MODES, modes), TABLE(PROFILES, profiles), TABLE(CHAIN, chain), TABLE(ENERGY, energy),                           \
        TABLE(SENSITIVITIES, sensitivities), TABLE(EXTREMES, extremes), TABLE(SPREADING, spreading), TABLE(BANDS, bands),     \
        TABLE(EIGENMODES, eigenmodes), TABLE(SPECTRUM, spectrum), TABLE(SPECTROGRAM, spectrogram), TABLE(TRANSFER, spectrum), \
        TABLE(DISPERSION, dispersion), TABLE(FIT, fit)

#define TABLE_NAME(SHOW, name) bead_table_##name
extern const struct table TABLES(TABLE_NAME);
#define TABLE_AT(SHOW, name) [BEAD_SHOW_##SHOW] = &bead_table_##name
static const struct table *const tables[] = {TABLES(TABLE_AT)};

static void table_destroy(struct bead_sink *sink)
{
    if (!sink)
        return;
    table_destroy(sink->check);
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
    bead_spectra_destroy(sink->spectra);
    free(sink->measures);
    free(sink->columns);
    free(sink->largest);
    free(sink->fronts);
    bead_table_spreading_free(sink);
    free(sink->path);
    free(sink->part);
    free(sink);
}

/* A table without a file. */
static enum bead_error create_table(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **made, struct bead_message *msg)
{
    BEAD_TRY(bead_new(made, 1, msg, "a table"));
    struct bead_sink *sink = *made;
    sink->context = *context;
    sink->output = output;
    sink->table = tables[output->curves.show];
    snprintf(sink->why, sizeof sink->why, "%s", sink->table->why);
    return sink->table->prepare ? sink->table->prepare(sink, msg) : BEAD_OK;
}

static enum bead_error table_create(const struct bead_output *output, const struct bead_run_context *context,
                                    struct bead_sink **made, struct bead_message *msg)
{
    struct bead_sink *sink;
    *made = NULL;
    if ((size_t)output->curves.show >= sizeof tables / sizeof *tables || !tables[output->curves.show])
        return bead_output_wrong(output, msg, "show: tables cannot show this");
    BEAD_TRY(create_table(output, context, made, msg));
    sink = *made;
    if (sink->table->checked && output->curves.uncertainty && !context->replayed)
        BEAD_TRY(create_table(output, context, &sink->check, msg));
    sink->bounds = sink->table->of_fields && output->curves.uncertainty ? context->bounds : NULL;
    BEAD_TRY(bead_file_join(context->directory, output->path, &sink->path, msg));
    BEAD_TRY(bead_file_part_name(sink->path, &sink->part, msg));
    sink->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    return sink->locale != (locale_t)0 ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "no memory for a table");
}

/* The number of the check run's samples for each of the run's. */
static size_t samples_each(const struct bead_sink *sink)
{
    return sink->check && sink->each > 0 ? sink->each : 1;
}

static void table_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.grid = sink->grid, .until = sink->grid.end, .beads = {0, 0}, .why = sink->why};
    if (sink->table->needs)
        sink->table->needs(sink, needs);
    needs->checked = sink->check != NULL;
    needs->each = samples_each(sink);
    needs->grid.every /= (double)needs->each;
}

static void write_header(struct bead_sink *sink)
{
    const struct table *table = sink->table;
    if (table->header) {
        table->header(sink);
        return;
    }
    bead_table_begin_header(sink, table->of_times);
    fprintf(sink->file, "%s%s\n", table->columns, bead_table_is_judged(sink) ? table->uncertainties : "");
}

static enum bead_error table_begin(struct bead_sink *sink, struct bead_range, struct bead_message *msg)
{
    if (sink->table->begin)
        BEAD_TRY(sink->table->begin(sink, msg));
    if (sink->check && sink->table->begin)
        BEAD_TRY(sink->table->begin(sink->check, msg));
    BEAD_TRY(bead_file_create(sink->part, &sink->file, msg));
    sink->open = true;
    write_header(sink);
    return BEAD_OK;
}

static enum bead_error table_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    if (!sink->table->sample)
        return BEAD_OK;
    if (sample->chain != sink->next_chain || sample->index != sink->next_sample)
        return bead_fail(msg, BEAD_ERROR_NUMBERS, "%s: sample %zu of chain %zu arrived out of order", sink->path, sample->index,
                         sample->chain);
    sink->next_chain = (sink->next_chain + 1) % sink->context.chain_count;
    sink->next_sample += sink->next_chain == 0;
    locale_t before = uselocale(sink->locale);
    enum bead_error error = sink->check && sample->check ? sink->table->sample(sink->check, sample->check, msg) : BEAD_OK;
    sink->unknown = sink->unknown || !sample->check;
    if (!error && sample->index % samples_each(sink) == 0)
        error = sink->table->sample(sink, sample, msg);
    uselocale(before);
    BEAD_TRY(error);
    return ferror(sink->file) ? bead_fail(msg, BEAD_ERROR_IO, "%s: cannot be written", sink->part) : BEAD_OK;
}

static enum bead_error table_end(struct bead_sink *sink, const struct bead_outcome *outcomes, struct bead_message *msg)
{
    locale_t before = uselocale(sink->locale);
    if (sink->table->end)
        sink->table->end(sink, outcomes);
    enum bead_error error = sink->table->finish ? sink->table->finish(sink, msg) : BEAD_OK;
    uselocale(before);
    BEAD_TRY(error);
    FILE *file = sink->file;
    sink->file = NULL;
    BEAD_TRY(bead_file_close(file, sink->part, msg));
    sink->finished = true; /* a failing commit removes the part itself */
    return bead_file_commit(sink->part, sink->path, msg);
}

static void table_result(const struct bead_sink *sink, uint64_t *bytes, uint64_t *items)
{
    *bytes = bead_file_bytes(sink->finished ? sink->path : sink->part);
    *items = sink->rows;
}

static double table_accuracy(const struct bead_output *output)
{
    return tables[output->curves.show]->accuracy;
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
    .accuracy = table_accuracy,
};
