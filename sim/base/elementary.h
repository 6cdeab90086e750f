/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that are called often, from additions, products, quotients and square roots of double alone: the same bits on every
 * processor, where those of the C library depend on whether it multiplies and adds at once. */
#ifndef BEADREEL_SIM_BASE_ELEMENTARY_H
#define BEADREEL_SIM_BASE_ELEMENTARY_H

double bead_log(double x);          /* ln x, to 2 units in the last place */
double bead_cbrt(double x);         /* cube root, x >= 0; rounded correctly but for one case in 2^45 */
double bead_two_fifths(double x);   /* x^{2/5}, x >= 0; the same */
double bead_three_halves(double x); /* x^{3/2}, x >= 0; the same */

#endif
