/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spreading over an ensemble: means over the seeds of a sweep over keys, for each combination of the other keys. */
#pragma once

#include "beadreel/sweep.h"
#include "sim/measure/spreading.h"

/* Maximum of sample times, for a grid that widens from a spacing of at least 1e-10 of the end. */
enum { BEAD_SWEEP_TIMES = 1024 };

struct bead_sweep_spread {
    char name[200]; /* the values of the other keys; "" if there are none */
    size_t chains;
    double mean[BEAD_SPREADING_NUMBERS][BEAD_SWEEP_TIMES], error[BEAD_SPREADING_NUMBERS][BEAD_SWEEP_TIMES]; /* standard errors */
    struct bead_summary exponent[2]; /* of the chains, of second moment and participation */
    double offset[2];                /* mean of ln y at t = 1 s */
    /* Uncertainty of the means, from chains that were run twice: the largest up to each time; and of the exponents. NaN: not asked
     * for. */
    double uncertainty[BEAD_SPREADING_NUMBERS][BEAD_SWEEP_TIMES], of_exponent[2];
};
struct bead_sweep_spreads {
    double time[BEAD_SWEEP_TIMES]; /* s */
    size_t times;
    struct bead_sweep_spread *of;
    size_t count;
};
/* Runs all chains of the sweep, which has an `until`; `checked`: one in 64 chains, at least five of each curve, and long ones,
 * again at the tolerance of check runs, for uncertainties. To be freed even after an error. Errors: those of bead_sweep_watch. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sweep_spreads_find(const struct bead_sweep *sweep,
                                                                 const struct bead_sweep_settings *settings, bool checked,
                                                                 struct bead_sweep_spreads *spreads, struct bead_message *msg);
BEAD_INTERNAL void bead_sweep_spreads_free(struct bead_sweep_spreads *spreads);
