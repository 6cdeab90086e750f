/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile's memory of the past, over cells rather than beads: a pulse in a chain of cells fluctuates from bead to bead, and is
 * even from cell to cell.
 *
 *   bead_hold_create -> bead_hold_feed, times rising -> bead_hold_largest, bead_hold_passing -> bead_hold_destroy */
#pragma once

#include <stddef.h>

#include "beadreel/chain.h"

struct bead_hold;

/* For values `beads` of a chain. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_hold_create(const struct bead_chain *chain, struct bead_span beads, struct bead_hold **hold,
                                            struct bead_message *msg);
void bead_hold_destroy(struct bead_hold *hold);
/* `values`: of the span. */
void bead_hold_feed(struct bead_hold *hold, double time, const double *values);
/* The largest value so far of the cell around value i, and the largest during the last passage of a cell. */
double bead_hold_largest(const struct bead_hold *hold, size_t i);
double bead_hold_passing(const struct bead_hold *hold, size_t i);
