/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncertainty: errors of the peaks of a run, estimated from a comparison run with other steps.
 *
 * A comparison run at f times the tolerance may err by f times the requested accuracy, and the run itself by 1/f of that: peaks
 * that differ by no more are as accurate as requested. Peaks that differ by more are sensitive, and their errors hardly depend on
 * the tolerance: the few unstable motions of the chain drive them, and drive the peaks nearby as well, if by chance not in these
 * two runs. Damping removes these instabilities. Two runs may also have similar errors and agree although neither is right, so no
 * peak is much more certain than the others of its chain. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"

/* The two runs that are compared. */
struct bead_uncertainty_of {
    double accuracy;         /* of the run; 0: its step was given */
    double tolerance_factor; /* accuracy, or step, of the comparison run in units of the run's */
    bool damped;
    double end; /* s: of the run that ended first; later peaks are not compared. 0: both ended together */
};

/* The peaks of contacts, or of beads, in order. */
struct bead_uncertain_peaks {
    const struct bead_peak *peaks, *comparison;
    size_t count;        /* 0: unknown */
    double *uncertainty; /* N: out */
};

/* Uncertainties of the peaks of a chain's contacts [0] and beads [1]. */
void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2]);
