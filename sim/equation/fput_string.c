/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The string of Fermi, Pasta, Ulam and Tsingou: its springs, starts, steps and dense output. fput.c makes a row of systems.c from
 * it. */
#include "sim/equation/fput_string.h"

#include <stdlib.h>

#include "sim/base/wide.h"
#include "sim/integrate/dense.h"

static bool periodic(const struct bead_string *s)
{
    return s->spec->ends == BEAD_ENDS_PERIODIC;
}

double bead_string_first(const struct bead_equation_spec *e)
{
    return e->ends == BEAD_ENDS_FIXED ? e->low + 1 : e->low;
}

double bead_string_branch(const struct bead_equation_spec *e, double r)
{
    const double beyond = e->piecewise.beyond;
    return !(beyond > 0) ? 0 : r > beyond ? 1 : r < -beyond ? -1 : 0;
}

/* The stiffness that a branch adds to 1. */
static double excess(const struct bead_equation_spec *e, double branch)
{
    return branch != 0 ? e->piecewise.stiffness - 1 : 0;
}

static double tension(const struct bead_equation_spec *e, double r)
{
    return r * (1 + r * (e->alpha + e->beta * r));
}

static double potential(const struct bead_equation_spec *e, double r)
{
    return r * r * (0.5 + r * (e->alpha / 3 + r * (e->beta / 4)));
}

double bead_string_slope(const struct bead_equation_spec *e, double branch, double r)
{
    return 1 + r * (2 * e->alpha + 3 * e->beta * r) + excess(e, branch);
}

/* Terms that a kink adds to the tension and to the energy of a spring. */
static double tension_beyond(const struct bead_equation_spec *e, double branch, double r)
{
    return excess(e, branch) * (r - branch * e->piecewise.beyond);
}

static double energy_beyond(const struct bead_equation_spec *e, double r)
{
    const double branch = bead_string_branch(e, r);
    return 0.5 * tension_beyond(e, branch, r) * (r - branch * e->piecewise.beyond);
}

double bead_string_spring_energy(const struct bead_string *s, double r)
{
    const struct bead_equation_spec *e = s->spec;
    double r0 = s->stretch, beyond = energy_beyond(e, r) - energy_beyond(e, r0);
    double rest = tension(e, r0) + tension_beyond(e, bead_string_branch(e, r0), r0);
    return potential(e, r) - potential(e, r0) - rest * (r - r0) + beyond;
}

double bead_string_energy(const struct bead_string *s, const double *u, const double *v)
{
    double sum = 0;
    for (size_t j = 0; j < s->masses; j++)
        sum += 0.5 * v[j] * v[j];
    for (size_t j = 0; j < s->springs; j++)
        sum += bead_string_spring_energy(s, bead_string_strain(s, u, j));
    return sum;
}

static void accelerate(struct bead_string_stepper *s, const double *u, double *a)
{
    const struct bead_string *string = &s->string;
    const struct bead_equation_spec *e = string->spec;
    size_t n = string->masses;
    double *T = string->tension, stretch = string->stretch;
    T[0] = tension(e, bead_string_strain(string, u, 0));
    for (size_t j = 1; j < n; j++)
        T[j] = tension(e, u[j] - u[j - 1] + stretch);
    T[n] = periodic(string) ? 0 : tension(e, bead_string_strain(string, u, n));
    for (size_t j = 0; e->piecewise.beyond > 0 && j < string->springs; j++)
        T[j] += tension_beyond(e, string->branch[j], bead_string_strain(string, u, j));
    if (periodic(string))
        T[n] = T[0];
    for (size_t j = 0; j < n; j++)
        a[j] = T[j + 1] - T[j];
    s->evaluations += n;
}

