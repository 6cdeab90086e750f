/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polynomials over a step, and zeros within it. */
#pragma once

/* A polynomial in 0 <= x <= 1 over the step: sum c_i x^i. */
struct bead_polynomial {
    double c[8];
};
/* The septic through value and three derivatives (with respect to x) at 0 and 1. */
struct bead_polynomial bead_polynomial_hermite(const double at0[4], const double at1[4]);
/* The quintic through value and two derivatives. */
struct bead_polynomial bead_polynomial_quintic(const double at0[3], const double at1[3]);
double bead_polynomial_value(const struct bead_polynomial *p, double x);
double bead_polynomial_slope(const struct bead_polynomial *p, double x);
/* The smallest x in [0, 1] at which the polynomial exceeds a limit; INFINITY: it never does. It misses no maximum. */
double bead_polynomial_first_above(const struct bead_polynomial *p, double limit);
/* A zero of `f` between 0 and 1, where f(0) and f(1) have different signs, to rounding (Illinois's false position). */
typedef double (*bead_function)(const void *context, double x);
double bead_find_root(bead_function f, const void *context, double f0, double f1);
