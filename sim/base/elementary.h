/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that are called often, made of sums, products, quotients and square roots of double only: they give the same bits on
 * every processor, while the C library's results depend on whether it uses fused multiply-adds. */
#pragma once

#include "sim/base/internal.h"

double bead_log(double x);                      /* ln x, to 2 units in the last place */
double bead_cbrt(double x);                     /* cube root, x >= 0; rounded correctly but for one case in 2^45 */
BEAD_INTERNAL double bead_two_fifths(double x); /* x^{2/5}, x >= 0; the same */
double bead_three_halves(double x);             /* x^{3/2}, x >= 0; the same */
