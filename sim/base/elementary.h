/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that are called often, made of sums, products, quotients and square roots of double only: they give the same bits on
 * every processor, while the C library's results depend on whether it uses fused multiply-adds. */
#pragma once

#include "sim/base/internal.h"

double bead_log(double x);                      /* ln x, to 2 units in the last place */
double bead_cbrt(double x);                     /* cube root, x >= 0; rounded correctly except for one case in 2^45 */
BEAD_INTERNAL double bead_two_fifths(double x); /* x^{2/5}, x >= 0; the same */
double bead_three_halves(double x);             /* x^{3/2}, x >= 0; the same */

/* A number of twice the digits: a sum of two, the second no more than half a unit in the last place of the first. */
struct bead_pair {
    double high, low;
};
struct bead_pair bead_pair_times(struct bead_pair a, double b); /* to 2^-100 of the product */
/* Cosine and sine of an angle below 2^50, to 2^-53. */
void bead_turn_to(struct bead_pair angle, double *cosine, double *sine);
