/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Behind: drops the beads from which nothing can reach the measured ones before the front reaches the end of the chain.
 *
 * Without precompression, nothing that happens far behind the front catches up with it. If a run ends with the front's arrival, and
 * only peaks of beads `target` and later are wanted, the front still needs the time for (contacts - front) beads, and signals
 * behind it travel faster than the front by a factor of at most `widening`. It keeps
 *
 *   (front - target) + widening (contacts - front) + 20
 *
 * beads. The choice is checked: a signal from the cut travels sqrt(K/m) beads a second at most, the group velocity of long waves in
 * a chain of springs K and mean masses m (L. Brillouin, Wave Propagation in Periodic Structures, 1953), so the edge of the motion
 * that the cut may have changed follows a differential equation, d edge / dt = sqrt(K/m) at the edge. The peaks hold if the edge is
 * at least 16 beads before the target whenever a peak is found: ahead of its front a signal decays faster than exponentially. Else
 * the run must be repeated with more beads. */
#pragma once

#include "sim/integrate/stepper.h"

struct bead_behind {
    double widening; /* 0: all beads are kept */
    size_t target;   /* first bead whose peaks are wanted */
    double edge;     /* bead up to which the cut may have changed the motion */
    bool reached;    /* the edge was near the target when a peak was found */
};

/* Why all beads of this chain must be kept, in words; NULL: they need not be. */
const char *bead_behind_refusal(const struct bead_chain *chain);
/* Follows the last step; `largest`: the largest force of a contact so far, N; `peak`: a wanted peak was found in it. Returns the
 * energy of the beads that were dropped, J. */
double bead_behind_step(struct bead_behind *behind, struct bead_stepper *stepper, double largest, bool peak);
