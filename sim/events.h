/* Contact-event correction: repairs a Nystrom step near contacts that open or close.
 *
 * The force d_+^{3/2} has a branch point where a contact opens or closes; every quadrature of smooth functions
 * stalls there. After a step made as if nothing happened, the few contacts near an event are integrated again on
 * their own, with the branch point taken out by a substitution, and the difference of the impulses is given to
 * their two beads. Momentum is conserved to rounding. */
#ifndef BEADREEL_SIM_EVENTS_H
#define BEADREEL_SIM_EVENTS_H

#include <stdbool.h>

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
/* Whether memory for a correction could not be had: some step since then is not corrected. NULL is allowed: false. */
bool bead_events_failed(const struct bead_events *events);

#endif
