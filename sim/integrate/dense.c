/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense output: interpolates states, compressions and forces between the ends of a step, for samples, peaks and the front. */
#include "sim/integrate/dense.h"
#include "sim/base/memory.h"

#include <stdlib.h>

/* Times this close to an end of the step, in units of its length, count as that end. */
static const double same_time = 1e-9;

enum bead_error bead_dense_create(const struct bead_stepper *s, struct bead_dense *dense, struct bead_message *msg)
{
    const size_t padding = 16;
    *dense = (struct bead_dense){.septic = !bead_stepper_damped(s)};
    if (!dense->septic)
        return BEAD_OK;
    BEAD_TRY(bead_new(&dense->memory, 3 * (s->beads + padding), msg, "the samples of %zu beads", s->beads));
    dense->jerk[0] = dense->memory;
    dense->jerk[1] = dense->memory + s->beads + padding;
    dense->rate = dense->memory + 2 * (s->beads + padding); /* the element before it is 0 */
    return bead_between_create(s, &dense->between, msg);
}

void bead_dense_destroy(struct bead_dense *dense)
{
    free(dense->memory);
    bead_between_destroy(dense->between);
    *dense = (struct bead_dense){0};
}

/* Time derivatives of the accelerations, from the rates of the forces. */
static void find_jerks(const struct bead_dense *dense, const struct bead_stepper *s, const struct bead_state *state, double *jerk)
{
    const size_t n = s->active;
    double *rate = dense->rate;
    if (s->chain->law->hertz) {
        s->kernels->hertz_stiffness(n, &s->table, state->u, state->u, 0, jerk);
        s->kernels->springs(n, jerk, state->v, rate);
    } else {
        for (size_t k = 0; k < n; k++)
            rate[k] = bead_dense_force_rate(s, state, k);
    }
    s->kernels->accelerations(n, rate, s->chain->inverse_mass, jerk);
    for (size_t j = 0; s->pull && j < n; j++)
        jerk[j] -= s->pull[j] * state->v[j];
    if (s->driven != SIZE_MAX)
        bead_drive_apply(s->chain, state == &s->start ? s->t0 : bead_drive_end(s->chain, s->t0, s->t1), 1, jerk);
}

static void update_jerks(struct bead_dense *dense, const struct bead_stepper *s)
{
    if (dense->step == s->steps)
        return;
    double *spare = dense->jerk[0];
    dense->jerk[0] = dense->jerk[1];
    dense->jerk[1] = spare;
    const bool back = dense->step == s->steps + 1; /* over recorded steps: this one ends where the one before began */
    if (dense->step + 1 != s->steps || s->steps == 1 || s->driven != SIZE_MAX) /* a drive may jump between steps */
        find_jerks(dense, s, &s->start, dense->jerk[0]);
    if (!back)
        find_jerks(dense, s, &s->end, dense->jerk[1]);
    dense->step = s->steps;
}

void bead_dense_find_events(struct bead_dense *dense, const struct bead_stepper *s)
{
    if (!dense->between || dense->between_step == s->steps)
        return;
    bead_between_find(dense->between, s, (struct bead_part){0, s->active}, s->event_tolerance);
    dense->between_step = s->steps;
}

/* Weights of the derivatives u0, v0, a0, j0, u1, v1, a1, j1 at both ends in the interpolant at x; the weight of u0 (v0) in the
 * displacement (velocity) is less by 1, which is the base of the sum. */
enum { U0, V0, A0, J0, U1, V1, A1, J1, WEIGHTS };

static void quintic(double x, double h, double value[WEIGHTS], double rate[WEIGHTS])
{
    const double x2 = x * x, x3 = x2 * x, y = 1 - x, y2 = y * y, one = x3 * (10 - 15 * x + 6 * x2), slope = 30 * x2 * y2 / h;
    const double u[WEIGHTS] = {-one, h * x * y * y2 * (1 + 3 * x), 0.5 * h * h * x2 * y * y2, 0,
                               one,  -h * x3 * y * (4 - 3 * x),    0.5 * h * h * x3 * y2,     0};
    const double v[WEIGHTS] = {-slope, y2 * (1 + 2 * x - 15 * x2) - 1, 0.5 * h * x * y2 * (2 - 5 * x), 0,
                               slope,  x2 * (-12 + 28 * x - 15 * x2),  0.5 * h * x2 * y * (3 - 5 * x), 0};
    memcpy(value, u, sizeof u);
    memcpy(rate, v, sizeof v);
}

/* rate NULL: no velocities. */
static void septic(double x, double h, double value[WEIGHTS], double rate[WEIGHTS])
{
    const double h2 = h * h, h3 = h2 * h, x2 = x * x, x3 = x2 * x, x4 = x2 * x2, y = 1 - x, y2 = y * y, y3 = y2 * y, y4 = y2 * y2;
    const double one = x4 * (35 - 84 * x + 70 * x2 - 20 * x3), slope = 140 * x3 * y3 / h;
    const double u[WEIGHTS] = {-one, h * x * y4 * (1 + 4 * x + 10 * x2),    0.5 * h2 * x2 * y4 * (1 + 4 * x), h3 / 6 * x3 * y4,
                               one,  -h * x4 * y * (15 - 24 * x + 10 * x2), 0.5 * h2 * x4 * y2 * (5 - 4 * x), -h3 / 6 * x4 * y3};
    memcpy(value, u, sizeof u);
    if (!rate)
        return;
    const double v[WEIGHTS] = {
        -slope, y3 * (1 + 3 * x + 6 * x2 - 70 * x3) - 1,   h * x * y3 * (1 + 3 * x - 14 * x2),   h2 / 6 * x2 * y3 * (3 - 7 * x),
        slope,  x3 * (-60 + 195 * x - 204 * x2 + 70 * x3), h * x3 * y * (10 - 25 * x + 14 * x2), h2 / 6 * x3 * y2 * (7 * x - 4)};
    memcpy(rate, v, sizeof v);
}

