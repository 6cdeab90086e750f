/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force curve: the force of a contact, or of a bead, over the last step. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "sim/integrate/dense.h"
#include "sim/integrate/stepper.h"

/* The force of one contact, or the mean of a bead's two. The force jumps where a contact with damping closes; because steps end
 * there, a curve is smooth, and has the force within the step at its ends. */
struct bead_force_curve {
    const struct bead_stepper *stepper;
    size_t count;
    size_t contact[2];
    struct bead_polynomial compression[2]; /* in 0 <= x <= 1 */
    double part;                           /* factor of the sum of their forces */
};

/* The curve of contact `index`, or of bead `index`. */
struct bead_force_curve bead_force_curve_of(const struct bead_stepper *stepper, size_t index, bool of_bead);
/* Force including the static part, N. */
double bead_force_curve_value(const struct bead_force_curve *curve, double x);
/* A number with the sign of the force's rate. */
double bead_force_curve_rate(const struct bead_force_curve *curve, double x);

/* A force that falls at both ends of a step, or rises, may turn twice in between: parts that are searched separately. */
enum { BEAD_CURVE_PARTS = 8 };
/* A part of the step; 0, 1: all of it. */
struct bead_curve_part {
    const struct bead_force_curve *curve;
    double from, length;
};
/* The x at which the force turns, if its rates at the ends of the part have different signs. */
double bead_curve_part_turn(const struct bead_curve_part *part, double rate0, double rate1);
