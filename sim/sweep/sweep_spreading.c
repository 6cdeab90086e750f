/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds how far energy spreads in the chains of a sweep: see sweep_spreading.h. */
#include "sim/sweep/sweep_spreading.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/measure/sink_grid.h"
#include "sim/run/method_choice.h"
#include "sim/run/run_kinds.h"
#include "sim/run/uncertainty.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* The spreading of one chain. */
struct chain {
    struct bead_spreading spreading;
    double numbers[BEAD_SPREADING_NUMBERS][BEAD_SWEEP_TIMES];
    size_t index, beads, curve, taken;
    double resolution; /* s */
    bool is_long;
};

/* All chains, then the check runs of some. */
struct chains {
    struct chain *of;
    size_t count, all;
};

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *)
{
    struct chain *chain = context;
    double numbers[BEAD_SPREADING_NUMBERS];
    if (chain->taken >= BEAD_SWEEP_TIMES)
        return BEAD_OK;
    bead_spreading_feed(&chain->spreading, sample, chain->beads, numbers);
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++)
        chain->numbers[n][chain->taken] = numbers[n];
    chain->taken++;
    return BEAD_OK;
}

static enum bead_error begin(const struct bead_sweep *sweep, size_t index, struct chain *chain, struct bead_message *msg)
{
    struct bead_sweep_chain *made = NULL;
    struct bead_pace pace = {.resolution = 0};
    enum bead_error err = bead_sweep_chain_create(sweep, 0, index, &made, msg);
    if (!err)
        err = bead_run_kind_of(bead_sweep_chain_of(made))
                  ->pace(bead_sweep_chain_of(made), &bead_sweep_scene(sweep)->simulate, 1, &pace, msg);
    if (!err) {
        chain->index = index;
        chain->beads = bead_chain_beads(bead_sweep_chain_of(made));
        chain->is_long = bead_is_long(bead_sweep_chain_of(made));
        chain->curve = bead_sweep_curve_of(sweep, 0, index, SIZE_MAX);
        chain->resolution = pace.resolution;
        err = bead_spreading_begin(&chain->spreading, bead_sweep_chain_of(made), BEAD_SWEEP_TIMES, msg);
    }
    bead_sweep_chain_destroy(made);
    return err;
}

/* The mean over the chains of a curve, in their order. `values`: room for one of each. */
static void reduce(const struct chain *chains, size_t count, size_t times, size_t curve, double *values,
                   struct bead_sweep_spread *spread)
{
    struct bead_summary summary;
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        for (size_t i = 0; i < times; i++) {
            size_t used = 0;
            for (size_t c = 0; c < count; c++) {
                if (chains[c].curve == curve)
                    values[used++] = chains[c].numbers[n][i];
            }
            bead_summary_of(values, used, &summary);
            spread->mean[n][i] = summary.mean;
            spread->error[n][i] = summary.standard_error;
        }
    }
    for (int n = 0; n < 2; n++) {
        size_t used = 0;
        for (size_t c = 0; c < count; c++) {
            if (chains[c].curve != curve)
                continue;
            const struct bead_exponent e = bead_spreading_exponent(&chains[c].spreading, n);
            spread->offset[n] += e.offset / (double)spread->chains;
            values[used++] = e.slope;
        }
        bead_summary_of(values, used, &spread->exponent[n]);
    }
}

/* Adds a second run of a sample of each curve's chains, and of long ones, whose errors differ more. `met`: room for one of each
 * curve. */
static enum bead_error add_checks(const struct bead_sweep *sweep, const struct bead_sweep_spreads *spreads, size_t *met,
                                  struct chains *chains, struct bead_message *msg)
{
    for (size_t i = 0; i < chains->count; i++) {
        const struct chain *chain = &chains->of[i];
        const size_t every = bead_sample_every(spreads->of[chain->curve].chains);
        if (met[chain->curve]++ % every == 0 || chain->is_long)
            BEAD_TRY(begin(sweep, i, &chains->of[chains->all++], msg));
    }
    return BEAD_OK;
}

/* Chooses the times of all chains: at first as close as the quickest needs. */
static enum bead_error choose_times(const struct bead_sweep *sweep, const struct chains *chains, struct bead_sweep_spreads *spreads,
                                    struct bead_grid *grid, struct bead_message *msg)
{
    double resolution = INFINITY;
    for (size_t i = 0; i < chains->count; i++)
        resolution = fmin(resolution, chains->of[i].resolution);
    *grid = (struct bead_grid){0, bead_round_down(resolution), bead_sweep_scene(sweep)->simulate.until, 1};
    spreads->times = bead_grid_count(grid);
    if (bead_grid_is_too_fine(grid) || spreads->times > BEAD_SWEEP_TIMES)
        return bead_fail(msg, BEAD_ERROR_USAGE, "spreading: %g s are too long for samples %g s apart", grid->end, grid->every);
    for (size_t i = 0; i < spreads->times; i++)
        spreads->time[i] = bead_grid_time(grid, i);
    return BEAD_OK;
}

/* The larger of two uncertainties; unknown (NaN) if one is. */
static double worse(double a, double b)
{
    return isnan(a) || isnan(b) ? NAN : fmax(a, b);
}

/* A chain's number less that of its second run: spreading at time i, or an exponent. */
static double difference(const struct chain *chain, const struct chain *check, int n, size_t i)
{
    return chain->numbers[n][i] - check->numbers[n][i];
}

