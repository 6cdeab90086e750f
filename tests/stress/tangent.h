/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of peaks by one forward tangent: delta' = J delta, and after each step delta += e, its local error with its sign. At a
 * peak of contact k the error of its force is dF/dd (delta_k - delta_{k+1}).
 *
 * The local error is the difference to two steps of half the length; where these are made every n-th step only, n times that
 * (each of the first). The
 * tangent is integrated with the classical Runge-Kutta method, between recorded states. Where the force of a contact with damping
 * jumps, a shift of that moment is an impulse. For chains without springs and drives. */
#ifndef BEADREEL_TESTS_TANGENT_H
#define BEADREEL_TESTS_TANGENT_H

#include "sim/adjoint/record.h"
#include "sim/integrate/events.h"
#include "tests/problems.h"

/* The first steps, after the striker's impact, often have the largest errors: each of so many is measured. */
enum { SUBSTEPS = 4, FIRST_STEPS = 16 };

struct tangent {
    const struct bead_record *record;
    struct bead_stepper *half;
    double *delta[2], *before[2], *work[5]; /* [beads + 1]: m, m/s, at the end of the step and its start */
    double *stiffness, *damping;            /* N/m, kg/s */
};

/* Displacement, velocity or acceleration (0, 1, 2) between beads k and k + 1 in state i of the record. */
static inline double between(const struct bead_record *r, size_t i, int which, size_t k)
{
    const size_t active = r->state[i].active;
    const double *of = r->values + r->state[i].at + (size_t)which * active;
    return (k < active ? of[k] : 0) - (k + 1 < active ? of[k + 1] : 0);
}

/* Quintic Hermite interpolant of a compression at x of step i, and its rate; less the static compression. */
static inline void compression(const struct tangent *t, size_t i, size_t k, double x, double d[2])
{
    const struct bead_record *r = t->record;
    const double h = r->state[i + 1].time - r->state[i].time, u = between(r, i, 0, k), v = h * between(r, i, 1, k),
                 a = 0.5 * h * h * between(r, i, 2, k), rest = between(r, i + 1, 0, k) - (u + v + a),
                 slope = h * between(r, i + 1, 1, k) - (v + 2 * a), bend = h * h * between(r, i + 1, 2, k) - 2 * a,
                 c3 = 10 * rest - 4 * slope + 0.5 * bend, c4 = -15 * rest + 7 * slope - bend,
                 c5 = 6 * rest - 3 * slope + 0.5 * bend;
    d[0] = u + x * (v + x * (a + x * (c3 + x * (c4 + x * c5))));
    d[1] = (v + x * (2 * a + x * (3 * c3 + x * (4 * c4 + x * 5 * c5)))) / h;
}

/* Derivatives of the force of contact k by its compression and its rate at x of step i. */
static inline void slopes(const struct tangent *t, size_t i, size_t k, double x, double of[2])
{
    const struct bead_chain *c = t->half->chain;
    double d[2];
    compression(t, i, k, x, d);
    const double all = c->static_compression[k] + d[0], near = 1e-6 * fabs(d[1]);
    const bool damped = t->half->table.damping > 0 && all > 0 && near > 0;
    of[0] = c->law->stiffness(c->stiffness[k], &c->spec->law, all);
    of[1] = damped ? (bead_damping_force(&t->half->table, all, d[1] + near) - bead_damping_force(&t->half->table, all, d[1])) / near
                   : 0;
}

static inline void find_slopes(struct tangent *t, size_t i, double x)
{
    for (size_t k = 0; k < t->half->chain->contacts; k++) {
        double of[2];
        slopes(t, i, k, x, of);
        t->stiffness[k] = of[0];
        t->damping[k] = of[1];
    }
}

static inline void accelerate(const struct tangent *t, const double *u, const double *v, double *a)
{
    const struct bead_chain *c = t->half->chain;
    double before = 0;
    for (size_t j = 0; j < c->beads; j++) {
        const double here = j < c->contacts ? t->stiffness[j] * (u[j] - u[j + 1]) + t->damping[j] * (v[j] - v[j + 1]) : 0;
        a[j] = (before - here) * c->inverse_mass[j];
        before = here;
    }
}

