/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The decay of the leading force along a chain: a rate, how well it is known, and where it was found. */
#ifndef BEADREEL_SIM_OUTPUT_MEASURE_DECAY_H
#define BEADREEL_SIM_OUTPUT_MEASURE_DECAY_H

#include "sim/output/measure_private.h"

struct bead_decay_found {
    double rate, error; /* 1/bead; NaN: too few contacts */
    bool seen;          /* the rate, decay or growth, is larger than its error */
    size_t first, last; /* contacts of the fit */
};

/* `outcome` may be NULL. */
struct bead_decay_found bead_decay_find(const struct bead_measures *measures, const struct bead_outcome *outcome);

#endif
