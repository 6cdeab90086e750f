/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves through equally spaced samples: the polynomial through a few of them. */
#pragma once

#include <stddef.h>

enum { BEAD_CURVE_POINTS = 7 };

/* Newton's form through values at x = 0, 1, ..., count - 1. */
struct bead_curve {
    size_t count;
    double difference[BEAD_CURVE_POINTS];
};

/* count <= BEAD_CURVE_POINTS */
struct bead_curve bead_curve_through(const double *values, size_t count);
double bead_curve_value(const struct bead_curve *curve, double x);
/* Place of the maximum between low, where the slope is positive, and high, where it is not. */
double bead_curve_maximum(const struct bead_curve *curve, double low, double high);

/* Place of the maximum of `count` values (not the first or last of them), in units of the index, and its value. */
double bead_samples_maximum(const double *values, size_t count, double *largest);
/* First place, going from index `from` in steps of -1 or 1, at which the values fall to `level`; NaN: they do not. */
double bead_samples_crossing(const double *values, size_t count, size_t from, int step, double level);
