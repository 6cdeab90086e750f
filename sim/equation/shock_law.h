/* SPDX-License-Identifier: GPL-3.0-or-later */
/* u_tt = c^2 u_xx (1 + e u_x), the thesis's Appendix 2, as conservation laws of the strain r = u_x and the velocity v = u_t:
 * r_t = v_x, v_t = s(r)_x with the stress s = c^2 (r + e r^2 / 2). Waves run at +-a, a = c sqrt(1 + e r), while 1 + e r > 0.
 *
 * Riemann invariants: v - g(r) runs right, v + g(r) left, g the integral of a from 0 to r (R. J. LeVeque, Finite Volume Methods
 * for Hyperbolic Problems (2002), section 14.12, of which this is the p-system). */
#pragma once

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

/* g(r) = 2 c / (3 e) ((1 + e r)^(3/2) - 1), in a form that loses no digits for small e. */
static inline double bead_shock_g(const struct bead_equation_spec *spec, double r)
{
    double y = sqrt(1 + spec->epsilon * r);
    return 2. / 3 * spec->speed * r * (y * y + y + 1) / (y + 1);
}

/* Kinetic and elastic energy per length; convex, so shocks can only lose it. */
static inline double bead_shock_energy(const struct bead_equation_spec *spec, double r, double v)
{
    double c2 = spec->speed * spec->speed;
    return 0.5 * v * v + c2 * r * r * (0.5 + spec->epsilon * r / 6);
}

/* Means of r and v at time 0 over the cells of a grid: r by `start`; v = 0, or such that one invariant is 0 everywhere and the wave
 * runs one way (a simple wave). */
void bead_shock_start(const struct bead_equation_spec *spec, size_t cells, double *r, double *v);

/* Extra cells on both sides in the scratch memory of the rates. */
enum { BEAD_SHOCK_GHOSTS = 3 };

/* Square of the second differences of a smooth start on a grid, which must not count as shocks. */
double bead_shock_smooth(const struct bead_equation_spec *spec, double dx);

/* Rates of r and v of cells of length dx on a ring; `work` has 4 (cells + 2 BEAD_SHOCK_GHOSTS) numbers. */
void bead_shock_rates(const struct bead_equation_spec *spec, size_t cells, double dx, double smooth, const double *r,
                      const double *v, double *r_rate, double *v_rate, double *work);
