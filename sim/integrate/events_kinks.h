/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinks: contacts that open or close once within a step, put right by what the method's quadrature owes them.
 *
 * Nearly all events are of this kind: the compression d crosses zero at tau, once and steeply. With x = s - tau (closing) or
 * tau - s (opening), Hertz's force there is C g, g = x^{3/2} (1 + e_1 x + e_2 x^2 + ...) for x > 0 and 0 before, C = A rho^{3/2},
 * rho = |d'(tau)|. To first order in g the step is wrong
 *
 * - in the impulse of the contact by what the quadrature makes of g: int g - sum bp_i g(c_i), and the like for its moment;
 * - in the displacements of its two beads at every stage by eps_i = sum_j a_ij g(c_j) - int (c_i - s) g ds, times C h^2/m, and so,
 *   through their stiffnesses K, in the forces of the contact and its neighbours.
 *
 * Both are sums over the stages, known once tau, rho, e_1 and e_2 are: no other node is needed, and kinks simply add up. tau comes
 * from the quintic Hermite interpolant, which g itself bends a little; that too is known to first order and taken out.
 * Seven digits are more than these formulas are good for: lengths are counted in units of the change of d, in single precision.
 * What is left is of second order, q^2 times the correction, q the largest h^2 K/m nearby; where that is too much, and where a
 * contact grazes, patches do it (events.h). */
#ifndef BEADREEL_SIM_INTEGRATE_EVENTS_KINKS_H
#define BEADREEL_SIM_INTEGRATE_EVENTS_KINKS_H

#include <stdbool.h>
#include <stddef.h>

struct bead_patch_source;

enum { BEAD_KINK_STAGES = 8 };
/* Of the method, in the digits that kinks are computed in. */
struct bead_kink_method {
    float c[BEAD_KINK_STAGES], a[BEAD_KINK_STAGES][BEAD_KINK_STAGES], b[BEAD_KINK_STAGES], bp[BEAD_KINK_STAGES];
};

/* What the quadrature owes contacts k - 1, k, k + 1 of each kink, over the step: of the impulse, int f dt, N s, and of its moment,
 * int (t1 - t) f dt, N s^2. */
struct bead_kinks {
    double *impulse[3], *moment[3];
    double *left; /* m/s: what is left undone of a velocity, an estimate; INFINITY: this is not a kink */
};

#endif
