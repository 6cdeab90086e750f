/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The breaking wave on a grid: its start, and its rates of change. */
#include "sim/equation/shock_law.h"

#include "sim/base/wide.h"

/* ---- the start ---- */

static double strain(const struct bead_equation_spec *spec, double x)
{
    bead_wide phase = 2 * bead_wide_pi * spec->mode * ((x - spec->low) / spec->length);
    if (spec->start == BEAD_START_COSINE)
        return spec->amplitude * (double)bead_wide_cos(phase);
    if (spec->start == BEAD_START_SIMPLE_WAVE)
        return spec->amplitude * (double)bead_wide_sin(phase);
    double sum = 0;
    for (int image = -1; image <= 1; image++) /* pulses of the neighbouring periods */
        sum += bead_sech2((x + image * spec->length - spec->at) / spec->width);
    return spec->amplitude * sum;
}

static int direction(const struct bead_equation_spec *spec)
{
    if (spec->start == BEAD_START_SIMPLE_WAVE)
        return 1;
    if (spec->start == BEAD_START_COSINE || spec->moving == BEAD_MOVING_REST)
        return 0;
    return spec->moving == BEAD_MOVING_RIGHT ? 1 : -1;
}

void bead_shock_start(const struct bead_equation_spec *spec, size_t cells, double *r, double *v)
{
    /* Gauss's rule with three points, of the sixth order, one more than the solver. */
    static const double node[] = {-0.38729833462074170, 0, 0.38729833462074170}, weight[] = {5. / 18, 8. / 18, 5. / 18};
    double dx = spec->length / (double)cells;
    for (size_t i = 0; i < cells; i++) {
        r[i] = v[i] = 0;
        for (int g = 0; g < 3; g++) {
            double here = strain(spec, spec->low + dx * ((double)i + 0.5 + node[g]));
            r[i] += weight[g] * here;
            v[i] -= direction(spec) * weight[g] * bead_shock_g(spec, here);
        }
    }
}

double bead_shock_smooth(const struct bead_equation_spec *spec, double dx)
{
    const double never_zero = 1e-60;
    double length = spec->start == BEAD_START_PULSE ? spec->width : spec->length / (2 * (double)bead_wide_pi * (double)spec->mode);
    double difference = spec->speed * spec->amplitude * (dx / length) * (dx / length);
    return difference * difference + never_zero;
}

/* ---- rates ----
 *
 * Finite volumes: WENO of fifth order for the characteristic variables, and Rusanov's flux.
 *
 * R. Borges, M. Carmona, B. Costa, W. S. Don, J. Comput. Phys. 227, 3191 (2008) for the weights (WENO-Z); V. V. Rusanov, USSR
 * Comput. Math. Math. Phys. 1 (2), 304 (1962) for the flux. Roe's flux, which has the least viscosity, leaves
 * ripples behind a shock (T. W. Roberts, J. Comput. Phys. 90, 141 (1990)). A viscosity a quarter above the largest speed beside the
 * face leaves a third of them; more smears the shock and costs energy. */
static const double viscosity = 1.25;

/* The value at the right face of cell c from the means of five cells. Squares of differences below `smooth` count as smooth: in a
 * simple wave the other variable has an extremum everywhere, and at extrema WENO would lose its order (W.-S. Don, R. Borges, J.
 * Comput. Phys. 250, 347 (2013)). */
static inline __attribute__((always_inline)) double weno(double smooth, double a, double b, double c, double d, double e)
{
    double p0 = (2 * a - 7 * b + 11 * c) * (1. / 6), p1 = (-b + 5 * c + 2 * d) * (1. / 6), p2 = (2 * c + 5 * d - e) * (1. / 6);
    double s0 = a - 2 * b + c, s1 = b - 2 * c + d, s2 = c - 2 * d + e;
    double t0 = a - 4 * b + 3 * c, t1 = b - d, t2 = 3 * c - 4 * d + e;
    double b0 = 13. / 12 * s0 * s0 + 0.25 * t0 * t0 + smooth;
    double b1 = 13. / 12 * s1 * s1 + 0.25 * t1 * t1 + smooth;
    double b2 = 13. / 12 * s2 * s2 + 0.25 * t2 * t2 + smooth;
    double tau = fabs(b0 - b2), q0 = tau / b0, q1 = tau / b1, q2 = tau / b2;
    double w0 = 0.1 * (1 + q0 * q0), w1 = 0.6 * (1 + q1 * q1), w2 = 0.3 * (1 + q2 * q2);
    return (w0 * p0 + w1 * p1 + w2 * p2) / (w0 + w1 + w2);
}

