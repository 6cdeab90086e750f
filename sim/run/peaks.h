/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks: the largest maximum of every contact's or bead's force, found between the steps.
 *
 * A maximum lies where the rate of the force changes its sign within a step; its place and height come from the
 * septic Hermite interpolant of the compressions, whose error is far below that of the step. Where a contact with damping closes
 * its force jumps: the peak is the largest value on either side. */
#ifndef BEADREEL_SIM_RUN_PEAKS_H
#define BEADREEL_SIM_RUN_PEAKS_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/sink.h"
#include "sim/integrate/stepper.h"

struct bead_peaks;

/* of_beads: mean of a bead's two contact forces; else contact forces. Only those in `span` are looked for. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_peaks_create(const struct bead_stepper *stepper, bool of_beads, struct bead_span span,
                                             struct bead_peaks **peaks, struct bead_message *msg);
void bead_peaks_destroy(struct bead_peaks *peaks);
/* Look at the step just made; maxima behind time `limit` do not count. Once `limit` lies within the step, the forces
 * still rising then are noted as open; these are followed until `over`, and open no more once they have had a maximum. */
void bead_peaks_step(struct bead_peaks *peaks, const struct bead_stepper *stepper, double limit, double over);
/* [contacts] or [beads]. */
const struct bead_peak *bead_peaks_found(const struct bead_peaks *peaks);

#endif