static void combine(const struct bead_dense *dense, const struct bead_stepper *s, const double weight[WEIGHTS], const double *base,
                    struct bead_part part, double *y)
{
    const size_t from = part.from;
    const double *all[WEIGHTS] = {s->start.u, s->start.v, s->start.a, dense->jerk[0],
                                  s->end.u,   s->end.v,   s->last_a,  dense->jerk[1]};
    const double *term[WEIGHTS];
    double coefficient[WEIGHTS];
    size_t count = 0;
    for (size_t i = 0; i < WEIGHTS; i++) {
        if (i == V0 || !all[i])
            continue;
        coefficient[count] = weight[i];
        term[count++] = all[i] + from;
    }
    s->kernels->combine(part.to - from, y + from, base + from, weight[V0], s->start.v + from, count, coefficient, term);
}

void bead_dense_displacement(struct bead_dense *dense, const struct bead_stepper *s, double x, struct bead_part part, double *u)
{
    double value[WEIGHTS];
    if (x <= same_time || x >= 1 - same_time) {
        const double *end = x <= same_time ? s->start.u : s->end.u;
        memcpy(u + part.from, end + part.from, (part.to - part.from) * sizeof *u);
        return;
    }
    update_jerks(dense, s);
    septic(x, s->h, value, NULL);
    combine(dense, s, value, s->start.u, part, u);
}

void bead_dense_state(struct bead_dense *dense, const struct bead_stepper *s, double t, double *u, double *v)
{
    const struct bead_part all = {0, s->active};
    double h = s->h, x = h > 0 ? (t - s->t0) / h : 1, value[WEIGHTS], rate[WEIGHTS];
    if (x >= 1 - same_time || x <= same_time) {
        const struct bead_state *end = x <= same_time ? &s->start : &s->end;
        memcpy(u, end->u, s->active * sizeof *u);
        memcpy(v, end->v, s->active * sizeof *v);
        return;
    }
    if (dense->septic)
        update_jerks(dense, s);
    (dense->septic ? septic : quintic)(x, h, value, rate);
    combine(dense, s, value, s->start.u, all, u);
    combine(dense, s, rate, s->start.v, all, v);
    if (!dense->septic)
        return;
    bead_dense_find_events(dense, s);
    bead_between_correct(dense->between, s, x, all, u, v);
}

double bead_dense_force_rate(const struct bead_stepper *s, const struct bead_state *state, size_t k)
{
    double a = s->table.stiffness[k];
    if (!(a > 0))
        return 0;
    return s->chain->law->stiffness(a, s->table.law, bead_stepper_compression(s, state, k)) * (state->v[k] - state->v[k + 1]);
}

/* u''' of bead j; the wall (j = beads) does not move. */
static double jerk(const struct bead_stepper *s, const struct bead_state *state, size_t j)
{
    if (j >= s->beads)
        return 0;
    double before = j > 0 ? bead_dense_force_rate(s, state, j - 1) : 0;
    double jerk = (before - bead_dense_force_rate(s, state, j)) * s->chain->inverse_mass[j], driven[2];
    if (s->pull)
        jerk -= s->pull[j] * state->v[j];
    if (j != s->driven)
        return jerk;
    bead_drive_acceleration(s->chain, state == &s->start ? s->t0 : bead_drive_end(s->chain, s->t0, s->t1), driven);
    return s->chain->spec->drive.displacement ? driven[1] : jerk + driven[1];
}

static void derivatives(const struct bead_stepper *s, const struct bead_state *state, const double *a, size_t k, double out[4])
{
    const double h = s->h;
    out[0] = bead_stepper_compression(s, state, k);
    out[1] = h * (state->v[k] - state->v[k + 1]);
    out[2] = h * h * (a[k] - a[k + 1]);
    out[3] = h * h * h * (jerk(s, state, k) - jerk(s, state, k + 1));
}

static struct bead_polynomial between(const struct bead_stepper *s, const double at0[4], const double at1[4])
{
    return bead_stepper_damped(s) ? bead_polynomial_quintic(at0, at1) : bead_polynomial_hermite(at0, at1);
}

struct bead_polynomial bead_dense_compression(const struct bead_stepper *s, size_t k)
{
    double at0[4], at1[4];
    derivatives(s, &s->start, s->start.a, k, at0);
    derivatives(s, &s->end, s->last_a, k, at1);
    return between(s, at0, at1);
}

struct bead_polynomial bead_dense_bead(const struct bead_stepper *s, size_t j)
{
    const double h = s->h, square = h * h, cube = square * h;
    const double at0[4] = {s->start.u[j], h * s->start.v[j], square * s->start.a[j], cube * jerk(s, &s->start, j)};
    const double at1[4] = {s->end.u[j], h * s->end.v[j], square * s->last_a[j], cube * jerk(s, &s->end, j)};
    return between(s, at0, at1);
}
