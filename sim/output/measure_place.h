/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places to measure along a chain: regular stretches, defects between them, the probe. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"

enum { BEAD_PLACE_PERIOD = 8 }; /* beads of the longest cell searched for */

struct bead_places {
    size_t links;        /* contacts between beads */
    size_t probe;        /* contact */
    size_t cell;         /* beads of the cell that repeats at the probe; 1 if none does */
    bool regular;        /* the chain repeats itself at the probe */
    size_t regular_from; /* first bead of the stretch that repeats up to the end */
    bool defect;         /* the same cell also repeats at the beginning of the chain, but not in between */
    size_t before;       /* first contact of a cell before the defect that does not feel it; the cell after it is the probe's */
};

struct bead_places bead_places_find(const struct bead_chain *chain);
/* Last bead of the longest stretch from bead 1 on that repeats every `period` beads. */
size_t bead_places_head(const struct bead_chain *chain, size_t period);