/* One step of the classical Runge-Kutta method from x of step i. */
static inline void substep(struct tangent *t, size_t i, double x, double length, double h)
{
    static const double ahead[] = {0, 0.5, 0.5, 1}, weight[] = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0};
    const size_t beads = t->half->beads;
    double *u = t->work[0], *v = t->work[1], *a = t->work[2], *du = t->work[3], *dv = t->work[4];
    memset(du, 0, beads * sizeof *du);
    memset(dv, 0, beads * sizeof *dv);
    for (int s = 0; s < 4; s++) {
        const double part = ahead[s] * length * h;
        for (size_t j = 0; j < beads; j++) {
            const double rate = s > 0 ? v[j] : 0, turn = s > 0 ? a[j] : 0;
            u[j] = t->delta[0][j] + part * rate;
            v[j] = t->delta[1][j] + part * turn;
        }
        if (s != 2)
            find_slopes(t, i, x + ahead[s] * length);
        accelerate(t, u, v, a);
        for (size_t j = 0; j < beads; j++) {
            du[j] += weight[s] * v[j];
            dv[j] += weight[s] * a[j];
        }
    }
    for (size_t j = 0; j < beads; j++) {
        t->delta[0][j] += length * h * du[j];
        t->delta[1][j] += length * h * dv[j];
    }
}

/* Contacts with damping that close or open at the start of step i do so earlier by delta over their rate. */
static inline void shift_jumps(struct tangent *t, size_t i, double h)
{
    const struct bead_chain *c = t->half->chain;
    for (size_t k = 0; i > 0 && t->half->table.damping > 0 && k < c->contacts; k++) {
        const double rate = between(t->record, i, 1, k), d = c->static_compression[k] + between(t->record, i, 0, k);
        if (rate == 0 || fabs(d) > 1e-6 * c->speed * h)
            continue;
        const double impulse = bead_damping_force(&t->half->table, 0, rate) / fabs(rate) * (t->delta[0][k] - t->delta[0][k + 1]);
        t->delta[1][k] -= impulse * c->inverse_mass[k];
        if (k + 1 < c->beads)
            t->delta[1][k + 1] += impulse * c->inverse_mass[k + 1];
    }
}

/* The start of step i, of which all that moves is in the record. */
static inline void place(const struct tangent *t, size_t i)
{
    struct bead_stepper *s = t->half;
    const struct bead_recorded *at = &t->record->state[i];
    double *const to[2] = {s->end.u, s->end.v};
    for (int which = 0; which < 2; which++) {
        memset(to[which], 0, s->beads * sizeof(double));
        memcpy(to[which], t->record->values + at->at + (size_t)which * at->active, at->active * sizeof(double));
    }
    s->t1 = at->time;
    for (size_t k = 0; s->closed && k < s->chain->contacts; k++) {
        const double d = bead_stepper_compression(s, &s->end, k), touching = 1e-6 * s->chain->speed * s->h;
        s->closed[k] = fabs(d) <= touching ? s->end.v[k] >= s->end.v[k + 1] : d > 0;
    }
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    bead_events_weigh(s->events, s);
}

/* Adds the error of step i, `times` times. */
static inline void add_error(struct tangent *t, size_t i, double h, double times)
{
    const struct bead_recorded *end = &t->record->state[i + 1];
    struct bead_stepper *s = t->half;
    s->h = h;
    place(t, i);
    while (s->t1 < end->time - 1e-9 * h) /* with damping, steps end where contacts close */
        bead_stepper_advance_by(s, fmin(h / 2, end->time - s->t1), fmin(s->t1 + h / 2, end->time));
    for (int which = 0; which < 2; which++) {
        const double *exact = which ? s->end.v : s->end.u, *own = t->record->values + end->at + (size_t)which * end->active;
        for (size_t j = 0; j < s->beads; j++)
            t->delta[which][j] += times * (exact[j] - (j < end->active ? own[j] : 0));
    }
}

static inline void carry(struct tangent *t, size_t i, size_t every)
{
    const double h = t->record->state[i + 1].time - t->record->state[i].time;
    shift_jumps(t, i, h);
    for (int which = 0; which < 2; which++)
        memcpy(t->before[which], t->delta[which], t->half->beads * sizeof(double));
    for (int s = 0; s < SUBSTEPS; s++)
        substep(t, i, s / (double)SUBSTEPS, 1.0 / SUBSTEPS, h);
    if (i < FIRST_STEPS || i % every == 0)
        add_error(t, i, h, i < FIRST_STEPS ? 1 : (double)every);
}

