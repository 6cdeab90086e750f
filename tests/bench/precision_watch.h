/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of another program's solution, step by step: peaks between steps come from the same septic interpolant as our own, so that
 * only the solver is judged. Also the same right-hand side, with our kernels, for solvers written in C. */
#ifndef BEADREEL_BENCH_PRECISION_WATCH_H
#define BEADREEL_BENCH_PRECISION_WATCH_H

#include "sim/chain/chain_internal.h"
#include "sim/run/peaks.h"
#include "tests/bench/precision.h"

struct watch {
    const struct problem *problem;
    struct built built;
    struct references references;
    struct bead_stepper *stepper;
    struct bead_peaks *peaks;
    double velocity; /* error at the early time */
};

/* Start again, with the chain's first state. */
static inline void watch_begin(struct watch *watch)
{
    struct bead_message msg = {""};
    bead_peaks_destroy(watch->peaks);
    bead_stepper_destroy(watch->stepper);
    watch->velocity = NAN;
    watch->peaks = NULL;
    if (bead_stepper_create(watch->built.chain, bead_method_row("rk4"), bead_kernels_find(NULL), true, &watch->stepper, &msg) ||
        bead_peaks_create(watch->stepper, false, (struct bead_span){0, SIZE_MAX}, &watch->peaks, &msg))
        GIVE_UP("%s", msg.text);
}

static inline struct watch watch_create(const struct problem *problem)
{
    struct watch watch = {
        .problem = problem, .built = build(problem->chain, "method: rk4"), .references = read_references(problem)};
    watch_begin(&watch);
    return watch;
}

static inline void watch_destroy(struct watch *watch)
{
    bead_peaks_destroy(watch->peaks);
    bead_stepper_destroy(watch->stepper);
    free_references(&watch->references);
    release(&watch->built);
}

/* The solver's state at time t, its next step's end. */
static inline void watch_step(struct watch *watch, double t, const double *u, const double *v)
{
    struct bead_stepper *s = watch->stepper;
    struct bead_state end = s->start;
    s->start = s->end;
    s->end = end;
    s->t0 = s->t1;
    s->t1 = t;
    s->h = t - s->t0;
    memcpy(s->end.u, u, s->beads * sizeof *u);
    memcpy(s->end.v, v, s->beads * sizeof *v);
    bead_stepper_evaluate(s, s->end.u, s->end.v, s->end.f, s->end.a);
    s->steps++;
    bead_peaks_step(watch->peaks, s, watch->problem->end, watch->problem->end);
    if (fabs(t - watch->problem->early) < 1e-9 * t)
        watch->velocity = velocity_error(&watch->references.states, t, v, watch->built.chain->spec->striker_velocity);
}

static inline void watch_report(const struct watch *watch, const char *solver, const char *setting, double cpu, double evaluations)
{
    double peaks = peak_error(bead_peaks_found(watch->peaks), &watch->references.peaks);
    print_row(&(struct row){watch->problem->name, solver, setting, cpu, peaks, watch->velocity, evaluations});
}

/* ---- right-hand side for solvers of first-order systems: y = u_0..u_{n-1}, 0 (the wall), v_0..v_{n-1} ---- */

struct equations {
    struct bead_stepper *stepper;
    size_t beads;
    uint64_t evaluations;
};

static inline size_t equations_size(const struct equations *e)
{
    return 2 * e->beads + 1;
}

static inline void equations_start(const struct equations *e, double *y)
{
    memset(y, 0, equations_size(e) * sizeof *y);
    y[e->beads + 1] = e->stepper->chain->spec->striker_velocity;
}

static inline void equations_rates(struct equations *e, const double *y, double *rate)
{
    const double *v = y + e->beads + 1;
    struct bead_stepper *s = e->stepper;
    memcpy(rate, v, e->beads * sizeof *v);
    rate[e->beads] = 0;
    s->force(e->beads, &s->table, y, v, s->end.f);
    s->accelerate(e->beads, s->end.f, s->inverse_mass, rate + e->beads + 1);
    e->evaluations++;
}

/* Absolute tolerances that mean the same for displacements and velocities: parts of the striker's velocity, and of its distance in
 * the time of the fastest oscillation. Relative tolerances would let displacements, which grow, become worse. */
static inline void equations_scales(const struct equations *e, double *scale)
{
    const struct bead_chain *chain = e->stepper->chain;
    double v = chain->spec->striker_velocity, u = v / bead_chain_omega(chain, bead_chain_energy(chain));
    for (size_t i = 0; i < equations_size(e); i++)
        scale[i] = i <= e->beads ? u : v;
}

/* A solver: runs to `end` (stopping also at `early`) and reports every step to `watch`, unless that is NULL. False: it gave up. */
typedef bool (*peer_solver)(struct equations *equations, const struct problem *problem, double tolerance, struct watch *watch);

struct peer_task {
    peer_solver solver;
    struct equations equations;
    const struct problem *problem;
    double tolerance;
};

static inline void peer_run(void *context)
{
    struct peer_task *task = context;
    task->solver(&task->equations, task->problem, task->tolerance, NULL);
}

/* Tolerances from 1e-3 on, until a run takes too long; the timed runs are not watched. */
static inline void peer_sweep(const char *name, peer_solver solver)
{
    for (size_t p = 0; p < PROBLEMS; p++) {
        struct watch watch = watch_create(&problems[p]);
        struct bead_stepper *stepper = NULL;
        struct bead_message msg = {""};
        if (bead_stepper_create(watch.built.chain, bead_method_row("rk4"), bead_kernels_find(NULL), true, &stepper, &msg))
            GIVE_UP("%s", msg.text);
        for (int digits = 3; digits <= 14; digits++) {
            struct peer_task task = {solver, {stepper, watch.built.chain->beads, 0}, &problems[p], pow(10, -digits)};
            char setting[16];
            snprintf(setting, sizeof setting, "1e-%d", digits);
            watch_begin(&watch);
            if (!solver(&task.equations, task.problem, task.tolerance, &watch))
                break;
            double evaluations = (double)task.equations.evaluations, cpu = best_time(peer_run, &task);
            watch_report(&watch, name, setting, cpu, evaluations);
            if (cpu > limit())
                break;
        }
        bead_stepper_destroy(stepper);
        watch_destroy(&watch);
    }
}

#endif
