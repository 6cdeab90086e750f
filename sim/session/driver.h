/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The driver: takes samples of all chains, in order of time, from a simulation or a trajectory to the consumers that want them. */
#ifndef BEADREEL_SIM_SESSION_DRIVER_H
#define BEADREEL_SIM_SESSION_DRIVER_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/session.h"
#include "beadreel/sink.h"
#include "beadreel/trajectory.h"
#include "sim/integrate/kernels.h"
#include "sim/run/run_kinds.h"

struct bead_made;

/* One that wants samples: an output, or the search for a range. */
struct bead_consumer {
    struct bead_needs needs;
    bool exact; /* where two grids meet but for rounding, this one's time is the sample's (trajectories) */
    enum bead_error (*take)(struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg);
    struct bead_made *made;  /* the output it stands for */
    struct bead_range range; /* found so far by a scouting pass */
    size_t next, count;      /* kept by the driver */
};

/* What one pass computes, and with what. */
struct bead_driver {
    const struct bead_chain *const *chains;
    size_t chain_count;
    const struct bead_simulate *simulate; /* the settings of the runs */
    struct bead_consumer *consumers;
    size_t consumer_count;
    double end;    /* s; INFINITY: until the first pulse has passed every chain */
    double needed; /* s: no consumer needs later times */
    bool passage;  /* the scene's `until` is the default */
    bool full_window, hash;
    int threads;             /* for chains whose last sample is delivered; results do not depend on it */
    double refinement;       /* of the runs: their tolerance in units of what is asked; 0: 1 */
    double tolerance_factor; /* of comparison runs, where consumers want one; in the same units */
    const struct bead_kernels *kernels;
    const char *what; /* for progress */
    const volatile sig_atomic_t *stop;
    void (*progress)(void *context, const struct bead_progress *progress);
    void *progress_context;
};

/* The runs of a pass stay, for their peaks, until bead_passed_free. */
struct bead_passed {
    struct bead_runner *runs;
    struct bead_runner *comparison_runs; /* [chains]; NULL if no consumer wants one */
    struct bead_outcome *outcomes;       /* [chains] */
    double **uncertainty;                /* [2 chains]: of the peaks of contacts, and of beads; NULL if no consumer wants them */
    size_t count;
    double end;   /* s: reached by all chains */
    bool stopped; /* by a signal */
};

/* Simulate all chains. Errors: MEMORY, NUMBERS, STOPPED (outcomes are valid then), and those of consumers. */
BEAD_CHECK enum bead_error bead_drive_simulation(const struct bead_driver *driver, struct bead_counts *counts,
                                                 struct bead_passed *passed, struct bead_message *msg);
/* Read them from a trajectory instead. Errors: IO, FORMAT, STOPPED and those of consumers. */
BEAD_CHECK enum bead_error bead_drive_trajectory(const struct bead_driver *driver, struct bead_trajectory *trajectory,
                                                 struct bead_counts *counts, struct bead_message *msg);
void bead_passed_free(struct bead_passed *passed);
/* What the runs' tolerance is multiplied by in comparison runs, of which outputs show `samples` or compare peaks only. */
double bead_driver_comparison_factor(const struct bead_driver *driver, bool samples);

/* Takes samples of a scouting pass: widens consumer->range by the values of needs.range_field. */
enum bead_error bead_consumer_scout(struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg);

/* What driver.c does for its two sources. */
struct bead_due {
    double time;
    unsigned fields, comparison;
    struct bead_span span;
};
/* The next time that a consumer wants, and what it wants then; false: no consumer wants more. */
bool bead_driver_due(const struct bead_driver *driver, struct bead_due *due);
/* Deliver a sample to the consumers that wanted due->time. After the `last` chain of this time they move on. */
BEAD_CHECK enum bead_error bead_driver_deliver(const struct bead_driver *driver, const struct bead_due *due,
                                               struct bead_sample *sample, bool last, struct bead_message *msg);
void bead_driver_start(const struct bead_driver *driver);

#endif
