/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of the stress table: the trial, its result, ok or FAILED; and how to try a chain.
 *
 * A row is ok if nothing happened that a user would call wrong: numbers stayed finite, energy and (without wall and tilt) momentum
 * were conserved, peaks are as accurate as requested, and it ended in time. A scene that is refused with a message is listed as
 * refused. STRESS_QUICK=1 in the environment: fewer and shorter rows, seconds in all. Every program ends with status 1 if a row
 * failed. */
#ifndef BEADREEL_STRESS_H
#define BEADREEL_STRESS_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define GIVE_UP(...) (fprintf(stderr, "stress: " __VA_ARGS__), fputc('\n', stderr), exit(1))
#include "sim/integrate/stepper.h"
#include "sim/run/run.h"
#include "tests/problems.h"

struct stress {
    bool quick;
    size_t rows, failed;
};

static inline struct stress stress_start(void)
{
    const char *text = getenv("STRESS_QUICK");
    return (struct stress){text && *text && strcmp(text, "0") != 0, 0, 0};
}

/* One row: trial, values, verdict. */
__attribute__((format(printf, 4, 5))) static inline void stress_row(struct stress *stress, bool ok, const char *name,
                                                                    const char *format, ...)
{
    va_list values;
    printf("  %-34s ", name);
    va_start(values, format);
    vprintf(format, values);
    va_end(values);
    printf("  %s\n", ok ? "ok" : "FAILED");
    fflush(stdout);
    stress->rows++;
    stress->failed += !ok;
}

static inline int stress_end(const struct stress *stress)
{
    printf("%zu rows, %zu failed\n", stress->rows, stress->failed);
    return stress->failed ? 1 : 0;
}

static inline double cpu_seconds(void)
{
    struct timespec now;
    if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now))
        GIVE_UP("no clock of CPU time");
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The result of one run. */
struct trial {
    enum bead_error error;
    struct bead_message message; /* of the error */
    bool finite, in_time;
    double energy, momentum; /* largest relative error of energy; change of momentum in units of the striker's */
    double step, cpu, end;   /* s */
    uint64_t steps, hash;
    size_t contacts;
    double *peaks; /* N [contacts], NaN where loading had not ended; the caller's to free */
};

/* How long a run may take before it counts as hung. */
enum { MOST_STEPS = 2000000 };
static const double most_seconds = 60;

static inline bool all_finite(const struct bead_sample *sample, size_t beads)
{
    double sum = 0; /* of zeros, unless one is not finite */
    for (size_t j = 0; j < beads; j++)
        sum += 0 * sample->field[BEAD_FIELD_DISPLACEMENT][j] + 0 * sample->field[BEAD_FIELD_VELOCITY][j];
    return sum == 0;
}

static inline void take_outcome(struct trial *trial, struct bead_run *run, const struct bead_chain *chain)
{
    struct bead_sample sample = {0};
    struct bead_outcome outcome;
    unsigned fields = BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    trial->end = bead_run_time(run);
    bead_run_finish(run, trial->end, &outcome);
    trial->error = bead_run_sample(run, trial->end, fields, (struct bead_span){0, SIZE_MAX - 1}, &sample, &trial->message);
    trial->finite = !trial->error && all_finite(&sample, chain->beads);
    double lost = outcome.energy_start - outcome.energy_end, allowed = chain->spec->damping_coefficient > 0 ? INFINITY : 0;
    trial->energy = fmax(outcome.energy_error, fmax(-lost, lost - allowed) / bead_chain_energy(chain));
    trial->momentum = fabs(outcome.momentum_end / outcome.momentum_start - 1);
    trial->step = outcome.step;
    trial->steps = outcome.steps;
    trial->hash = bead_run_work(run).hash;
    trial->contacts = chain->contacts;
    trial->peaks = malloc(chain->contacts * sizeof *trial->peaks);
    for (size_t k = 0; trial->peaks && k < chain->contacts; k++)
        trial->peaks[k] = outcome.contact_peaks[k].open ? NAN : outcome.contact_peaks[k].value;
}

static inline struct trial try_chain(const struct bead_chain *chain, struct bead_run_settings settings)
{
    struct trial trial = {.error = BEAD_OK};
    struct bead_run *run = NULL;
    double start = cpu_seconds();
    settings.chain = chain;
    settings.simulate = &bead_chain_scene(chain)->simulate;
    settings.contact_peaks = settings.hash = true;
    settings.kernels = settings.kernels ? settings.kernels : bead_kernels_find(NULL);
    trial.error = bead_run_create(&settings, &run, &trial.message);
    trial.in_time = true;
    while (!trial.error && trial.in_time && bead_run_time(run) < settings.end &&
           !(settings.passage && !isnan(bead_run_arrival(run)))) {
        trial.error = bead_run_step(run, &trial.message);
        trial.in_time = bead_run_work(run).steps < MOST_STEPS && cpu_seconds() - start < most_seconds;
    }
    if (!trial.error)
        take_outcome(&trial, run, chain);
    trial.cpu = cpu_seconds() - start;
    bead_run_destroy(run);
    return trial;
}

/* The same from text; end INFINITY: until the front has passed. A scene that is refused ends as its error. */
static inline struct trial try_scene(const char *text, const char *simulate, double end)
{
    struct built built;
    struct trial trial = {.error = BEAD_OK};
    trial.error = try_build(text, simulate, &built, &trial.message);
    if (!trial.error)
        trial = try_chain(built.chain, (struct bead_run_settings){.end = end, .passage = isinf(end)});
    release(&built);
    return trial;
}

/* Largest relative difference of peaks that both runs have seen the top of. Peaks of less than `least` of the largest do not count.
 */
static inline double peak_difference(const struct trial *a, const struct trial *b, double least)
{
    double worst = 0, largest = 0;
    for (size_t k = 0; k < b->contacts; k++)
        largest = fmax(largest, b->peaks[k]);
    for (size_t k = 0; k < a->contacts && k < b->contacts; k++) {
        if (b->peaks[k] > least * largest && !isnan(a->peaks[k]))
            worst = fmax(worst, fabs(a->peaks[k] / b->peaks[k] - 1));
    }
    return worst;
}

#endif
