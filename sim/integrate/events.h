/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact-event correction: repairs a Nystrom step near contacts that open or close.
 *
 * The force A d_+^{3/2} has a branch point where d crosses zero, which reduces every quadrature of smooth functions to order 5/2,
 * whatever its order elsewhere. The method ignores that. After its step:
 *
 * 1. Contacts are flagged that open or close within the step, graze, or have a branch point so near outside that it changes a
 *    velocity by more than a tolerance. Those that open or close just once are kinks, whose correction is known in closed form
 *    (events_kinks.h). If that is not accurate enough for the tolerance:
 * 2. Flagged contacts, and one more on either side whose motion they disturb, form patches; the next ones are frozen: their
 *    forces are those of the quintic Hermite interpolant of d over the step.
 * 3. The interpolant's zeros tau split the step. Next to tau f is analytic in x where t = tau +- x^2 (x^3 for d^{3/2}, and
 *    another power for another law), so 8 Gauss nodes in x integrate it to rounding.
 * 4. Picard iteration removes the interpolation error from d: with F_k the forces integrated twice over time,
 *    d_k(t) = d_k + t d_k' + F_{k-1}/m_k - F_k (1/m_k + 1/m_{k+1}) + F_{k+1}/m_{k+1}, then f_k(t) = A_k d_k(t)_+^{3/2}. Twice, or
 *    until it changes little.
 * 5. The impulse of each contact, int f dt, and its moment, int (t1 - t) f dt, replace those of the method's quadrature, with
 *    opposite signs on its two beads: momentum is conserved to rounding.
 * 6. Forces at the end of the step are computed again where beads have moved: the next step begins with them.
 *
 * Beads at rest are never touched, so the window does not change a bit; times are counted in steps, so the exact scaling of Hertz's
 * chain holds to the bit. Files: events_flags.c flags contacts, events.c chooses their corrections, events_patch.c integrates
 * patches, events_roots.c finds branch points, events_quadrature.c has the nodes; events_flags_body.h, events_load_body.h,
 * events_kinks_body.h and events_body.h have the vector loops, compiled for each instruction set. README.md compares the
 * mechanisms; between.h uses patches for the motion within steps. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"

struct bead_stepper;
struct bead_events;

/* For steps of this stepper; NULL if no contact opens (two-sided laws), or if forces do not begin as a power. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_events_create(const struct bead_stepper *stepper, struct bead_events **events,
                                              struct bead_message *msg);
/* Weighs the events of contacts that have been slower than the striker up to the end of the last step: a change that is small for
 * the striker's velocity may be large for theirs, and event_tolerance applies to a contact as fast as the striker. To be called
 * every few steps. NULL is allowed. */
void bead_events_weigh(struct bead_events *events, const struct bead_stepper *stepper);
/* Contacts near an event in the last step, in ascending order. */
const size_t *bead_events_flagged(const struct bead_events *events, size_t *count);
/* Opens a contact for good: the beads before it have been dropped. */
void bead_events_open(struct bead_events *events, size_t contact);
/* NULL is allowed. */
void bead_events_destroy(struct bead_events *events);
/* Corrects end.u, end.v, end.a, end.f of the last step, except at contacts within event_tolerance. Reads stage_f, sets
 * event_change. Like Nystrom methods, for forces that do not depend on velocities. */
void bead_events_correct(struct bead_events *events, struct bead_stepper *stepper);
/* Compression d[0] of a contact, m, and its derivative d[1] by x, at time t0 + x h (0 < x <= 1) in the last step, as accurate as
 * the step itself: an event nearby leaves a kink in d'' that no interpolation between the ends can follow. False if no contact
 * nearby has an event above event_tolerance: interpolate then. Uses memory of `events`. */
bool bead_events_compression(struct bead_events *events, const struct bead_stepper *stepper, size_t contact, double x, double d[2]);
