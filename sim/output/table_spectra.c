/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of spectra: a row for each frequency, with a column for each place; of a spectrogram a row for each time and frequency; of
 * a dispersion a row for each wave number and band, with the strongest line. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/number.h"
#include "sim/measure/spectra.h"
#include "sim/output/table.h"
#include "sim/run/uncertainty.h"

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

/* Spectra of a chain and of its check run, if there is one; if it ended early, the run's spectra again, which are not read. */
static enum bead_error spectra_of_both(const struct bead_sink *sink, size_t chain, struct bead_spectral *found,
                                       struct bead_spectral *check, struct bead_message *msg)
{
    *check = (struct bead_spectral){.values = NULL};
    BEAD_TRY(bead_spectra_of(sink->spectra, chain, found, msg));
    return sink->check ? bead_spectra_of(sink->unknown ? sink->spectra : sink->check->spectra, chain, check, msg) : BEAD_OK;
}

static const char *frequency(const struct bead_sink *sink)
{
    return *bead_chain_time_unit(sink->context.chains[0]) ? "frequency_Hz" : "frequency";
}

/* Is the frequency asked for? */
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
    bead_table_uncertainties_header(sink);
    fputc('\n', sink->file);
}

/* Is there a number? There is no transfer at frequencies without drive. */
static bool has_row(const struct bead_sink *sink, const struct bead_spectral *found, size_t k)
{
    bool has = false;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t p = 0; p < found[c].columns; p++)
            has = has || !isnan(found[c].values[p * found[c].rows + k]);
    }
    return has;
}

/* The uncertainties of the columns, in their order. */
static void find_uncertainties(struct bead_sink *sink, const struct bead_spectral *found, const struct bead_spectral *checks)
{
    struct column *column = sink->columns;
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t p = 0; p < found[c].columns; p++, column++) {
            const size_t first = p * found[c].rows;
            column->uncertainty =
                sink->check ? bead_table_worst(sink, &found[c].values[first], &checks[c].values[first], found[c].rows) : NAN;
        }
    }
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
        for (size_t i = 0; bead_table_is_judged(sink) && i < sink->column_count; i++)
            bead_table_uncertainties(sink->file, 1, &sink->columns[i].uncertainty);
        bead_table_end_row(sink);
    }
}

static enum bead_error spectrum_finish(struct bead_sink *sink, struct bead_message *msg)
{
    const size_t chains = sink->context.chain_count;
    BEAD_FREED struct bead_spectral *found = NULL; /* of all chains, then of their check runs */
    BEAD_TRY(bead_new(&found, 2 * chains, msg, "spectra"));
    enum bead_error err = BEAD_OK;
    for (size_t c = 0; c < chains && !err; c++)
        err = spectra_of_both(sink, c, &found[c], &found[chains + c], msg);
    if (!err)
        find_uncertainties(sink, found, found + chains);
    if (!err)
        write_spectrum(sink, found);
    for (size_t c = 0; c < 2 * chains; c++)
        free(found[c].values);
    return err;
}

const struct table bead_table_spectrum = {.why = "spectra",
                                          .prepare = spectrum_prepare,
                                          .needs = spectra_needs,
                                          .header = spectrum_header,
                                          .sample = spectra_sample,
                                          .checked = true,
                                          .finish = spectrum_finish};

/* ---- blocks of chains ---- */

typedef void write_chain(struct bead_sink *sink, size_t chain, const struct bead_spectral *found,
                         const struct bead_spectral *check);

static enum bead_error each_chain(struct bead_sink *sink, write_chain *write, struct bead_message *msg)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        struct bead_spectral found = {.values = NULL}, check;
        enum bead_error err = spectra_of_both(sink, c, &found, &check, msg);
        if (!err && found.columns > 0)
            write(sink, c, &found, &check);
        free(found.values);
        free(check.values);
        BEAD_TRY(err);
    }
    return BEAD_OK;
}

static void spectrogram_header(struct bead_sink *sink)
{
    bead_table_begin_header(sink, true);
    fprintf(sink->file, "%s,amplitude%s\n", frequency(sink), bead_table_is_judged(sink) ? ",uncertainty" : "");
}

/* With a check run, the uncertainty is the largest of all segments so far. */
static void write_spectrogram(struct bead_sink *sink, size_t chain, const struct bead_spectral *found,
                              const struct bead_spectral *check)
{
    double largest = 0;
    for (size_t i = 0; i < found->columns * found->rows; i++) {
        const double at = (double)(i % found->rows) * found->step;
        if (sink->check && i % found->rows == 0)
            largest = fmax(largest, bead_table_worst(sink, &found->values[i], &check->values[i], found->rows));
        if (!is_shown(sink, at))
            continue;
        bead_table_chain_name(sink, chain);
        bead_write_number(sink->file, found->first + (double)(i / found->rows) * found->between);
        bead_table_numbers(sink->file, 2, (const double[]){at, found->values[i]});
        if (bead_table_is_judged(sink))
            bead_table_uncertainties(sink->file, 1, (const double[]){sink->unknown ? NAN : largest});
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
                                             .checked = true,
                                             .finish = spectrogram_finish};

/* The uncertainty of the worst amplitude of all lines. */
static double worst_line(const struct bead_sink *sink, const struct bead_spectral *found, const struct bead_spectral *check,
                         const struct bead_medium *medium, size_t bands)
{
    double worst = NAN;
    for (size_t i = 0; sink->check && i < found->columns * bands; i++) {
        const double amplitude = bead_spectral_line(found, medium, i / bands, i % bands).amplitude;
        const double other = bead_spectral_line(check, medium, i / bands, i % bands).amplitude;
        worst = fmax(worst, bead_table_worst(sink, &amplitude, &other, 1));
    }
    return worst;
}

static void write_dispersion(struct bead_sink *sink, size_t chain, const struct bead_spectral *found,
                             const struct bead_spectral *check)
{
    const struct bead_medium *medium = bead_spectra_medium(sink->spectra, chain);
    const size_t bands = medium ? medium->cell.count : 1;
    const double worst = worst_line(sink, found, check, medium, bands);
    for (size_t i = 0; i < found->columns * bands; i++) {
        const struct bead_spectral_line line = bead_spectral_line(found, medium, i / bands, i % bands);
        if (!is_shown(sink, line.found))
            continue;
        const double other = sink->check && !sink->unknown ? bead_spectral_line(check, medium, i / bands, i % bands).found : NAN;
        bead_table_chain_name(sink, chain);
        bead_write_number(sink->file, found->first + (double)(i / bands) * found->between);
        fprintf(sink->file, ",%zu", i % bands + 1);
        bead_table_numbers(sink->file, 3, (const double[]){line.exact, line.found, line.amplitude});
        if (bead_table_is_judged(sink))
            bead_table_uncertainties(sink->file, 2, (const double[]){worst, bead_uncertainty_measured(0, line.found, other)});
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
                                            .columns = "wave_number_cell_pi,band,exact_Hz,found_Hz,amplitude",
                                            .uncertainties = ",uncertainty,found_Hz_uncertainty",
                                            .sample = spectra_sample,
                                            .checked = true,
                                            .finish = dispersion_finish};
