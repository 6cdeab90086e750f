/* Contact-event correction: repairs a Nystrom step near contacts that open or close.
 *
 * The force d_+^{3/2} has a branch point where a contact opens or closes; every quadrature of smooth functions
 * stalls there. After a step made as if nothing happened, the few contacts near an event are integrated again on
 * their own, with the branch point taken out by a substitution, and the difference of the impulses is given to
 * their two beads. Momentum is conserved to rounding. */
#ifndef BEADREEL_SIM_EVENTS_H
#define BEADREEL_SIM_EVENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"

struct bead_stepper;
struct bead_events;

/* For steps of this stepper; NULL where no contact opens (two-sided laws). Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_events_create(const struct bead_stepper *stepper, struct bead_events **events,
                                              struct bead_message *msg);
/* NULL is allowed. */
void bead_events_destroy(struct bead_events *events);
/* Correct end.u, end.v, end.a, end.f of the step just made. Reads stage_f. Sets event_change. Contacts that
 * event_tolerance lets pass stay as they are. Forces that depend on velocities are beyond Nystrom methods, and so
 * beyond this correction. */
void bead_events_correct(struct bead_events *events, struct bead_stepper *stepper);
/* Compression d[0] of a contact, m, and its derivative d[1] by x, at time t0 + x h (0 < x <= 1) of the step made last, as exactly
 * as the step itself: an opening or closing nearby leaves a kink in d'' that no interpolation of the ends can know. False where
 * nothing opens or closes nearby (interpolate then), or where memory is short. Works with memory of `events`. */
bool bead_events_compression(struct bead_events *events, const struct bead_stepper *stepper, size_t contact, double x, double d[2]);
/* Whether memory for a correction could not be had: some step since then is not corrected. NULL is allowed: false. */
bool bead_events_failed(const struct bead_events *events);

#endif
