/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places: where along a chain something can be measured: regular stretches, defects between them, the probe. */
#ifndef BEADREEL_SIM_OUTPUT_MEASURE_PLACE_H
#define BEADREEL_SIM_OUTPUT_MEASURE_PLACE_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"

enum { BEAD_PLACE_PERIOD = 8 }; /* beads of the longest cell that is looked for */

struct bead_places {
    size_t links;        /* contacts between beads */
    size_t probe;        /* contact */
    size_t cell;         /* beads that repeat at the probe; 1 where nothing does */
    bool regular;        /* the chain repeats itself at the probe */
    size_t regular_from; /* first bead from which on it does, up to its end */
    bool defect;         /* it also does so at its beginning, with the same cell, and not in between: */
    size_t before;       /* contact: first of a cell ahead of the defect that does not feel it; after it: the probe's */
};

struct bead_places bead_places_find(const struct bead_chain *chain);
/* Last bead of the longest stretch from bead 1 on that repeats every `period` beads. */
size_t bead_places_head(const struct bead_chain *chain, size_t period);

#endif
