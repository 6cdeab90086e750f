/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinks: contacts that open or close once within a step, corrected by the error of the method's quadrature.
 *
 * Nearly all events are kinks: the compression d crosses zero at tau, once and steeply. With x = s - tau (closing) or
 * tau - s (opening), Hertz's force there is C g, g = x^{3/2} (1 + e_1 x + e_2 x^2 + ...) for x > 0 and 0 before, C = A rho^{3/2},
 * rho = |d'(tau)|. To first order in g the step has errors
 *
 * - in the impulse of the contact, by the quadrature of g: int g - sum bp_i g(c_i), and similarly in its moment;
 * - in the displacements of its two beads at every stage by eps_i = sum_j a_ij g(c_j) - int (c_i - s) g ds, times C h^2/m, and so,
 *   through their stiffnesses K, in the forces of the contact and its neighbours.
 *
 * Both are sums over the stages, known once tau, rho, e_1 and e_2 are: no other node is needed, and kinks simply add up. tau is
 * a zero of the quintic Hermite interpolant, which g itself bends a little; that too is known to first order and removed.
 * These formulas are accurate to less than seven digits: lengths are in units of the change of d, in single precision. The
 * remaining error is of second order, q^2 times the correction, with q the largest h^2 K/m nearby; if that is too much, or a
 * contact grazes, patches take over (events.h). */
#pragma once

struct bead_patch_source;

enum { BEAD_KINK_STAGES = 8 };
/* Coefficients of the method, in single precision. */
struct bead_kink_method {
    float c[BEAD_KINK_STAGES], a[BEAD_KINK_STAGES][BEAD_KINK_STAGES], b[BEAD_KINK_STAGES], bp[BEAD_KINK_STAGES];
};

/* Corrections of contacts k - 1, k, k + 1 of each kink over the step: of the impulse, int f dt, N s, and of its moment,
 * int (t1 - t) f dt, N s^2. */
struct bead_kinks {
    double *impulse[3], *moment[3];
    double *left; /* m/s: estimate of the remaining error of a velocity; INFINITY: not a kink */
};
