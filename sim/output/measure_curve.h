/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves through equally spaced samples: the polynomial through a few of them. */
#ifndef BEADREEL_SIM_OUTPUT_MEASURE_CURVE_H
#define BEADREEL_SIM_OUTPUT_MEASURE_CURVE_H

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
/* Where it takes `value` between low and high, at which it lies on different sides of it. */
double bead_curve_crossing(const struct bead_curve *curve, double value, double low, double high);
/* Its maximum between low and high, where its slope is positive and not; returns the place. */
double bead_curve_maximum(const struct bead_curve *curve, double low, double high);

/* Place of the maximum of `count` values (not the first or last of them), in units of the index, and its value. */
double bead_samples_maximum(const double *values, size_t count, double *largest);
/* First place outwards from index `from`, in steps of -1 or 1, where the values fall to `level`; NaN: they do not. */
double bead_samples_crossing(const double *values, size_t count, size_t from, int step, double level);

#endif
