/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds how far energy spreads in the chains of a sweep: see sweep_spreading.h. */
#include "sim/sweep/sweep_spreading.h"

#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/statistics/statistics.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* One chain's. */
struct chain {
    struct bead_spreading spreading;
    double numbers[BEAD_SPREADING_NUMBERS][BEAD_SWEEP_TIMES];
    size_t beads, curve, taken;
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
    enum bead_error err = bead_sweep_chain_create(sweep, 0, index, &made, msg);
    if (!err) {
        chain->beads = bead_chain_beads(bead_sweep_chain_of(made));
        chain->curve = bead_sweep_curve_of(sweep, 0, index, SIZE_MAX);
        err = bead_spreading_begin(&chain->spreading, bead_sweep_chain_of(made), BEAD_SWEEP_TIMES, msg);
    }
    bead_sweep_chain_destroy(made);
    return err;
}

/* The mean over the chains of a curve, in their order. `values`: room for one of each. */
static void reduce(const struct chain *chains, size_t count, size_t curve, double *values, struct bead_sweep_spread *spread)
{
    struct bead_summary summary;
    for (int n = 0; n < BEAD_SPREADING_NUMBERS; n++) {
        for (size_t i = 0; i < BEAD_SWEEP_TIMES; i++) {
            spread->chains = 0;
            for (size_t c = 0; c < count; c++) {
                if (chains[c].curve == curve)
                    values[spread->chains++] = chains[c].numbers[n][i];
            }
            bead_summary_of(values, spread->chains, &summary);
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

static enum bead_error find(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings, struct chain *chains,
                            size_t count, struct bead_sweep_spreads *spreads, struct bead_message *msg)
{
    const double end = bead_sweep_scene(sweep)->simulate.until;
    BEAD_FREED struct bead_sweep_watch *watches = NULL;
    BEAD_FREED double *values = NULL;
    BEAD_TRY(bead_new(&watches, count, msg, "the spreading of %zu chains", count));
    BEAD_TRY(bead_new(&values, count, msg, "the spreading of %zu chains", count));
    for (size_t i = 0; i < count; i++) {
        BEAD_TRY(begin(sweep, i, &chains[i], msg));
        watches[i] = (struct bead_sweep_watch){.index = i,
                                               .end = end,
                                               .fields = BEAD_FIELD_BIT(BEAD_FIELD_ENERGY),
                                               .every = end / (BEAD_SWEEP_TIMES - 1),
                                               .take = take,
                                               .context = &chains[i]};
        spreads->count = chains[i].curve >= spreads->count ? chains[i].curve + 1 : spreads->count;
    }
    BEAD_TRY(bead_sweep_watch(sweep, watches, count, settings, msg));
    BEAD_TRY(bead_new(&spreads->of, spreads->count, msg, "the spreading of %zu chains", count));
    for (size_t i = 0; i < BEAD_SWEEP_TIMES; i++)
        spreads->time[i] = end * (double)i / (BEAD_SWEEP_TIMES - 1);
    for (size_t i = 0; i < count; i++) {
        if (!*spreads->of[chains[i].curve].name)
            bead_sweep_curve_name(sweep, 0, i, SIZE_MAX, spreads->of[chains[i].curve].name);
    }
    for (size_t i = 0; i < spreads->count; i++)
        reduce(chains, count, i, values, &spreads->of[i]);
    return BEAD_OK;
}

enum bead_error bead_sweep_spreads_find(const struct bead_sweep *sweep, const struct bead_sweep_settings *settings,
                                        struct bead_sweep_spreads *spreads, struct bead_message *msg)
{
    const size_t count = bead_sweep_panel(sweep, 0)->configurations;
    BEAD_FREED struct chain *chains = NULL;
    *spreads = (struct bead_sweep_spreads){.count = 0};
    BEAD_TRY(bead_new(&chains, count, msg, "the spreading of %zu chains", count));
    enum bead_error err = find(sweep, settings, chains, count, spreads, msg);
    for (size_t i = 0; i < count; i++)
        bead_spreading_free(&chains[i].spreading);
    return err;
}

void bead_sweep_spreads_free(struct bead_sweep_spreads *spreads)
{
    free(spreads->of);
}