/* da/dt, for the interpolation between steps. */
static void find_jerk(const struct bead_string *s, const struct bead_string_state *at, double *jerk)
{
    const struct bead_equation_spec *e = s->spec;
    size_t n = s->masses;
    for (size_t j = 0; j <= n; j++) {
        size_t spring = j == n && periodic(s) ? 0 : j;
        double r = bead_string_strain(s, at->u, spring), left = spring > 0 ? at->v[spring - 1] : periodic(s) ? at->v[n - 1] : 0;
        double rate = bead_string_slope(e, s->branch[spring], r) * ((spring < n ? at->v[spring] : 0) - left);
        if (j > 0)
            jerk[j - 1] += rate;
        if (j < n)
            jerk[j] = -rate;
    }
}

/* ---- methods, from the tables of coefficients ---- */

static void nystrom(struct bead_string_stepper *s, double h)
{
    const struct bead_tableau *t = s->method->tableau;
    size_t n = s->string.masses;
    memcpy(s->stage[0], s->start.a, n * sizeof(double));
    for (size_t i = 1; i < t->stages; i++) {
        const double *row = t->a + i * t->stages;
        for (size_t k = 0; k < n; k++)
            s->y[k] = s->start.u[k] + t->c[i] * h * s->start.v[k];
        for (size_t j = 0; j < i; j++) {
            double c = h * h * row[j];
            for (size_t k = 0; c != 0 && k < n; k++)
                s->y[k] += c * s->stage[j][k];
        }
        accelerate(s, s->y, s->stage[i]);
    }
    for (size_t k = 0; k < n; k++) {
        double u = 0, v = 0;
        for (size_t j = 0; j < t->stages; j++) {
            u += t->b[j] * s->stage[j][k];
            v += t->bp[j] * s->stage[j][k];
        }
        s->end.u[k] = s->start.u[k] + h * (s->start.v[k] + h * u);
        s->end.v[k] = s->start.v[k] + h * v;
    }
    accelerate(s, s->end.u, s->end.a);
}

static void composition(struct bead_string_stepper *s, double h)
{
    const struct bead_composition *c = s->method->composition;
    size_t n = s->string.masses;
    bool kick = c->kick_first, fresh = true; /* fresh: end.a is that of end.u */
    memcpy(s->end.u, s->start.u, n * sizeof(double));
    memcpy(s->end.v, s->start.v, n * sizeof(double));
    memcpy(s->end.a, s->start.a, n * sizeof(double));
    for (size_t i = 0; i < c->count; i++, kick = !kick) {
        double by = c->coefficient[i] * h;
        if (kick && !fresh)
            accelerate(s, s->end.u, s->end.a);
        for (size_t k = 0; kick && k < n; k++)
            s->end.v[k] += by * s->end.a[k];
        for (size_t k = 0; !kick && k < n; k++)
            s->end.u[k] += by * s->end.v[k];
        fresh = kick;
    }
    if (!fresh)
        accelerate(s, s->end.u, s->end.a);
}

/* y + h k, element by element. */
static void add(size_t n, double *to, const double *y, double h, const double *k)
{
    for (size_t i = 0; i < n; i++)
        to[i] = y[i] + h * k[i];
}

static void runge_kutta(struct bead_string_stepper *s, double h)
{
    size_t n = s->string.masses;
    double *v2 = s->w[0], *v3 = s->w[1], *v4 = s->w[2], *a2 = s->stage[0], *a3 = s->stage[1], *a4 = s->stage[2];
    add(n, s->y, s->start.u, 0.5 * h, s->start.v);
    add(n, v2, s->start.v, 0.5 * h, s->start.a);
    accelerate(s, s->y, a2);
    add(n, s->y, s->start.u, 0.5 * h, v2);
    add(n, v3, s->start.v, 0.5 * h, a2);
    accelerate(s, s->y, a3);
    add(n, s->y, s->start.u, h, v3);
    add(n, v4, s->start.v, h, a3);
    accelerate(s, s->y, a4);
    for (size_t k = 0; k < n; k++) {
        s->end.u[k] = s->start.u[k] + h / 6 * (s->start.v[k] + 2 * (v2[k] + v3[k]) + v4[k]);
        s->end.v[k] = s->start.v[k] + h / 6 * (s->start.a[k] + 2 * (a2[k] + a3[k]) + a4[k]);
    }
    accelerate(s, s->end.u, s->end.a);
}

