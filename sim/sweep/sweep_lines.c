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
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* A run's curves, or how far its energy has spread. */
struct collected {
    struct bead_spectra *spectra; /* NULL: of the spreading */
    struct bead_spreading spreading;
    size_t taken;               /* samples of the spreading */
    struct bead_spectral found; /* after its curves the laws of spreading, see sweep_lines.h */
};

struct bead_sweep_line_chain {
    struct bead_sweep_chain *made;
    const struct bead_chain *chain;
    struct collected run, finer;
    bool checked; /* has a finer run */
    size_t curve;
};

static void free_collected(struct collected *own)
{
    bead_spectra_destroy(own->spectra);
    bead_spreading_free(&own->spreading);
    free(own->found.values);
}

void bead_sweep_lines_free(struct bead_sweep_lines *lines)
{
    for (size_t i = 0; lines->chains && i < lines->chain_count; i++) {
        free_collected(&lines->chains[i].run);
        free_collected(&lines->chains[i].finer);
        bead_sweep_chain_destroy(lines->chains[i].made);
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

static struct bead_run_context context_of(const struct bead_sweep *sweep, const struct bead_sweep_line_chain *own, double end)
{
    return (struct bead_run_context){
        .scene = bead_sweep_scene(sweep), .chains = &own->chain, .chain_count = 1, .end = end, .threads = 1, .directory = "."};
}

/* Prepares a run of a chain. */
static enum bead_error prepare(const struct bead_sweep_lines *lines, const struct bead_run_context *context, struct collected *own,
                               struct bead_message *msg)
{
    if (lines->laws == 0)
        return bead_spectra_create(&lines->output, context, &own->spectra, msg);
    own->found = (struct bead_spectral){.columns = BEAD_SPREADING_NUMBERS, .rows = bead_grid_count(&lines->grid)};
    BEAD_TRY(bead_new(&own->found.values, own->found.columns * own->found.rows + lines->laws, msg, "the spreading of a chain"));
    return bead_spreading_begin(&own->spreading, context->chains[0], own->found.rows, msg);
}

/* Makes a chain; the samples of all are as close as the quickest needs. */
static enum bead_error make_chain(const struct bead_sweep *sweep, struct bead_sweep_lines *lines, size_t index,
                                  struct bead_message *msg)
{
    struct bead_sweep_line_chain *own = &lines->chains[index];
    struct bead_pace pace = {.resolution = 0};
    BEAD_TRY(bead_sweep_chain_create(sweep, 0, index, &own->made, msg));
    own->chain = bead_sweep_chain_of(own->made);
    own->curve = bead_sweep_curve_of(sweep, 0, index, SIZE_MAX);
    lines->count = own->curve >= lines->count ? own->curve + 1 : lines->count;
    BEAD_TRY(bead_run_kind_of(own->chain)->pace(own->chain, &bead_sweep_scene(sweep)->simulate, 1, &pace, msg));
    double every = bead_round_down(pace.resolution);
    if (lines->laws == 0) {
        struct bead_spectra *spectra = NULL;
        struct bead_run_context context = context_of(sweep, own, lines->grid.end);
        context.resolution = pace.resolution;
        BEAD_TRY(bead_places_check(&lines->output, own->chain, msg));
        BEAD_TRY(bead_spectra_create(&lines->output, &context, &spectra, msg));
        every = bead_spectra_needs(spectra).grid.every;
        bead_spectra_destroy(spectra);
    }
    lines->grid.every = fmin(lines->grid.every, every);
    return BEAD_OK;
}

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *msg)
{
    struct collected *own = context;
    double numbers[BEAD_SPREADING_NUMBERS];
    if (own->spectra)
        return bead_spectra_feed(own->spectra, sample, msg);
    if (own->taken >= own->found.rows)
        return BEAD_OK;
    bead_spreading_feed(&own->spreading, sample, numbers);
    for (size_t n = 0; n < BEAD_SPREADING_NUMBERS; n++)
        own->found.values[n * own->found.rows + own->taken] = numbers[n];
    own->taken++;
    return BEAD_OK;
}

/* After the last sample. */
static enum bead_error finish(struct collected *own, struct bead_message *msg)
{
    struct bead_spectral *found = &own->found;
    if (own->spectra)
        return bead_spectra_of(own->spectra, 0, found, msg);
    double *laws = found->values + found->columns * found->rows;
    for (int n = 0; n < BEAD_LAWS; n++) {
        const struct bead_line e = bead_spreading_exponent(&own->spreading, n);
        laws[n] = e.slope;
        laws[BEAD_LAWS + n] = e.offset;
    }
    return BEAD_OK;
}

/* Prepares a run of a chain, or a finer one. */
static enum bead_error watch_chain(const struct bead_sweep *sweep, const struct bead_sweep_lines *lines, size_t index, bool finer,
                                   struct bead_sweep_watch *watch, struct bead_message *msg)
{
    struct bead_sweep_line_chain *chain = &lines->chains[index];
    struct collected *own = finer ? &chain->finer : &chain->run;
    struct bead_run_context context = context_of(sweep, chain, lines->grid.end);
    context.native = lines->grid;
    BEAD_TRY(prepare(lines, &context, own, msg));
    *watch = (struct bead_sweep_watch){.index = index,
                                       .end = lines->grid.end,
                                       .fields = own->spectra ? bead_spectra_needs(own->spectra).fields
                                                              : BEAD_FIELD_BIT(BEAD_FIELD_ENERGY),
                                       .every = lines->grid.every,
                                       .widens = lines->grid.widens,
                                       .finer = finer,
                                       .take = take,
                                       .context = own};
    return BEAD_OK;
}

/* The chains are made again to run; only the first of each curve is kept, for its cell and the names of places. */
static void drop_chains(struct bead_sweep_lines *lines)
{
    for (size_t i = 0; i < lines->chain_count; i++) {
        struct bead_sweep_line_chain *own = &lines->chains[i];
        if (own->chain == lines->of[own->curve].chain)
            continue;
        bead_sweep_chain_destroy(own->made);
        own->made = NULL;
        own->chain = NULL;
    }
}

/* Runs all chains and, to check them, a sample of each curve's again, and long ones, whose errors differ more. `watches`: room for
 * two of each. */
static enum bead_error run_all(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, bool checked,
                               struct bead_sweep_watch *watches, struct bead_sweep_lines *lines, struct bead_message *msg)
{
    BEAD_FREED size_t *met = NULL;
    size_t count = 0;
    BEAD_TRY(bead_new(&met, lines->count, msg, "the curves of %zu chains", lines->chain_count));
    for (size_t i = 0; i < lines->chain_count; i++)
        BEAD_TRY(watch_chain(sweep, lines, i, false, &watches[count++], msg));
    for (size_t i = 0; checked && i < lines->chain_count; i++) {
        struct bead_sweep_line_chain *own = &lines->chains[i];
        own->checked = met[own->curve]++ % bead_sample_every(lines->of[own->curve].chains) == 0 || bead_is_long(own->chain);
        if (own->checked)
            BEAD_TRY(watch_chain(sweep, lines, i, true, &watches[count++], msg));
    }
    drop_chains(lines);
    return bead_sweep_watch(sweep, watches, count, settings, msg);
}

/* ---- means ---- */

static size_t numbers_of(const struct bead_sweep_lines *lines, size_t curve)
{
    return bead_sweep_line_law(&lines->of[curve], lines->laws);
}

/* The mean over a curve's chains, in their order, of the numbers that exist: a transfer has none where the drive is small. */
static enum bead_error reduce(const struct bead_sweep_lines *lines, size_t curve, double *values, struct bead_message *msg)
{
    struct bead_sweep_line *line = &lines->of[curve];
    const size_t numbers = numbers_of(lines, curve);
    BEAD_TRY(bead_new(&line->mean.values, numbers, msg, "the mean of %zu chains", line->chains));
    BEAD_TRY(bead_new(&line->error, numbers, msg, "the mean of %zu chains", line->chains));
    for (size_t i = 0; i < numbers; i++) {
        struct bead_summary summary;
        size_t used = 0;
        for (size_t c = 0; c < lines->chain_count; c++) {
            const struct bead_sweep_line_chain *own = &lines->chains[c];
            if (own->curve == curve && isfinite(own->run.found.values[i]))
                values[used++] = own->run.found.values[i];
        }
        bead_summary_of(values, used, &summary);
        line->mean.values[i] = summary.mean;
        line->error[i] = summary.standard_error;
    }
    return BEAD_OK;
}

static double bound_of_number(const struct bead_sweep_lines *lines, size_t curve, size_t number, double *values)
{
    size_t used = 0;
    for (size_t c = 0; c < lines->chain_count; c++) {
        const struct bead_sweep_line_chain *own = &lines->chains[c];
        if (own->curve == curve && own->checked && isfinite(own->run.found.values[number]) &&
            isfinite(own->finer.found.values[number]))
            values[used++] = own->run.found.values[number] - own->finer.found.values[number];
    }
    return bead_sweep_bound(values, used, lines->of[curve].chains);
}

/* Errors cross zero along a curve, so all rows have that of the worst, or of the worst so far. */
static enum bead_error find_uncertainties(const struct bead_sweep_lines *lines, size_t curve, double *values,
                                          struct bead_message *msg)
{
    struct bead_sweep_line *line = &lines->of[curve];
    const size_t rows = line->mean.rows, numbers = numbers_of(lines, curve);
    BEAD_TRY(bead_new(&line->uncertainty, numbers, msg, "the mean of %zu chains", line->chains));
    for (size_t i = 0; i < numbers; i++) {
        line->uncertainty[i] = bound_of_number(lines, curve, i, values);
        if (i < numbers - lines->laws && i % rows > 0) /* fmax ignores NaN */
            line->uncertainty[i] = fmax(line->uncertainty[i - 1], line->uncertainty[i]);
    }
    for (size_t i = 0; lines->laws == 0 && i < numbers; i++)
        line->uncertainty[i] = line->uncertainty[i / rows * rows + rows - 1];
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
        room[i] = line->mean.values[i] - (own->run.found.values[i] - own->finer.found.values[i]);
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
    BEAD_TRY(bead_new(&line->of_frequency, found, msg, "the mean of %zu chains", chains));
    BEAD_TRY(bead_new(&room, line->mean.columns * line->mean.rows, msg, "the mean of %zu chains", chains));
    BEAD_TRY(bead_new(&moves, found * chains, msg, "the mean of %zu chains", chains));
    for (size_t c = 0; c < lines->chain_count; c++) {
        if (lines->chains[c].curve == curve && lines->chains[c].checked)
            find_moves(line, &lines->chains[c], room, chains, moves + used++);
    }
    for (size_t i = 0; i < found; i++)
        line->of_frequency[i] = bead_sweep_bound(moves + i * chains, used, chains);
    return BEAD_OK;
}

/* Adds the curves of one chain, which must be as many and as long as the first chain's. */
static enum bead_error add(const struct bead_sweep *sweep, struct bead_sweep_lines *lines, size_t index, struct bead_message *msg)
{
    struct bead_sweep_line_chain *own = &lines->chains[index];
    struct bead_sweep_line *line = &lines->of[own->curve];
    BEAD_TRY(finish(&own->run, msg));
    if (own->checked)
        BEAD_TRY(finish(&own->finer, msg));
    const struct bead_spectral *first = &lines->chains[0].run.found, *found = &own->run.found;
    if (found->columns != first->columns || found->rows != first->rows)
        return bead_output_wrong(&lines->output, msg,
                                 "show: chains have %zu and %zu curves or wave numbers; those of a sweep must have as many",
                                 first->columns, found->columns);
    if (line->chain == own->chain) {
        bead_sweep_curve_name(sweep, 0, index, SIZE_MAX, line->name);
        line->mean = *found;
        line->mean.values = NULL;
        line->medium = own->run.spectra ? bead_spectra_medium(own->run.spectra, 0) : NULL;
        line->bands = line->medium ? line->medium->cell.count : 1;
    }
    return BEAD_OK;
}

static enum bead_error check_grid(const struct bead_grid *grid, struct bead_message *msg)
{
    return bead_grid_is_too_fine(grid) || bead_grid_count(grid) > BEAD_SWEEP_TIMES
               ? bead_fail(msg, BEAD_ERROR_USAGE, "spreading: %g s are too long for samples %g s apart", grid->end, grid->every)
               : BEAD_OK;
}

enum bead_error bead_sweep_lines_find(const struct bead_sweep *sweep, const struct bead_output *output,
                                      const struct bead_sweep_settings *settings, bool checked, struct bead_sweep_lines *lines,
                                      struct bead_message *msg)
{
    const size_t count = bead_sweep_panel(sweep, 0)->configurations;
    const bool spreading = output->sweep_curves.show == BEAD_SWEEP_SPREADING;
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    BEAD_FREED double *values = NULL;
    *lines = (struct bead_sweep_lines){.output = *output,
                                       .grid = {.every = INFINITY, .end = NAN, .widens = spreading},
                                       .laws = spreading ? BEAD_LAW_NUMBERS : 0,
                                       .chain_count = count};
    BEAD_TRY(bead_new(&lines->chains, count, msg, "the curves of %zu chains", count));
    BEAD_TRY(bead_new(&values, count, msg, "the curves of %zu chains", count));
    BEAD_TRY(bead_new(&watches, 2 * count, msg, "the curves of %zu chains", count));
    for (size_t i = 0; i < count; i++)
        watches[i].index = i;
    BEAD_TRY(bead_sweep_end(sweep, watches, count, settings, &lines->grid.end, msg));
    for (size_t i = 0; i < count; i++)
        BEAD_TRY(make_chain(sweep, lines, i, msg));
    if (spreading)
        BEAD_TRY(check_grid(&lines->grid, msg));
    BEAD_TRY(bead_new(&lines->of, lines->count, msg, "the curves of %zu chains", count));
    for (size_t i = 0; i < count; i++) {
        struct bead_sweep_line *line = &lines->of[lines->chains[i].curve];
        if (line->chains++ == 0)
            line->chain = lines->chains[i].chain;
    }
    BEAD_TRY(run_all(sweep, settings, checked, watches, lines, msg));
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