static void copy_with_ghosts(size_t n, const double *from, double *to)
{
    memcpy(to + BEAD_SHOCK_GHOSTS, from, n * sizeof *from);
    for (size_t i = 0; i < BEAD_SHOCK_GHOSTS; i++) {
        to[i] = from[n - BEAD_SHOCK_GHOSTS + i];
        to[n + BEAD_SHOCK_GHOSTS + i] = from[i];
    }
}

static inline __attribute__((always_inline)) double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The largest speed of four strains. */
static inline __attribute__((always_inline)) double fastest(const struct bead_equation_spec *spec, double a, double b, double c,
                                                            double d)
{
    const double sign = spec->epsilon < 0 ? -1 : 1; /* strain stiffens, or softens */
    return bead_shock_speed(spec, sign * larger(larger(sign * a, sign * b), larger(sign * c, sign * d)));
}

/* Fluxes of r and v through the right face of the cell at r[2], v[2] of six. */
static inline __attribute__((always_inline)) void flux(const struct bead_equation_spec *spec, double smooth, const double *r,
                                                       const double *v, double *flux_r, double *flux_v)
{
    double a = bead_shock_speed(spec, 0.5 * (r[2] + r[3])), right[6], left[6];
    for (int i = 0; i < 6; i++) {
        right[i] = v[i] - a * r[i];
        left[i] = v[i] + a * r[i];
    }
    double right_l = weno(smooth, right[0], right[1], right[2], right[3], right[4]);
    double right_r = weno(smooth, right[5], right[4], right[3], right[2], right[1]);
    double left_l = weno(smooth, left[0], left[1], left[2], left[3], left[4]);
    double left_r = weno(smooth, left[5], left[4], left[3], left[2], left[1]);
    double vl = 0.5 * (left_l + right_l), vr = 0.5 * (left_r + right_r);
    double rl = 0.5 * (left_l - right_l) / a, rr = 0.5 * (left_r - right_r) / a;
    double speed = viscosity * fastest(spec, r[2], r[3], rl, rr);
    *flux_r = -0.5 * (vl + vr) - 0.5 * speed * (rr - rl);
    *flux_v = -0.5 * (bead_shock_stress(spec, rl) + bead_shock_stress(spec, rr)) - 0.5 * speed * (vr - vl);
}

/* Apart from the rates, so that the compiler knows that nothing overlaps, and works on whole vectors of faces. */
static void fluxes(const struct bead_equation_spec *spec, double smooth, size_t n, const double *restrict r,
                   const double *restrict v, double *restrict flux_r, double *restrict flux_v)
{
    for (size_t i = 0; i < n; i++) /* face right of cell i - 1 */
        flux(spec, smooth, r + i, v + i, &flux_r[i], &flux_v[i]);
}

void bead_shock_rates(const struct bead_equation_spec *spec, size_t n, double dx, double smooth, const double *r, const double *v,
                      double *r_rate, double *v_rate, double *work)
{
    size_t all = n + 2 * BEAD_SHOCK_GHOSTS;
    double *rg = work, *vg = work + all, *fr = work + 2 * all, *fv = work + 3 * all;
    copy_with_ghosts(n, r, rg);
    copy_with_ghosts(n, v, vg);
    fluxes(spec, smooth, n, rg, vg, fr, fv);
    fr[n] = fr[0];
    fv[n] = fv[0];
    for (size_t i = 0; i < n; i++) {
        r_rate[i] = (fr[i] - fr[i + 1]) / dx;
        v_rate[i] = (fv[i] - fv[i + 1]) / dx;
    }
}