static void leap(struct bead_string_stepper *s, double h, double t)
{
    if (s->method->tableau)
        nystrom(s, h);
    else if (s->method->composition)
        composition(s, h);
    else
        runge_kutta(s, h);
    s->end.t = t;
}

static void find_jerks(struct bead_string_stepper *s)
{
    find_jerk(&s->string, &s->start, s->jerk[0]);
    find_jerk(&s->string, &s->end, s->jerk[1]);
    s->jerk_step = s->steps;
}

/* Each spring moves on as if its branch had no end; then the step is made again, to where the first of them left it. */
static bool stop_at_kink(struct bead_string_stepper *s, double h)
{
    enum { CORRECTIONS = 4 };
    static const double shortest = 0x1p-40; /* so that time advances */
    find_jerks(s);
    const struct bead_string_kink kink = bead_string_first_kink(s);
    if (!(kink.at < 1))
        return false;
    double by = fmax(kink.at, shortest) * h, wrong;
    leap(s, by, s->start.t + by);
    for (int i = 0; i < CORRECTIONS && (wrong = bead_string_from_kink(s, &kink)) != 0; i++) {
        by = fmin(fmax(by + wrong, shortest * h), h);
        leap(s, by, s->start.t + by);
    }
    s->jerk_step = 0;
    return true;
}

bool bead_string_step(struct bead_string_stepper *s, double h, double t)
{
    const bool kinks = s->string.spec->piecewise.beyond > 0;
    if (kinks)
        bead_string_settle(s);
    struct bead_string_state old = s->start;
    s->start = s->end;
    s->end = old;
    s->steps++;
    leap(s, h, t);
    return !kinks || !stop_at_kink(s, h);
}

void bead_string_between(struct bead_string_stepper *s, double t, double *u, double *v)
{
    size_t n = s->string.masses;
    double h = s->end.t - s->start.t, x = h > 0 ? (t - s->start.t) / h : 1;
    if (t == s->end.t || !(h > 0)) {
        memcpy(u, s->end.u, n * sizeof(double));
        memcpy(v, s->end.v, n * sizeof(double));
        return;
    }
    if (s->jerk_step != s->steps)
        find_jerks(s);
    for (size_t k = 0; k < n; k++) {
        const double at0[] = {s->start.u[k], h * s->start.v[k], h * h * s->start.a[k], h * h * h * s->jerk[0][k]};
        const double at1[] = {s->end.u[k], h * s->end.v[k], h * h * s->end.a[k], h * h * h * s->jerk[1][k]};
        struct bead_polynomial p = bead_polynomial_hermite(at0, at1);
        u[k] = bead_polynomial_value(&p, x);
        v[k] = bead_polynomial_slope(&p, x) / h;
    }
}

/* ---- memory ---- */

enum bead_error bead_string_create(const struct bead_equation_spec *spec, const struct bead_method *method,
                                   struct bead_string_stepper *s, struct bead_message *msg)
{
    size_t n = spec->points, springs = n + (spec->ends == BEAD_ENDS_FIXED);
    enum { ARRAYS = 6 + BEAD_STAGES_MAX + 4 + 2 };
    *s = (struct bead_string_stepper){.string = {spec, n, springs, 0, NULL, NULL}, .method = method};
    s->memory = calloc(ARRAYS * n + 2 * (n + 1), sizeof(double));
    if (!s->memory)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a string of %zu masses", n);
    double *at = s->memory;
    double **arrays[] = {&s->start.u, &s->start.v, &s->start.a, &s->end.u, &s->end.v,   &s->end.a,
                         &s->y,       &s->w[0],    &s->w[1],    &s->w[2],  &s->jerk[0], &s->jerk[1]};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++, at += n)
        *arrays[i] = at;
    for (size_t i = 0; i < BEAD_STAGES_MAX; i++, at += n)
        s->stage[i] = at;
    s->string.tension = at;
    s->string.branch = at + n + 1;
    return BEAD_OK;
}

void bead_string_destroy(struct bead_string_stepper *s)
{
    free(s->memory);
    s->memory = NULL;
}

