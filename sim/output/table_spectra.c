/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spectra: a row for each frequency, with a column for each place; of a spectrogram a row for each time and frequency; of
 * a dispersion a row for each wave number and band, with the strongest line. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/output/spectra.h"
#include "sim/output/table.h"

static enum bead_error spectra_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    return bead_spectra_create(sink->output, &sink->context, &sink->spectra, msg);
}

static void spectra_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    *needs = bead_spectra_needs(sink->spectra);
}

static enum bead_error spectra_sample(struct bead_sink *sink, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_spectra_feed(sink->spectra, sample, msg);
}

static const char *frequency(const struct bead_sink *sink)
{
    return *bead_chain_time_unit(sink->context.chains[0]) ? "frequency_Hz" : "frequency";
}

/* Is a frequency one of those asked for? */
static bool is_shown(const struct bead_sink *sink, double frequency)
{
    const double *ends = sink->output->curves.frequencies;
    return !(frequency < ends[0]) && !(frequency > ends[1]);
}

/* ---- spectrum, transfer ---- */

static enum bead_error spectrum_prepare(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_TRY(spectra_prepare(sink, msg));
    return bead_table_place_columns(sink, msg);
}

static void spectrum_header(struct bead_sink *sink)
{
    fputs(frequency(sink), sink->file);
    for (size_t i = 0; i < sink->column_count; i++) {
        fputc(',', sink->file);
        bead_table_text(sink->file, sink->columns[i].name);
    }
    fputc('\n', sink->file);
}

/* Is there a number? Where nothing is driven, there is no transfer. */
static bool has_row(const struct bead_sink *sink, const struct bead_spectral *found, size_t k)
{
    bool has = false;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t p = 0; p < found[c].columns; p++)
            has = has || !isnan(found[c].values[p * found[c].rows + k]);
    }
    return has;
}

/* All chains are sampled alike. */
static void write_spectrum(struct bead_sink *sink, const struct bead_spectral *found)
{
    const struct bead_spectral *first = found;
    while (first->columns == 0)
        first++;
    for (size_t k = 0; k < first->rows; k++) {
        if (!is_shown(sink, (double)k * first->step) || !has_row(sink, found, k))
            continue;
        bead_write_number(sink->file, (double)k * first->step);
        for (size_t c = 0; c < sink->context.chain_count; c++) {
            for (size_t p = 0; p < found[c].columns; p++)
                bead_table_numbers(sink->file, 1, &found[c].values[p * found[c].rows + k]);
        }
        bead_table_end_row(sink);
    }
}

static enum bead_error spectrum_finish(struct bead_sink *sink, struct bead_message *msg)
{
    BEAD_FREED struct bead_spectral *found = NULL;
    BEAD_TRY(bead_new(&found, sink->context.chain_count, msg, "spectra"));
    enum bead_error err = BEAD_OK;
    for (size_t c = 0; c < sink->context.chain_count && !err; c++)
        err = bead_spectra_of(sink->spectra, c, &found[c], msg);
    if (!err)
        write_spectrum(sink, found);
    for (size_t c = 0; c < sink->context.chain_count; c++)
        free(found[c].values);
    return err;
}

const struct table bead_table_spectrum = {.why = "spectra",
                                          .prepare = spectrum_prepare,
                                          .needs = spectra_needs,
                                          .header = spectrum_header,
                                          .sample = spectra_sample,
                                          .finish = spectrum_finish};

/* ---- blocks of chains ---- */

static enum bead_error each_chain(struct bead_sink *sink, void (*write)(struct bead_sink *, size_t, const struct bead_spectral *),
                                  struct bead_message *msg)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        struct bead_spectral found;
        enum bead_error err = bead_spectra_of(sink->spectra, c, &found, msg);
        if (!err && found.columns > 0)
            write(sink, c, &found);
        free(found.values);
        BEAD_TRY(err);
    }
    return BEAD_OK;
}

static void spectrogram_header(struct bead_sink *sink)
{
    fputs(sink->context.chain_count > 1 ? "chain," : "", sink->file);
    bead_table_time_header(sink);
    fprintf(sink->file, ",%s,amplitude\n", frequency(sink));
}

static void write_spectrogram(struct bead_sink *sink, size_t chain, const struct bead_spectral *found)
{
    for (size_t i = 0; i < found->columns * found->rows; i++) {
        const double at = (double)(i % found->rows) * found->step;
        if (!is_shown(sink, at))
            continue;
        bead_table_chain_name(sink, chain);
        bead_write_number(sink->file, found->first + (double)(i / found->rows) * found->between);
        bead_table_numbers(sink->file, 2, (const double[]){at, found->values[i]});
        bead_table_end_row(sink);
    }
}

static enum bead_error spectrogram_finish(struct bead_sink *sink, struct bead_message *msg)
{
    return each_chain(sink, write_spectrogram, msg);
}

const struct table bead_table_spectrogram = {.why = "spectra over time",
                                             .prepare = spectra_prepare,
                                             .needs = spectra_needs,
                                             .header = spectrogram_header,
                                             .sample = spectra_sample,
                                             .finish = spectrogram_finish};

static void dispersion_header(struct bead_sink *sink)
{
    fprintf(sink->file, "%swave_number_cell_pi,band,exact_Hz,found_Hz,amplitude\n", sink->context.chain_count > 1 ? "chain," : "");
}

static void write_dispersion(struct bead_sink *sink, size_t chain, const struct bead_spectral *found)
{
    const struct bead_medium *medium = bead_spectra_medium(sink->spectra, chain);
    const size_t bands = medium ? medium->cell.count : 1;
    for (size_t i = 0; i < found->columns * bands; i++) {
        const struct bead_spectral_line line = bead_spectral_line(found, medium, i / bands, i % bands);
        if (!is_shown(sink, line.found))
            continue;
        bead_table_chain_name(sink, chain);
        bead_write_number(sink->file, found->first + (double)(i / bands) * found->between);
        fprintf(sink->file, ",%zu", i % bands + 1);
        bead_table_numbers(sink->file, 3, (const double[]){line.exact, line.found, line.amplitude});
        bead_table_end_row(sink);
    }
}

static enum bead_error dispersion_finish(struct bead_sink *sink, struct bead_message *msg)
{
    return each_chain(sink, write_dispersion, msg);
}

const struct table bead_table_dispersion = {.why = "amplitudes over wave number and frequency",
                                            .prepare = spectra_prepare,
                                            .needs = spectra_needs,
                                            .header = dispersion_header,
                                            .sample = spectra_sample,
                                            .finish = dispersion_finish};
