/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the ends of a step: corrects interpolation where a contact opens or closes in the step, or nearly does.
 *
 * A force d^p, d > 0, has a branch point where d crosses zero: at a distance y from it beads move like y^{p+2}. The Hermite
 * interpolants of dense output cannot represent that; near a branch point their error is 1e-3 h f/m, with f the force one step
 * away, however accurate the step. The patches of events.h know the force: on each of their pieces it is a polynomial in z, the
 * variable that removes the branch point, so its integral and double integral F over time are polynomials too. Interpolation
 * replaces F by a Hermite polynomial H; the correction of the two beads is F - H, over the masses and with opposite signs. */
#pragma once

#include "sim/integrate/stepper.h"

struct bead_between;

/* A branch point: a contact opens or closes, or is about to. */
struct bead_between_point {
    size_t contact;
    double at; /* in steps from the start */
};

/* For steps of this stepper; NULL with damping, if no contact opens, or if the force does not begin as a power. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_between_create(const struct bead_stepper *stepper, struct bead_between **between,
                                               struct bead_message *msg);
void bead_between_destroy(struct bead_between *between);
/* Finds the contacts of a part of the beads in the last step that may change a velocity by more than `tolerance`, m/s. NULL is
 * allowed. */
void bead_between_find(struct bead_between *between, const struct bead_stepper *stepper, struct bead_part part, double tolerance);
/* Their branch points, in the order of contacts. */
const struct bead_between_point *bead_between_points(const struct bead_between *between, size_t *count);
/* m of s = tau +- x^m: forces next to a branch point tau are smooth in x. */
int bead_between_power(const struct bead_between *between);
/* Corrects interpolated displacements u at t0 + x h, and velocities v (NULL: none), of a part of the beads. */
void bead_between_correct(const struct bead_between *between, const struct bead_stepper *stepper, double x, struct bead_part part,
                          double *u, double *v);
/* As above for the interpolated compression d[0] of a contact, m, and its derivative d[1] by x. */
void bead_between_correct_compression(const struct bead_between *between, const struct bead_stepper *stepper, size_t contact,
                                      double x, double d[2]);
/* ... and for the interpolated displacement u[0] of a bead, m, and its derivative u[1] by x. */
void bead_between_correct_bead(const struct bead_between *between, const struct bead_stepper *stepper, size_t bead, double x,
                               double u[2]);
/* True if memory ran out: there are no more corrections. NULL is allowed: false. */
bool bead_between_failed(const struct bead_between *between);
