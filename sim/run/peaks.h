/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks: the largest maximum of every contact's or bead's force, found within the steps.
 *
 * A maximum lies where the rate of the force changes its sign within a step; its time and height follow from the septic Hermite
 * interpolant of the compressions, whose error is far below that of the step. The force of a contact with damping jumps where it
 * closes: the peak is the largest value on either side. */
#pragma once

#include <stdbool.h>

#include "beadreel/error.h"
#include "beadreel/sink.h"
#include "sim/integrate/stepper.h"

struct bead_peaks;

/* of_beads: mean of a bead's two contact forces; else contact forces. Only those in `span` are searched. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_peaks_create(const struct bead_stepper *stepper, bool of_beads, struct bead_span span,
                                             struct bead_peaks **peaks, struct bead_message *msg);
/* Also keeps a rival of each, which a change of the chain may make the highest: the last maximum above half the highest, which
 * responds most strongly, or the one before the highest if that is the last. Call it before the first step. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_peaks_keep_rivals(struct bead_peaks *peaks, const struct bead_stepper *stepper,
                                                  struct bead_message *msg);
/* Also keeps the second highest maximum of each, if it is nearly as high: errors of the run may have made it lower. Maxima less
 * than `apart` seconds after the highest count as the same. Call it before the first step. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_peaks_keep_second(struct bead_peaks *peaks, const struct bead_stepper *stepper, double apart,
                                                  struct bead_message *msg);
void bead_peaks_destroy(struct bead_peaks *peaks);
/* Searches the last step; maxima after time `limit` do not count. When the step contains `limit`, forces still rising then are
 * marked as open; these are followed until `over`, and are no longer open after a maximum.
 * Forces above their peaks at the end of a later step mark these as exceeded. */
void bead_peaks_step(struct bead_peaks *peaks, const struct bead_stepper *stepper, double limit, double over);
/* [contacts] or [beads]. */
const struct bead_peak *bead_peaks_found(const struct bead_peaks *peaks);
/* The rivals, if they are kept (else NULL); time NaN: none. */
const struct bead_peak *bead_peaks_rivals(const struct bead_peaks *peaks);
/* The second highest; NULL and NaN as above. */
const struct bead_peak *bead_peaks_second(const struct bead_peaks *peaks);
