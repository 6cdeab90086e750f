/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work against error: problems, clock and rows, shared by the programs tests/bench/precision_*.
 *
 * Every program prints rows `problem,solver,setting,cpu_s,error_peaks,error_velocity,evaluations`: CPU seconds of one run (the best
 * of a few, or of many where they are short), the largest relative error of the contacts' peak forces over the run, and the largest
 * error of a velocity at an early time, in units of the striker's. Evaluations are of the whole chain's forces. BENCH_QUICK=1 in
 * the environment: one short range of settings each. BENCH_LIMIT: CPU seconds that one run may take; a solver's next finer setting
 * is not tried when one took longer. */
#ifndef BEADREEL_BENCH_PRECISION_H
#define BEADREEL_BENCH_PRECISION_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define GIVE_UP(...) (fprintf(stderr, "bench: " __VA_ARGS__), fputc('\n', stderr), exit(1))
#include "sim/integrate/stepper.h"
#include "tests/problems.h"

struct problem {
    const char *name, *chain;
    const char *files;  /* tests/reference/FILES_peaks.csv and FILES_states.csv */
    double early, end;  /* s: velocities are compared at `early`, peaks up to `end` */
    double finest;      /* s: step of the reference, if this program makes it */
    const char *method; /* and its method */
};

/* The references of P1 to P3 are good to 14 digits. That of the 500 beads is good to 3e-11: the chain multiplies rounding errors.
 */
static const struct problem problems[] = {
    {"P1", P1_CHAIN, "p1", 0.16e-3, 0.8e-3, 0, NULL},
    {"P2", P2_CHAIN, "p2", 0.3e-3, 1.5e-3, 0, NULL},
    {"P3", P3_CHAIN, "p3", 0.6e-3, 3e-3, 0, NULL},
    {"P4", P4_CHAIN, "p4", 0.4e-3, 3e-3, 0.75e-6, "rkn12"},
    {"500_beads", LONG_CHAIN, "long", 0.6e-3, 12e-3, 0.05e-6, "rkn8"},
};
enum { PROBLEMS = sizeof problems / sizeof *problems };

struct row {
    const char *problem, *solver, *setting;
    double cpu, peaks, velocity, evaluations;
};

static inline void print_row(const struct row *row)
{
    printf("%s,%s,%s,%.6g,%.4g,%.4g,%.0f\n", row->problem, row->solver, row->setting, row->cpu, row->peaks, row->velocity,
           row->evaluations);
    fflush(stdout);
}

static inline bool quick(void)
{
    const char *text = getenv("BENCH_QUICK");
    return text && *text && strcmp(text, "0") != 0;
}

/* CPU seconds that one run may take. */
static inline double limit(void)
{
    const char *text = getenv("BENCH_LIMIT");
    return text ? strtod(text, NULL) : quick() ? 0.05 : 5;
}

static inline double cpu_seconds(void)
{
    struct timespec now;
    if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now))
        GIVE_UP("no clock of CPU time");
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Best time of as many runs as `enough` seconds have room for: the first ones warm up the processor. A longer run is timed once,
 * after the one that found its errors. */
static inline double best_time_within(double enough, void (*run)(void *context), void *context)
{
    double best = INFINITY, all = 0;
    for (int i = 0; i < 500 && (i < 1 || all < enough) && all < limit(); i++) {
        double start = cpu_seconds();
        run(context);
        double took = cpu_seconds() - start;
        all += took;
        best = fmin(best, took);
    }
    return best;
}

static inline double best_time(void (*run)(void *context), void *context)
{
    return best_time_within(quick() ? 0.01 : 0.1, run, context);
}

struct references {
    struct table peaks, states; /* contact, force, time; time, bead, displacement, velocity */
};

static inline struct references read_references(const struct problem *problem)
{
    char peaks[64], states[64];
    snprintf(peaks, sizeof peaks, "%s_peaks.csv", problem->files);
    snprintf(states, sizeof states, "%s_states.csv", problem->files);
    return (struct references){read_table(peaks, 3), read_table(states, 4)};
}

static inline void free_references(struct references *references)
{
    free(references->peaks.value);
    free(references->states.value);
}

/* Largest deviation from the reference's velocities at `time`, in units of the striker's. */
static inline double velocity_error(const struct table *states, double time, const double *v, double unit)
{
    double worst = 0;
    size_t used = 0;
    for (size_t r = 0; r < states->rows; r++) {
        const double *row = states->value + 4 * r;
        if (fabs(row[0] - time) > 1e-9 * time)
            continue;
        worst = fmax(worst, fabs(v[(size_t)row[1]] - row[3]));
        used++;
    }
    return used ? worst / unit : NAN;
}

static inline const struct problem *find_problem(const char *name)
{
    for (size_t i = 0; i < PROBLEMS; i++) {
        if (strcmp(problems[i].name, name) == 0)
            return &problems[i];
    }
    GIVE_UP("no problem is called `%s`", name);
}

#endif
