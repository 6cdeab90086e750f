/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collects curves of the chains of a sweep and takes their means: see sweep_lines.h. */
#include "sim/sweep/sweep_lines.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/places.h"
#include "sim/measure/sink_grid.h"
#include "sim/run/method_choice.h"
#include "sim/run/run_kinds.h"
#include "sim/run/uncertainty.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

struct bead_sweep_line_chain {
    struct bead_sweep_chain *made;
    const struct bead_chain *chain;
    struct bead_spectra *spectra, *check; /* of its run; of a finer one (NULL: none) */
    struct bead_spectral found, finer;
    size_t curve;
};

void bead_sweep_lines_free(struct bead_sweep_lines *lines)
{
    for (size_t i = 0; lines->chains && i < lines->chain_count; i++) {
        bead_spectra_destroy(lines->chains[i].spectra);
        bead_spectra_destroy(lines->chains[i].check);
        bead_sweep_chain_destroy(lines->chains[i].made);
        free(lines->chains[i].found.values);
        free(lines->chains[i].finer.values);
    }
    for (size_t i = 0; lines->of && i < lines->count; i++) {
        free(lines->of[i].mean.values);
        free(lines->of[i].error);
        free(lines->of[i].uncertainty);
        free(lines->of[i].of_frequency);
    }
    free(lines->chains);
    free(lines->of);
}

/* All chains run to the same time: `until`, or the last arrival of a front. */
static enum bead_error find_end(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, size_t count,
                                double *end, struct bead_message *msg)
{
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    *end = bead_sweep_scene(sweep)->simulate.until;
    if (!isnan(*end))
        return BEAD_OK;
    BEAD_TRY(bead_new(&watches, count, msg, "the curves of %zu chains", count));
    for (size_t i = 0; i < count; i++)
        watches[i] = (struct bead_sweep_watch){.index = i};
    BEAD_TRY(bead_sweep_watch(sweep, watches, count, settings, msg));
    *end = 0;
    for (size_t i = 0; i < count; i++)
        *end = fmax(*end, watches[i].arrival);
    return BEAD_OK;
}

static struct bead_run_context context_of(const struct bead_sweep *sweep, const struct bead_sweep_line_chain *own, double end)
{
    return (struct bead_run_context){
        .scene = bead_sweep_scene(sweep), .chains = &own->chain, .chain_count = 1, .end = end, .threads = 1, .directory = "."};
}

/* Makes a chain; *every: the time between samples that it needs. */
static enum bead_error make_chain(const struct bead_sweep *sweep, const struct bead_output *output, size_t index, double end,
                                  struct bead_sweep_line_chain *own, double *every, struct bead_message *msg)
{
    struct bead_pace pace = {.resolution = 0};
    BEAD_TRY(bead_sweep_chain_create(sweep, 0, index, &own->made, msg));
    own->chain = bead_sweep_chain_of(own->made);
    own->curve = bead_sweep_curve_of(sweep, 0, index, SIZE_MAX);
    BEAD_TRY(bead_places_check(output, own->chain, msg));
    BEAD_TRY(bead_run_kind_of(own->chain)->pace(own->chain, &bead_sweep_scene(sweep)->simulate, 1, &pace, msg));
    struct bead_run_context context = context_of(sweep, own, end);
    context.resolution = pace.resolution;
    BEAD_TRY(bead_spectra_create(output, &context, &own->spectra, msg));
    *every = bead_spectra_needs(own->spectra).grid.every;
    bead_spectra_destroy(own->spectra);
    own->spectra = NULL;
    return BEAD_OK;
}

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *msg)
{
    return bead_spectra_feed(context, sample, msg);
}

/* Prepares a run of a chain, whose samples are collected in *spectra, for all chains as often as the quickest needs. */
static enum bead_error watch_chain(const struct bead_sweep *sweep, const struct bead_sweep_lines *lines, size_t index, double end,
                                   double every, struct bead_spectra **spectra, struct bead_sweep_watch *watch,
                                   struct bead_message *msg)
{
    struct bead_run_context context = context_of(sweep, &lines->chains[index], end);
    context.native = (struct bead_grid){0, every, end, false};
    BEAD_TRY(bead_spectra_create(&lines->output, &context, spectra, msg));
    *watch = (struct bead_sweep_watch){.index = index,
                                       .end = end,
                                       .fields = bead_spectra_needs(*spectra).fields,
                                       .every = every,
                                       .finer = spectra == &lines->chains[index].check,
                                       .take = take,
                                       .context = *spectra};
    return BEAD_OK;
}

