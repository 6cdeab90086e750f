/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Front: the time when the wave reaches the end of the chain. */
#pragma once

#include "sim/integrate/stepper.h"

/* The front has arrived when the last contact's force first exceeds 1e-4 of the largest contact force so far, both without their
 * static part. Where other beads than the striker move at first, there is no front. */
struct bead_front {
    double arrival;       /* s; NaN before */
    double largest_force; /* N, of all contacts so far, including maxima within steps */
    size_t strongest;     /* contact with the largest force at the end of the last step */
};

/* Is it too late for it to arrive? Of the energy of the beads that have not parted for good from those before them, the last
 * contact would get too little even if it got all of it. Never true of springs, precompression or a tilt. */
bool bead_front_is_lost(const struct bead_front *front, const struct bead_stepper *stepper);
/* Follows the last step. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_front_watch(struct bead_front *front, const struct bead_stepper *stepper, struct bead_message *msg);
