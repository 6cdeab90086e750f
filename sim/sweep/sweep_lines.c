/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collects curves of the chains of a sweep and takes their means: see sweep_lines.h. */
#include "sim/sweep/sweep_lines.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/places.h"
#include "sim/measure/sink_grid.h"
#include "sim/run/run_kinds.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

struct bead_sweep_line_chain {
    struct bead_sweep_chain *made;
    const struct bead_chain *chain;
    struct bead_spectra *spectra;
    struct bead_spectral found;
    size_t curve;
};

void bead_sweep_lines_free(struct bead_sweep_lines *lines)
{
    for (size_t i = 0; lines->chains && i < lines->chain_count; i++) {
        bead_spectra_destroy(lines->chains[i].spectra);
        bead_sweep_chain_destroy(lines->chains[i].made);
        free(lines->chains[i].found.values);
    }
    for (size_t i = 0; lines->of && i < lines->count; i++) {
        free(lines->of[i].mean.values);
        free(lines->of[i].error);
    }
    free(lines->chains);
    free(lines->of);
}

/* All chains run to one time: `until`, or the last arrival of a front. */
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

/* Makes a chain; *every: the time between samples that it wants for itself. */
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
    const struct bead_sweep_line_chain *own = context;
    return bead_spectra_feed(own->spectra, sample, msg);
}

/* All are sampled alike: as closely as the quickest wants. */
static enum bead_error run_all(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, double end, double every,
                               struct bead_sweep_lines *lines, struct bead_message *msg)
{
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    BEAD_TRY(bead_new(&watches, lines->chain_count, msg, "the curves of %zu chains", lines->chain_count));
    for (size_t i = 0; i < lines->chain_count; i++) {
        struct bead_sweep_line_chain *own = &lines->chains[i];
        struct bead_run_context context = context_of(sweep, own, end);
        context.native = (struct bead_grid){0, every, end, false};
        BEAD_TRY(bead_spectra_create(&lines->output, &context, &own->spectra, msg));
        const struct bead_needs needs = bead_spectra_needs(own->spectra);
        watches[i] =
            (struct bead_sweep_watch){.index = i, .end = end, .fields = needs.fields, .every = every, .take = take, .context = own};
    }
    return bead_sweep_watch(sweep, watches, lines->chain_count, settings, msg);
}

/* ---- means ---- */

/* The mean over the chains of a curve, in their order, of what each has: a transfer has none where the drive is small. */
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

/* The curves of one chain, which must be as many as those of the first, and as long. */
static enum bead_error add(const struct bead_sweep *sweep, struct bead_sweep_lines *lines, size_t index, struct bead_message *msg)
{
    struct bead_sweep_line_chain *own = &lines->chains[index];
    struct bead_sweep_line *line = &lines->of[own->curve];
    BEAD_TRY(bead_spectra_of(own->spectra, 0, &own->found, msg));
    const struct bead_spectral *first = &lines->chains[0].found, *found = &own->found;
    if (found->columns != first->columns || found->rows != first->rows)
        return bead_output_wrong(&lines->output, msg,
                                 "show: chains have %zu and %zu curves or wave numbers; those of a sweep must have as many",
                                 first->columns, found->columns);
    if (line->chains++ == 0) {
        bead_sweep_curve_name(sweep, 0, index, SIZE_MAX, line->name);
        line->mean = *found;
        line->mean.values = NULL;
        line->chain = own->chain;
        line->medium = bead_spectra_medium(own->spectra, 0);
    }
    return BEAD_OK;
}

enum bead_error bead_sweep_lines_find(const struct bead_sweep *sweep, const struct bead_output *output,
                                      const struct bead_sweep_settings *settings, struct bead_sweep_lines *lines,
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
    BEAD_TRY(run_all(sweep, settings, end, every, lines, msg));
    for (size_t i = 0; i < count; i++)
        BEAD_TRY(add(sweep, lines, i, msg));
    for (size_t i = 0; i < lines->count; i++)
        BEAD_TRY(reduce(lines, i, values, msg));
    return BEAD_OK;
}
