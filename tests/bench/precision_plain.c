/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work against error of the classical Runge-Kutta method in its simplest form: loops over all beads, one step after the other, no
 * windows, no hand-written vectors. What a careful user would have without this program. */
#include "tests/bench/precision_watch.h"

struct plain {
    size_t beads, contacts;
    const double *stiffness, *mass;
    double *memory, *u, *v, *f, *stage_u, *stage_v, *rate_u, *rate_v, *sum_u, *sum_v;
};

static struct plain plain_create(const struct bead_chain *chain)
{
    struct plain p = {.beads = chain->beads, .contacts = chain->contacts, .stiffness = chain->stiffness, .mass = chain->mass};
    double **array[] = {&p.u, &p.v, &p.f, &p.stage_u, &p.stage_v, &p.rate_u, &p.rate_v, &p.sum_u, &p.sum_v};
    enum { ARRAYS = sizeof array / sizeof *array };
    p.memory = calloc(ARRAYS * p.beads, sizeof *p.memory);
    if (!p.memory)
        GIVE_UP("out of memory");
    for (size_t i = 0; i < ARRAYS; i++)
        *array[i] = p.memory + i * p.beads;
    return p;
}

static void rates(struct plain *p, const double *u, const double *v)
{
    for (size_t k = 0; k < p->contacts; k++) {
        double d = u[k] - (k + 1 < p->beads ? u[k + 1] : 0);
        p->f[k] = d > 0 ? p->stiffness[k] * d * sqrt(d) : 0;
    }
    for (size_t j = 0; j < p->beads; j++) {
        p->rate_u[j] = v[j];
        p->rate_v[j] = ((j > 0 ? p->f[j - 1] : 0) - (j < p->contacts ? p->f[j] : 0)) / p->mass[j];
    }
}

static void step(struct plain *p, double h)
{
    static const double ahead[] = {0.5, 0.5, 1, 0}, weight[] = {1, 2, 2, 1};
    memset(p->sum_u, 0, p->beads * sizeof *p->sum_u);
    memset(p->sum_v, 0, p->beads * sizeof *p->sum_v);
    for (int stage = 0; stage < 4; stage++) {
        rates(p, stage ? p->stage_u : p->u, stage ? p->stage_v : p->v);
        for (size_t j = 0; j < p->beads; j++) {
            p->sum_u[j] += weight[stage] * p->rate_u[j];
            p->sum_v[j] += weight[stage] * p->rate_v[j];
            p->stage_u[j] = p->u[j] + ahead[stage] * h * p->rate_u[j];
            p->stage_v[j] = p->v[j] + ahead[stage] * h * p->rate_v[j];
        }
    }
    for (size_t j = 0; j < p->beads; j++) {
        p->u[j] += h / 6 * p->sum_u[j];
        p->v[j] += h / 6 * p->sum_v[j];
    }
}

struct task {
    const struct problem *problem;
    const struct bead_chain *chain;
    double step;
    struct watch *watch; /* NULL: only run */
};

static void solve(void *context)
{
    const struct task *task = context;
    struct plain p = plain_create(task->chain);
    p.v[0] = task->chain->spec->striker_velocity;
    size_t steps = (size_t)lround(task->problem->end / task->step);
    for (size_t i = 1; i <= steps; i++) {
        step(&p, task->step);
        if (task->watch)
            watch_step(task->watch, (double)i * task->step, p.u, p.v);
    }
    free(p.memory);
}

static void sweep(const struct problem *problem)
{
    static const double steps[] = {0.8e-6, 0.4e-6, 0.2e-6, 0.1e-6, 0.05e-6, 0.025e-6};
    struct watch watch = watch_create(problem);
    for (size_t i = 0; i < (quick() ? 1 : sizeof steps / sizeof *steps); i++) {
        struct task task = {problem, watch.built.chain, steps[i], &watch};
        char setting[24];
        snprintf(setting, sizeof setting, "%g us", 1e6 * steps[i]);
        watch_begin(&watch);
        solve(&task);
        task.watch = NULL;
        double cpu = best_time(solve, &task);
        watch_report(&watch, "plain C RK4", setting, cpu, 4 * round(problem->end / steps[i]));
        if (cpu > limit())
            break;
    }
    watch_destroy(&watch);
}

int main(void)
{
    for (size_t p = 0; p < PROBLEMS; p++) {
        if (!strstr(problems[p].chain, "precompression")) /* it knows Hertz's law alone */
            sweep(&problems[p]);
    }
    return 0;
}
