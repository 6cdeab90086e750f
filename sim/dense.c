#include "sim/dense.h"

#include <math.h>
#include <string.h>

/* Times this close to an end of the step, as a fraction of it, are that end. */
static const double same_time = 1e-9;

static void combine_state(const struct bead_stepper *s, const double weight[5], double scale, double *y, const double *base)
{
    const double *term[5] = {s->start.u, s->start.a, s->end.u, s->end.v, s->end.a};
    s->kernels->combine(s->active, y, base, scale, s->start.v, 5, weight, term);
}

void bead_dense_state(const struct bead_stepper *s, double t, double *u, double *v)
{
    double h = s->h, x = h > 0 ? (t - s->t0) / h : 1;
    if (x >= 1 - same_time || x <= same_time) {
        const struct bead_state *end = x <= same_time ? &s->start : &s->end;
        if (u)
            memcpy(u, end->u, s->active * sizeof *u);
        if (v)
            memcpy(v, end->v, s->active * sizeof *v);
        return;
    }
    double x2 = x * x, x3 = x2 * x, y = 1 - x, y2 = y * y;
    if (u) {
        /* 1 of u0 is the base of the sum, so its weight here is the quintic's less 1: minus that of u1. */
        double one = x3 * (10 - 15 * x + 6 * x2);
        double weight[5] = {-one, 0.5 * h * h * x2 * y * y2, one, -h * x3 * y * (4 - 3 * x), 0.5 * h * h * x3 * y2};
        combine_state(s, weight, h * x * y * y2 * (1 + 3 * x), u, s->start.u);
    }
    if (v) {
        double one = 30 * x2 * y2 / h;
        double weight[5] = {-one, 0.5 * h * x * y2 * (2 - 5 * x), one, x2 * (-12 + 28 * x - 15 * x2),
                            0.5 * h * x2 * y * (3 - 5 * x)};
        /* Likewise the weight of v0 less 1. */
        combine_state(s, weight, y2 * (1 + 2 * x - 15 * x2) - 1, v, s->start.v);
    }
}

struct bead_polynomial bead_polynomial_hermite(const double at0[4], const double at1[4])
{
    double c0 = at0[0], c1 = at0[1], c2 = at0[2] / 2, c3 = at0[3] / 6;
    double r0 = at1[0] - (c0 + c1 + c2 + c3), r1 = at1[1] - (c1 + 2 * c2 + 3 * c3), r2 = at1[2] - (2 * c2 + 6 * c3),
           r3 = at1[3] - 6 * c3;
    return (struct bead_polynomial){{c0, c1, c2, c3, 35 * r0 - 15 * r1 + 2.5 * r2 - r3 / 6, -84 * r0 + 39 * r1 - 7 * r2 + r3 / 2,
                                     70 * r0 - 34 * r1 + 6.5 * r2 - r3 / 2, -20 * r0 + 10 * r1 - 2 * r2 + r3 / 6}};
}

double bead_polynomial_value(const struct bead_polynomial *p, double x)
{
    double value = p->c[7];
    for (int i = 6; i >= 0; i--)
        value = value * x + p->c[i];
    return value;
}

double bead_polynomial_slope(const struct bead_polynomial *p, double x)
{
    double slope = 7 * p->c[7];
    for (int i = 6; i >= 1; i--)
        slope = slope * x + i * p->c[i];
    return slope;
}

double bead_find_root(bead_function f, const void *context, double f0, double f1)
{
    double low = 0, high = 1;
    int kept = 0; /* the end that stayed last time, -1 low, +1 high: its value is halved when it stays again */
    for (int i = 0; i < 60 && high - low > 1e-15; i++) {
        double x = f1 == f0 ? 0.5 : low - f0 * (high - low) / (f1 - f0);
        if (!(x > low && x < high) || i % 8 == 7)
            x = 0.5 * (low + high);
        double fx = f(context, x);
        if (fx == 0)
            return x;
        if ((fx > 0) == (f1 > 0)) {
            high = x;
            f1 = fx;
            f0 *= kept < 0 ? 0.5 : 1;
            kept = -1;
        } else {
            low = x;
            f0 = fx;
            f1 *= kept > 0 ? 0.5 : 1;
            kept = 1;
        }
    }
    return 0.5 * (low + high);
}

static double compression(const struct bead_stepper *s, const struct bead_state *state, size_t k)
{
    return s->chain->static_compression[k] + (state->u[k] - state->u[k + 1]);
}

double bead_dense_force_rate(const struct bead_stepper *s, const struct bead_state *state, size_t k)
{
    double a = s->table.stiffness[k];
    if (!(a > 0))
        return 0;
    return s->chain->law->stiffness(a, s->table.law, compression(s, state, k)) * (state->v[k] - state->v[k + 1]);
}

/* u''' of bead j; the wall (j = beads) does not move. */
static double jerk(const struct bead_stepper *s, const struct bead_state *state, size_t j)
{
    if (j >= s->beads)
        return 0;
    double before = j > 0 ? bead_dense_force_rate(s, state, j - 1) : 0;
    return (before - bead_dense_force_rate(s, state, j)) * s->chain->inverse_mass[j];
}

static void derivatives(const struct bead_stepper *s, const struct bead_state *state, size_t k, double h, double out[4])
{
    out[0] = compression(s, state, k);
    out[1] = h * (state->v[k] - state->v[k + 1]);
    out[2] = h * h * (state->a[k] - state->a[k + 1]);
    out[3] = h * h * h * (jerk(s, state, k) - jerk(s, state, k + 1));
}

struct bead_polynomial bead_dense_compression(const struct bead_stepper *s, size_t k)
{
    double h = s->h, at0[4], at1[4];
    derivatives(s, &s->start, k, h, at0);
    derivatives(s, &s->end, k, h, at1);
    return bead_polynomial_hermite(at0, at1);
}
