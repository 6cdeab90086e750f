/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Heights: the largest force of every contact, and bead if asked, in each part of a run, to tell later how high they are after any
 * time.
 *
 * The parts are equally long, and double in length as the run goes on, so that there are at most BEAD_HEIGHT_PARTS, and at least
 * half as many once there were enough steps. Forces are those at the ends of steps, lower than the maxima in between; of a chaotic
 * motion, whose heights nobody knows, they say as much. */
#pragma once

#include <stdbool.h>

#include "beadreel/error.h"
#include "sim/integrate/stepper.h"

/* Empirical: with 64 a seventh more of the rows of eight chains of stress_errors are unpredictable, with 256 3 % fewer. */
enum { BEAD_HEIGHT_PARTS = 128 };

struct bead_heights;

/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_heights_create(const struct bead_stepper *stepper, bool of_beads, struct bead_heights **heights,
                                               struct bead_message *msg);
void bead_heights_destroy(struct bead_heights *heights);
/* Notes the forces at the end of the last step. */
void bead_heights_step(struct bead_heights *heights, const struct bead_stepper *stepper);
/* The largest force of a contact, or of a bead, N: from the part that contains `time` on, or from the next one if that part begins
 * before `not_before`; 0: none. */
double bead_heights_after(const struct bead_heights *heights, bool of_bead, size_t index, double time, double not_before);
