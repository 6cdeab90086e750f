/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact-event correction: repairs a Nystrom step near contacts that open or close.
 *
 * The force A d_+^{3/2} has a branch point where d crosses zero; there every quadrature of smooth functions falls to order 5/2,
 * whatever its order elsewhere. The step is made without regard to that. Then:
 *
 * 1. Contacts are flagged that open or close within the step, graze, or have a branch point so near outside that a velocity
 *    suffers by more than a tolerance.
 *    Those that open or close just once are kinks: what the step owes them is known in closed form (events_kinks.h). Where that is
 *    not good enough for the tolerance:
 * 2. Flagged contacts, and one more on either side whose motion they disturb, form patches; the next ones are frozen: their
 *    forces are those of the quintic Hermite interpolant of d over the step.
 * 3. The interpolant's zeros tau split the step. Next to tau f is analytic in x where t = tau +- x^2 (x^3 for d^{3/2}, and
 *    another power for another law), so 8 Gauss nodes in x integrate it to rounding.
 * 4. Picard's iteration takes the interpolation error out of d: with F_k the forces over m, integrated twice over time,
 *    d_k(t) = d_k + t d_k' + F_{k-1}/m_k - F_k (1/m_k + 1/m_{k+1}) + F_{k+1}/m_{k+1}, then f_k(t) = A_k d_k(t)_+^{3/2}. Twice, or
 * until it changes little.
 * 5. The impulse of each contact, int f dt, and its moment, int (t1 - t) f dt, take the place of what the method's quadrature
 *    made of them, with opposite signs on its two beads: momentum is conserved to rounding.
 * 6. Forces at the end of the step are computed again where beads have moved: the next step begins with them.
 *
 * Beads at rest are never touched, so the window changes no bit; times are counted in steps, so the exact scaling of Hertz's
 * chain holds to the bit. Files: events_flags.c says what to flag, events.c does the bookkeeping, events_roots.c finds branch
 * points, events_flags_body.h, events_load_body.h, events_kinks_body.h and events_body.h do what is worth vectors (compiled for
 * each instruction set), events_quadrature.c has the nodes and serves other powers. */
#ifndef BEADREEL_SIM_INTEGRATE_EVENTS_H
#define BEADREEL_SIM_INTEGRATE_EVENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"

struct bead_stepper;
struct bead_events;

/* For steps of this stepper; NULL where no contact opens (two-sided laws), or where the law has no exponent. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_events_create(const struct bead_stepper *stepper, struct bead_events **events,
                                              struct bead_message *msg);
/* From now on event_tolerance is meant for a contact whose rate has been as fast as the striker. Weigh the events of the slower
 * ones by how fast they have been up to the end of the step just made: what is small beside the striker's velocity may be much
 * beside theirs. To be called every few steps. NULL is allowed. */
void bead_events_weigh(struct bead_events *events, const struct bead_stepper *stepper);
/* Contacts near an event in the step just made, ascending. */
const size_t *bead_events_flagged(const struct bead_events *events, size_t *count);
/* NULL is allowed. */
void bead_events_destroy(struct bead_events *events);
/* Correct end.u, end.v, end.a, end.f of the step just made. Reads stage_f. Sets event_change. Contacts that
 * event_tolerance lets pass stay as they are. Forces that depend on velocities are beyond Nystrom methods, and so
 * beyond this correction. */
void bead_events_correct(struct bead_events *events, struct bead_stepper *stepper);
/* Compression d[0] of a contact, m, and its derivative d[1] by x, at time t0 + x h (0 < x <= 1) of the step made last, as exactly
 * as the step itself: an opening or closing nearby leaves a kink in d'' that no interpolation of the ends can know. False where
 * nothing opens or closes nearby that event_tolerance would mind (interpolate then), or where memory is short. Works with memory of
 * `events`. */
bool bead_events_compression(struct bead_events *events, const struct bead_stepper *stepper, size_t contact, double x, double d[2]);
/* Whether memory for a correction could not be had: some step since then is not corrected. NULL is allowed: false. */
bool bead_events_failed(const struct bead_events *events);

#endif
