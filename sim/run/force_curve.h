/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force curve: the force of a contact, or of a bead, over the step just made. */
#ifndef BEADREEL_SIM_RUN_FORCE_CURVE_H
#define BEADREEL_SIM_RUN_FORCE_CURVE_H

#include <stdbool.h>
#include <stddef.h>

#include "sim/integrate/dense.h"
#include "sim/integrate/stepper.h"

/* Of one contact, or the mean of a bead's two. Where a contact with damping closes the force jumps: steps end there, so a curve is
 * smooth, and has at either end the force that its step comes to. */
struct bead_force_curve {
    const struct bead_stepper *stepper;
    size_t count;
    size_t contact[2];
    struct bead_polynomial compression[2]; /* in 0 <= x <= 1 */
    double part;                           /* of the sum of their forces */
};

/* Of contact `index`, or of bead `index`. */
struct bead_force_curve bead_force_curve_of(const struct bead_stepper *stepper, size_t index, bool of_bead);
/* N, with the static part. */
double bead_force_curve_value(const struct bead_force_curve *curve, double x);
/* Has the sign of the force's rate. */
double bead_force_curve_rate(const struct bead_force_curve *curve, double x);

/* Where the force falls at both ends of a step, or rises, it may turn twice in between: so many parts are looked at. */
enum { BEAD_CURVE_PARTS = 8 };
/* The step from x = `from` on, or all of it: 0, 1. */
struct bead_curve_part {
    const struct bead_force_curve *curve;
    double from, length;
};
/* The x where the force turns, whose rates at the ends of the part have different signs. */
double bead_curve_part_turn(const struct bead_curve_part *part, double rate0, double rate1);

#endif
