/* SPDX-License-Identifier: GPL-3.0-or-later */
/* u_tt = c^2 u_xx (1 + e u_x), the thesis's Appendix 2, as conservation laws of the strain r = u_x and the velocity v = u_t:
 * r_t = v_x, v_t = s(r)_x with the stress s = c^2 (r + e r^2 / 2). Waves run at +-a, a = c sqrt(1 + e r), while 1 + e r > 0.
 *
 * Riemann invariants: v - g(r) runs right, v + g(r) left, g the integral of a from 0 to r (R. J. LeVeque, Finite Volume Methods
 * for Hyperbolic Problems (2002), section 14.12, of which this is the p-system). */
#ifndef BEADREEL_SIM_EQUATION_SHOCK_LAW_H
#define BEADREEL_SIM_EQUATION_SHOCK_LAW_H

#include <math.h>
#include <stddef.h>

#include "beadreel/scene.h"

static inline double bead_shock_speed(const struct bead_equation_spec *spec, double r)
{
    return spec->speed * sqrt(1 + spec->epsilon * r);
}

static inline double bead_shock_stress(const struct bead_equation_spec *spec, double r)
{
    return spec->speed * spec->speed * (r + 0.5 * spec->epsilon * r * r);
}

/* g(r) = 2 c / (3 e) ((1 + e r)^(3/2) - 1), so written that small e lose no digits. */
static inline double bead_shock_g(const struct bead_equation_spec *spec, double r)
{
    double y = sqrt(1 + spec->epsilon * r);
    return 2. / 3 * spec->speed * r * (y * y + y + 1) / (y + 1);
}

/* Kinetic and elastic energy by length; convex, so shocks only lose it. */
static inline double bead_shock_energy(const struct bead_equation_spec *spec, double r, double v)
{
    double c2 = spec->speed * spec->speed;
    return 0.5 * v * v + c2 * r * r * (0.5 + spec->epsilon * r / 6);
}

/* Means of r and v at time 0 over the cells of a grid: r as `start` says; v = 0, or such that one invariant is 0 everywhere and
 * the wave goes one way (a simple wave). */
void bead_shock_start(const struct bead_equation_spec *spec, size_t cells, double *r, double *v);

/* Scratch of the rates: cells and `BEAD_SHOCK_GHOSTS` more on both sides. */
enum { BEAD_SHOCK_GHOSTS = 3 };

/* Square of the second differences that a smooth start has on a grid: not to be taken for shocks. */
double bead_shock_smooth(const struct bead_equation_spec *spec, double dx);

/* Rates of r and v of cells of length dx on a ring; `work` has 4 (cells + 2 BEAD_SHOCK_GHOSTS) numbers. */
void bead_shock_rates(const struct bead_equation_spec *spec, size_t cells, double dx, double smooth, const double *r,
                      const double *v, double *r_rate, double *v_rate, double *work);

#endif
