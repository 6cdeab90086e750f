/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncertainty: how well the peaks of a run are known, from those of a comparison run with other steps.
 *
 * A comparison run at f times the tolerance is off by up to f times what was asked, and the run itself by that less: where the two
 * differ by no more the peaks are as they should be. Peaks that differ by more answer too strongly, and their errors hardly follow
 * the tolerance: what drives them are the few ways in which the chain is unstable, which drive the peaks nearby as well, if by
 * chance not in these two runs. Damping takes that away. Two runs may also be off alike, and agree where neither is right, so that
 * no peak is much more certain than the others of its chain. */
#ifndef BEADREEL_SIM_RUN_UNCERTAINTY_H
#define BEADREEL_SIM_RUN_UNCERTAINTY_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"

/* What is compared. */
struct bead_uncertainty_of {
    double accuracy;         /* that the run was made for; 0: steps were given */
    double tolerance_factor; /* the comparison run's accuracy in units of it, or its step in those of the step */
    bool damped;
    double end; /* s: of the run that ended first; what either has later was not compared. 0: both ended together */
};

/* The peaks of contacts, or of beads, in order. */
struct bead_uncertain_peaks {
    const struct bead_peak *peaks, *comparison;
    size_t count;        /* 0: not known */
    double *uncertainty; /* N: out */
};

/* Uncertainties of the peaks of a chain's contacts [0] and beads [1]. */
void bead_uncertainty_find(const struct bead_uncertainty_of *of, const struct bead_uncertain_peaks kinds[2]);

#endif