/* Runs all chains and, to check them, a sample of each curve's again, and long ones, whose errors differ more. */
static enum bead_error run_all(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, bool checked, double end,
                               double every, struct bead_sweep_lines *lines, struct bead_message *msg)
{
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    BEAD_FREED size_t *met = NULL;
    size_t count = 0;
    BEAD_TRY(bead_new(&watches, 2 * lines->chain_count, msg, "the curves of %zu chains", lines->chain_count));
    BEAD_TRY(bead_new(&met, lines->count, msg, "the curves of %zu chains", lines->chain_count));
    for (size_t i = 0; i < lines->chain_count; i++)
        BEAD_TRY(watch_chain(sweep, lines, i, end, every, &lines->chains[i].spectra, &watches[count++], msg));
    for (size_t i = 0; checked && i < lines->chain_count; i++) {
        struct bead_sweep_line_chain *own = &lines->chains[i];
        if (met[own->curve]++ % bead_sample_every(lines->of[own->curve].chains) == 0 || bead_is_long(own->chain))
            BEAD_TRY(watch_chain(sweep, lines, i, end, every, &own->check, &watches[count++], msg));
    }
    return bead_sweep_watch(sweep, watches, count, settings, msg);
}

/* ---- means ---- */

/* The mean over a curve's chains, in their order, of the numbers that exist: a transfer has none where the drive is small. */
static enum bead_error reduce(const struct bead_sweep_lines *lines, size_t curve, double *values, struct bead_message *msg)
{
    struct bead_sweep_line *line = &lines->of[curve];
    const size_t numbers = line->mean.columns * line->mean.rows;
    BEAD_TRY(bead_new(&line->mean.values, numbers + 1, msg, "the mean of %zu chains", line->chains));
    BEAD_TRY(bead_new(&line->error, numbers + 1, msg, "the mean of %zu chains", line->chains));
    for (size_t i = 0; i < numbers; i++) {
        struct bead_summary summary = {.mean = NAN, .standard_error = NAN};
        size_t used = 0;
        for (size_t c = 0; c < lines->chain_count; c++) {
            const struct bead_sweep_line_chain *own = &lines->chains[c];
            if (own->curve == curve && isfinite(own->found.values[i]))
                values[used++] = own->found.values[i];
        }
        if (used > 0)
            bead_summary_of(values, used, &summary);
        line->mean.values[i] = summary.mean;
        line->error[i] = used > 1 ? summary.standard_error : NAN;
    }
    return BEAD_OK;
}

/* The uncertainty of a mean over `all` chains whose differences are known for some, found as for spreading. */
static double bound(double *differences, size_t known, size_t all)
{
    struct bead_summary sample;
    if (known == 0)
        return NAN;
    bead_summary_of(differences, known, &sample);
    return bead_uncertainty_measured(0, sample.mean, 0) + bead_sample_error(&sample, all);
}

static double bound_of_number(const struct bead_sweep_lines *lines, size_t curve, size_t number, double *values)
{
    size_t used = 0;
    for (size_t c = 0; c < lines->chain_count; c++) {
        const struct bead_sweep_line_chain *own = &lines->chains[c];
        if (own->curve == curve && own->check && isfinite(own->found.values[number]) && isfinite(own->finer.values[number]))
            values[used++] = own->found.values[number] - own->finer.values[number];
    }
    return bound(values, used, lines->of[curve].chains);
}

/* Finds those of the worst row of each column, since errors cross zero along a curve. */
static enum bead_error find_uncertainties(const struct bead_sweep_lines *lines, size_t curve, double *values,
                                          struct bead_message *msg)
{
    struct bead_sweep_line *line = &lines->of[curve];
    BEAD_TRY(bead_new(&line->uncertainty, line->mean.columns + 1, msg, "the mean of %zu chains", line->chains));
    for (size_t p = 0; p < line->mean.columns; p++) {
        line->uncertainty[p] = NAN;
        for (size_t k = 0; k < line->mean.rows; k++) /* fmax ignores NaN */
            line->uncertainty[p] = fmax(line->uncertainty[p], bound_of_number(lines, curve, p * line->mean.rows + k, values));
    }
    return BEAD_OK;
}

/* By how much the frequency of each strongest line changes if the mean changes as this chain does: [columns][bands] of every
 * `stride`. `room`: for the numbers of a mean. */
static void find_moves(const struct bead_sweep_line *line, const struct bead_sweep_line_chain *own, double *room, size_t stride,
                       double *moves)
{
    struct bead_spectral moved = line->mean;
    moved.values = room;
    for (size_t i = 0; i < moved.columns * moved.rows; i++)
        room[i] = line->mean.values[i] - (own->found.values[i] - own->finer.values[i]);
    for (size_t i = 0; i < moved.columns * line->bands; i++) {
        const size_t column = i / line->bands, band = i % line->bands;
        moves[i * stride] = bead_spectral_line(&line->mean, line->medium, column, band).found -
                            bead_spectral_line(&moved, line->medium, column, band).found;
    }
}