static double difference_of_exponent(const struct chain *chain, const struct chain *check, int n, size_t)
{
    return bead_spreading_exponent(&chain->spreading, n).slope - bead_spreading_exponent(&check->spreading, n).slope;
}

/* The uncertainty of the mean over a curve's chains: the mean difference of the chains that were run twice, and how much the mean
 * of all may differ from it. `values`: room for one of each. */
static double bound(const struct chains *chains, const struct bead_sweep_spread *spread, size_t curve,
                    double (*of)(const struct chain *chain, const struct chain *check, int n, size_t i), int n, size_t i,
                    double *values)
{
    struct bead_summary sample;
    size_t used = 0;
    for (size_t c = chains->count; c < chains->all; c++) {
        const struct chain *check = &chains->of[c];
        if (check->curve != curve)
            continue;
        values[used] = of(&chains->of[check->index], check, n, i);
        if (isnan(values[used++]))
            return NAN;
    }
    bead_summary_of(values, used, &sample);
    return bead_uncertainty_measured(0, sample.mean, 0) + bead_sample_error(&sample, spread->chains);
}

static void compare(const struct chains *chains, size_t curve, size_t times, double *values, struct bead_sweep_spread *spread)
{
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        double worst = 0;
        for (size_t i = 0; i < times; i++)
            spread->uncertainty[n][i] = worst = worse(worst, bound(chains, spread, curve, difference, n, i, values));
    }
    for (int n = 0; n < 2; n++)
        spread->of_exponent[n] = bound(chains, spread, curve, difference_of_exponent, n, 0, values);
}

/* Without a second run, uncertainties are unknown. */
static void know_nothing(size_t times, struct bead_sweep_spread *spread)
{
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        for (size_t i = 0; i < times; i++)
            spread->uncertainty[n][i] = NAN;
    }
    spread->of_exponent[0] = spread->of_exponent[1] = NAN;
}

static enum bead_error run_all(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings,
                               const struct chains *chains, const struct bead_grid *grid, struct bead_message *msg)
{
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    BEAD_TRY(bead_new(&watches, chains->all, msg, "the spreading of %zu chains", chains->count));
    for (size_t i = 0; i < chains->all; i++)
        watches[i] = (struct bead_sweep_watch){.index = chains->of[i].index,
                                               .end = grid->end,
                                               .fields = BEAD_FIELD_BIT(BEAD_FIELD_ENERGY),
                                               .every = grid->every,
                                               .widens = true,
                                               .finer = i >= chains->count,
                                               .take = take,
                                               .context = &chains->of[i]};
    return bead_sweep_watch(sweep, watches, chains->all, settings, msg);
}

static enum bead_error find(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, bool checked,
                            struct chains *chains, struct bead_sweep_spreads *spreads, struct bead_message *msg)
{
    const size_t count = chains->count;
    struct bead_grid grid;
    BEAD_FREED double *values = NULL;
    BEAD_FREED size_t *met = NULL;
    BEAD_TRY(bead_new(&values, count, msg, "the spreading of %zu chains", count));
    for (; chains->all < count; chains->all++) {
        const struct chain *chain = &chains->of[chains->all];
        BEAD_TRY(begin(sweep, chains->all, &chains->of[chains->all], msg));
        spreads->count = chain->curve >= spreads->count ? chain->curve + 1 : spreads->count;
    }
    BEAD_TRY(bead_new(&met, spreads->count, msg, "the spreading of %zu chains", count));
    BEAD_TRY(bead_new(&spreads->of, spreads->count, msg, "the spreading of %zu chains", count));
    for (size_t i = 0; i < count; i++)
        spreads->of[chains->of[i].curve].chains++;
    if (checked)
        BEAD_TRY(add_checks(sweep, spreads, met, chains, msg));
    BEAD_TRY(choose_times(sweep, chains, spreads, &grid, msg));
    BEAD_TRY(run_all(sweep, settings, chains, &grid, msg));
    for (size_t i = 0; i < count; i++) {
        if (!*spreads->of[chains->of[i].curve].name)
            bead_sweep_curve_name(sweep, 0, i, SIZE_MAX, spreads->of[chains->of[i].curve].name);
    }
    for (size_t i = 0; i < spreads->count; i++)
        reduce(chains->of, count, spreads->times, i, values, &spreads->of[i]);
    for (size_t i = 0; i < spreads->count && !checked; i++)
        know_nothing(spreads->times, &spreads->of[i]);
    for (size_t i = 0; i < spreads->count && checked; i++)
        compare(chains, i, spreads->times, values, &spreads->of[i]);
    return BEAD_OK;
}

enum bead_error bead_sweep_spreads_find(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, bool checked,
                                        struct bead_sweep_spreads *spreads, struct bead_message *msg)
{
    struct chains chains = {.count = bead_sweep_panel(sweep, 0)->configurations};
    const size_t room = (checked ? 2 : 1) * chains.count;
    *spreads = (struct bead_sweep_spreads){.count = 0};
    BEAD_TRY(bead_new(&chains.of, room, msg, "the spreading of %zu chains", chains.count));
    enum bead_error err = find(sweep, settings, checked, &chains, spreads, msg);
    for (size_t i = 0; i < room; i++)
        bead_spreading_free(&chains.of[i].spreading);
    free(chains.of);
    return err;
}

void bead_sweep_spreads_free(struct bead_sweep_spreads *spreads)
{
    free(spreads->of);
}