void bead_string_begin(struct bead_string_stepper *s)
{
    for (size_t j = 0; j < s->string.springs; j++)
        s->string.branch[j] = bead_string_branch(s->string.spec, bead_string_strain(&s->string, s->end.u, j));
    accelerate(s, s->end.u, s->end.a);
    s->end.t = s->start.t = 0;
    size_t bytes = s->string.masses * sizeof(double);
    memcpy(s->start.u, s->end.u, bytes);
    memcpy(s->start.v, s->end.v, bytes);
    memcpy(s->start.a, s->end.a, bytes);
}

/* ---- the start: one of the modes, or a pulse of strain ---- */

/* u_j = amplitude sin(pi k (j + 1) / (n + 1)), j from 0: the left wall is at the place of mass -1. */
static void start_mode(const struct bead_string *s, double *u)
{
    bool fixed = !periodic(s);
    size_t n = s->masses, half = fixed ? n + 1 : n;
    for (size_t j = 0; j < n; j++) {
        size_t turn = s->spec->mode * (fixed ? j + 1 : 2 * j) % (2 * half); /* in units of half / pi */
        u[j] = s->spec->amplitude * (double)bead_wide_sin(bead_wide_pi * turn / half);
    }
}

/* The strain asked for at place x (in units of springs, from mass 0), with its images on a ring. */
static double strain_at(const struct bead_string *s, double x)
{
    const struct bead_equation_spec *e = s->spec;
    double sum = 0, around = e->ends == BEAD_ENDS_PERIODIC ? (double)s->masses : 0;
    for (int image = -1; image <= 1; image++) {
        if (image == 0 || around > 0)
            sum += bead_sech2((x + bead_string_first(e) - e->at + image * around) / e->width);
    }
    return e->amplitude * sum;
}

/* Integral of the speed of sound, sqrt(dT/dr), from r0 on one branch; Simpson's rule. */
static double integrate_sound(const struct bead_equation_spec *e, double branch, double r0, double r)
{
    enum { PIECES = 32 };
    double sum = 0;
    for (int i = 0; i <= PIECES; i++) {
        double c2 = bead_string_slope(e, branch, r0 + (r - r0) * i / PIECES);
        sum += (i == 0 || i == PIECES ? 1 : i % 2 ? 4 : 2) * sqrt(fmax(c2, 0));
    }
    return sum * (r - r0) / (3 * PIECES);
}

/* Velocity behind a front of strain r in a simple wave going right. */
static double simple_wave(const struct bead_equation_spec *e, double r)
{
    const double branch = bead_string_branch(e, r), kink = branch * e->piecewise.beyond;
    return branch == 0 ? -integrate_sound(e, 0, 0, r) : -integrate_sound(e, 0, 0, kink) - integrate_sound(e, branch, kink, r);
}

/* Strains are given half-way between masses. In a wave going right v(x, t) = -r(x, t) to first order in r, exactly for any
 * wavelength if r is taken at the masses. The ends are as far apart as the sum of all strains requires. */
static void start_pulse(struct bead_string *s, double *u, double *v)
{
    static const double direction[] = {[BEAD_MOVING_REST] = 0, [BEAD_MOVING_RIGHT] = 1, [BEAD_MOVING_LEFT] = -1};
    double sum = 0, place = 0;
    for (size_t j = 0; j < s->springs; j++)
        sum += strain_at(s, (double)j - 0.5);
    s->stretch = sum / (double)s->springs;
    for (size_t j = 0; j < s->masses; j++) {
        place += strain_at(s, (double)j - 0.5) - s->stretch;
        u[j] = place;
        v[j] = s->spec->moving == BEAD_MOVING_REST ? 0 : direction[s->spec->moving] * simple_wave(s->spec, strain_at(s, (double)j));
    }
}

void bead_string_start(struct bead_string *s, double *u, double *v)
{
    s->stretch = 0;
    for (size_t j = 0; j < s->masses; j++)
        u[j] = v[j] = 0;
    if (s->spec->start == BEAD_START_MODE)
        start_mode(s, u);
    else
        start_pulse(s, u, v);
}