/* Small changes of the mean move its lines by the mean of what the changes of the chains would. */
static enum bead_error find_frequencies(const struct bead_sweep_lines *lines, size_t curve, struct bead_message *msg)
{
    struct bead_sweep_line *line = &lines->of[curve];
    const size_t found = line->mean.columns * line->bands, chains = line->chains;
    BEAD_FREED double *room = NULL, *moves = NULL;
    size_t used = 0;
    BEAD_TRY(bead_new(&line->of_frequency, found + 1, msg, "the mean of %zu chains", chains));
    BEAD_TRY(bead_new(&room, line->mean.columns * line->mean.rows + 1, msg, "the mean of %zu chains", chains));
    BEAD_TRY(bead_new(&moves, found * chains + 1, msg, "the mean of %zu chains", chains));
    for (size_t c = 0; c < lines->chain_count; c++) {
        if (lines->chains[c].curve == curve && lines->chains[c].check)
            find_moves(line, &lines->chains[c], room, chains, moves + used++);
    }
    for (size_t i = 0; i < found; i++)
        line->of_frequency[i] = bound(moves + i * chains, used, chains);
    return BEAD_OK;
}

/* Adds the curves of one chain, which must be as many and as long as the first chain's. */
static enum bead_error add(const struct bead_sweep *sweep, struct bead_sweep_lines *lines, size_t index, struct bead_message *msg)
{
    struct bead_sweep_line_chain *own = &lines->chains[index];
    struct bead_sweep_line *line = &lines->of[own->curve];
    BEAD_TRY(bead_spectra_of(own->spectra, 0, &own->found, msg));
    if (own->check)
        BEAD_TRY(bead_spectra_of(own->check, 0, &own->finer, msg));
    const struct bead_spectral *first = &lines->chains[0].found, *found = &own->found;
    if (found->columns != first->columns || found->rows != first->rows)
        return bead_output_wrong(&lines->output, msg,
                                 "show: chains have %zu and %zu curves or wave numbers; those of a sweep must have as many",
                                 first->columns, found->columns);
    if (!line->chain) {
        bead_sweep_curve_name(sweep, 0, index, SIZE_MAX, line->name);
        line->mean = *found;
        line->mean.values = NULL;
        line->chain = own->chain;
        line->medium = bead_spectra_medium(own->spectra, 0);
        line->bands = line->medium ? line->medium->cell.count : 1;
    }
    return BEAD_OK;
}

enum bead_error bead_sweep_lines_find(const struct bead_sweep *sweep, const struct bead_output *output,
                                      const struct bead_sweep_settings *settings, bool checked, struct bead_sweep_lines *lines,
                                      struct bead_message *msg)
{
    const size_t count = bead_sweep_panel(sweep, 0)->configurations;
    double end = NAN, every = INFINITY;
    BEAD_FREED double *values = NULL;
    *lines = (struct bead_sweep_lines){.output = *output, .chain_count = count};
    BEAD_TRY(bead_new(&lines->chains, count, msg, "the curves of %zu chains", count));
    BEAD_TRY(bead_new(&values, count, msg, "the curves of %zu chains", count));
    BEAD_TRY(find_end(sweep, settings, count, &end, msg));
    for (size_t i = 0; i < count; i++) {
        double own = INFINITY;
        BEAD_TRY(make_chain(sweep, output, i, end, &lines->chains[i], &own, msg));
        every = fmin(every, own);
        lines->count = lines->chains[i].curve >= lines->count ? lines->chains[i].curve + 1 : lines->count;
    }
    BEAD_TRY(bead_new(&lines->of, lines->count, msg, "the curves of %zu chains", count));
    for (size_t i = 0; i < count; i++)
        lines->of[lines->chains[i].curve].chains++;
    BEAD_TRY(run_all(sweep, settings, checked, end, every, lines, msg));
    for (size_t i = 0; i < count; i++)
        BEAD_TRY(add(sweep, lines, i, msg));
    for (size_t i = 0; i < lines->count; i++)
        BEAD_TRY(reduce(lines, i, values, msg));
    for (size_t i = 0; checked && i < lines->count; i++) {
        BEAD_TRY(find_uncertainties(lines, i, values, msg));
        if (output->curves.show == BEAD_SHOW_DISPERSION)
            BEAD_TRY(find_frequencies(lines, i, msg));
    }
    return BEAD_OK;
}