/* The error of the force of contact k at x of step i: delta by cubic Hermite interpolation. */
static inline double force_error(const struct tangent *t, size_t i, size_t k, double x)
{
    const double h = t->record->state[i + 1].time - t->record->state[i].time, d0 = t->before[0][k] - t->before[0][k + 1],
                 d1 = t->delta[0][k] - t->delta[0][k + 1], v0 = t->before[1][k] - t->before[1][k + 1],
                 v1 = t->delta[1][k] - t->delta[1][k + 1];
    double of[2];
    slopes(t, i, k, x, of);
    return of[0] * (d0 + x * x * (3 - 2 * x) * (d1 - d0) + x * (1 - x) * h * ((1 - x) * v0 - x * v1)) +
           of[1] * (6 * x * (1 - x) / h * (d1 - d0) + (1 - x) * (1 - 3 * x) * v0 + x * (3 * x - 2) * v1);
}

/* The errors of peaks that lie in step i: of contacts, then of beads. */
static inline void read_errors(const struct tangent *t, size_t i, const struct bead_peak *peaks, double *errors)
{
    const double from = t->record->state[i].time, h = t->record->state[i + 1].time - from;
    const size_t contacts = t->half->chain->contacts;
    for (size_t p = 0; p < contacts + t->half->beads; p++) {
        const double x = (peaks[p].time - from) / h;
        const bool is_bead = p >= contacts;
        const size_t last = is_bead ? p - contacts : p, first = is_bead && last > 0 ? last - 1 : last;
        if (!(x >= 0 && x < 1))
            continue;
        errors[p] = 0;
        for (size_t k = first; k <= last && k < contacts; k++)
            errors[p] += (is_bead ? 0.5 : 1) * force_error(t, i, k, x);
    }
}

/* Records the steps of a chain's run up to a time, with one more. */
static inline void record_steps(const struct bead_run_settings *settings, double until)
{
    struct bead_message msg = {""};
    struct bead_run *run = NULL;
    if (bead_run_create(settings, &run, &msg))
        GIVE_UP("%s", msg.text);
    while (bead_run_time(run) <= until && bead_run_time(run) < settings->end) {
        if (bead_run_step(run, &msg))
            GIVE_UP("%s", msg.text);
    }
    bead_run_destroy(run);
}

/* The errors of peaks, of contacts and then of beads, with their signs, N; NaN: of open ones. Local errors of every `every`-th
 * step. */
static inline void tangent_errors(const struct bead_run_settings *settings, const struct bead_peak *peaks, size_t every,
                                  double *errors)
{
    const struct bead_chain *c = settings->chain;
    const size_t count = c->contacts + c->beads, room = c->beads + 1, arrays = 11;
    struct bead_record record = {0};
    struct bead_run_settings recording = *settings;
    struct bead_stepping stepping;
    struct bead_message msg = {""};
    struct tangent t = {.record = &record};
    double until = 0, *memory = calloc(arrays * room, sizeof *memory);
    for (size_t p = 0; p < count; p++) {
        errors[p] = NAN;
        until = peaks[p].open ? until : fmax(until, peaks[p].time); /* fmax ignores NaN */
    }
    recording.record = &record;
    record_steps(&recording, until);
    if (!memory || bead_run_stepping(c, settings->simulate, 1, &stepping, &msg) ||
        bead_stepper_create(c, stepping.method, settings->kernels, true, &t.half, &msg))
        GIVE_UP("%s", msg.text);
    double **const parts[] = {&t.delta[0], &t.delta[1], &t.before[0], &t.before[1], &t.work[0], &t.work[1],
                              &t.work[2],  &t.work[3],  &t.work[4],   &t.stiffness, &t.damping};
    for (size_t p = 0; p < arrays; p++)
        *parts[p] = memory + p * room;
    for (size_t i = 0; i < record.steps; i++) {
        carry(&t, i, every);
        read_errors(&t, i, peaks, errors);
    }
    bead_stepper_destroy(t.half);
    bead_record_free(&record);
    free(memory);
}

#endif
