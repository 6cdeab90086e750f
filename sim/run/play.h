/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Play: runs chains and hands samples to consumers. Runs are advanced, checked for a stop, and ended only here.
 *
 *   struct bead_consumer consumer = {.needs = {.fields = ..., .grid = ...}, .take = take, .context = mine};
 *   struct bead_play play = {.chains = chains, .chain_count = 1, .simulate = &scene->simulate, .kernels = bead_kernels_find(NULL),
 *                            .end = 1e-3, .needed = INFINITY, .consumers = &consumer, .consumer_count = 1};
 *   err = bead_play(&play, &played, &msg);
 *   ... played.outcomes[0] ...
 *   bead_played_free(&played);
 *
 * Chains advance together from sample to sample, none further than the next sample needs; after the last sample each continues
 * independently, on all threads. */
#pragma once

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/session.h"
#include "beadreel/sink.h"
#include "sim/integrate/kernels.h"
#include "sim/run/run_kinds.h"

/* A consumer of samples or steps: an output, the search for a range, the measures of a sweep. */
struct bead_consumer {
    struct bead_needs needs;
    bool exact; /* if grids coincide except for rounding, samples have this one's times (trajectories) */
    /* Takes the samples on the grid of the needs; NULL: none. */
    enum bead_error (*take)(const struct bead_consumer *consumer, const struct bead_sample *sample, struct bead_message *msg);
    /* Called after each step of a chain, and may query and sample its run; NULL: never. Different chains may step in different
     * threads. */
    enum bead_error (*step)(const struct bead_consumer *consumer, size_t chain, struct bead_run *run, struct bead_message *msg);
    void *context;
    size_t next, count; /* kept by bead_play */
};

/* A source of samples that are read, not computed. */
struct bead_stored {
    enum bead_error (*read)(const struct bead_stored *stored, double time, unsigned fields, struct bead_sample *sample,
                            struct bead_message *msg);
    void *context;
    double last; /* s: time of the last sample */
};

/* Settings. */
struct bead_play {
    const struct bead_chain *const *chains;
    size_t chain_count;
    const struct bead_stored *stored;     /* NULL: the chains are run */
    const struct bead_simulate *simulate; /* the settings of the runs */
    const struct bead_kernels *kernels;
    struct bead_consumer *consumers;
    size_t consumer_count;
    double end;                        /* s; INFINITY: until the passage of every chain is over */
    double needed;                     /* s: no consumer needs later times */
    enum bead_passage passage;         /* ends the runs if the scene does not */
    double patience;                   /* limit for that, in passages of a wave; 0: 200 */
    const struct bead_span *peak_span; /* peaks of these contacts and beads only; NULL: all */
    double widening;                   /* beads far behind the front are dropped: see behind.h; 0: none */
    size_t target;                     /* then the first contact or bead whose peaks are wanted; 0: all are */
    bool full_window, hash;
    int threads;                /* results do not depend on it */
    double refinement;          /* tolerance of the runs in units of the requested one; 0: 1 */
    double tolerance_factor;    /* tolerance of comparison runs, if consumers want them, in the same units */
    struct bead_counts *counts; /* incremented; NULL: no counts */
    const char *what;           /* for progress */
    const volatile sig_atomic_t *stop;
    void (*progress)(void *context, const struct bead_progress *progress);
    void *progress_context;
};

/* Results. The runs remain until bead_played_free, because they own the peaks. */
struct bead_played {
    struct bead_runner *runs;
    struct bead_runner *comparison_runs; /* [chains]; NULL if no consumer wants one */
    struct bead_runner *check_runs;      /* [chains], finer; NULL if no consumer wants one. Those that fail have no kind. */
    struct bead_outcome *outcomes;       /* [chains] */
    struct bead_outcome *checks;         /* [chains], of the check runs; NULL: none */
    /* [2 chains]: of the peaks of contacts, and of beads, and these peaks as the outcomes have them; NULL if no consumer wants
     * uncertainties */
    double **uncertainty;
    struct bead_peak **judged;
    size_t count;
    double end;  /* s: reached by all chains */
    double told; /* s: clock time of the last progress report */
};

/* Free *played even after an error. Errors: MEMORY, NUMBERS, SCENE, STOPPED (outcomes are valid then), and those of consumers and
 * of stored samples. */
BEAD_CHECK enum bead_error bead_play(const struct bead_play *play, struct bead_played *played, struct bead_message *msg);
void bead_played_free(struct bead_played *played);
/* A play in parts, without stored samples: begin, advance to ascending times (INFINITY: until all runs are over), finish once.
 * Errors as above. */
BEAD_CHECK enum bead_error bead_play_begin(const struct bead_play *play, struct bead_played *played, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_play_advance(const struct bead_play *play, struct bead_played *played, double time,
                                             struct bead_message *msg);
BEAD_CHECK enum bead_error bead_play_finish(const struct bead_play *play, struct bead_played *played, struct bead_message *msg);
/* Tolerance factor of check runs. */
double bead_play_check_factor(const struct bead_play *play);
/* Tolerance factor of comparison runs whose `samples` consumers want, or only peaks. */
double bead_play_comparison_factor(const struct bead_play *play, bool samples);

/* The tries of bead_play_cut: with `target`, plays with as few beads behind the front as the peaks allow, in one try after another,
 * from *try to the last, which keeps all; *try is then the one with the results. */
enum bead_play_try { BEAD_PLAY_USUAL, BEAD_PLAY_ALIKE = 3 }; /* for random chains; for a chain that may have equal cells */
BEAD_CHECK enum bead_error bead_play_cut(struct bead_play *play, size_t *try, struct bead_played *played, struct bead_message *msg);
/* Fails with the message about a chain whose front does not reach its end. */
enum bead_error bead_play_lost(const struct bead_runner *runner, struct bead_message *msg);

/* The extent to which one run is played. */
struct bead_way {
    double until;    /* s: up to the first step that ends at this time or later, */
    double patience; /* or in which the passage is over: its limit in passages of a wave; 0: no passage */
    const volatile sig_atomic_t *stop;
    enum bead_error (*stepped)(void *context, const struct bead_runner *runner, struct bead_message *msg); /* NULL: not called */
    void *context;
};
/* Plays one run alone. Errors: NUMBERS, STOPPED, those of `stepped`. */
BEAD_CHECK enum bead_error bead_play_run(const struct bead_runner *runner, const struct bead_way *way, struct bead_message *msg);

/* ---- for the files of play ---- */
/* Advances one of the runs to `time`. */
struct bead_way bead_play_way(const struct bead_play *play, double time);
/* STOPPED, with the time in the message, s, if a stop is asked for. */
BEAD_CHECK enum bead_error bead_play_look_for_stop(const volatile sig_atomic_t *stop, double time, struct bead_message *msg);
/* A time at which consumers want samples, and which fields. */
struct bead_due {
    double time;
    unsigned fields, comparison, checked; /* of the run, of the comparison run, of the check run; 0: no sample */
    struct bead_span span;
};
void bead_due_start(const struct bead_play *play);
/* Finds the next; false: no consumer wants more. */
bool bead_due_next(const struct bead_play *play, struct bead_due *due);
/* Delivers a sample to the consumers that want due->time. */
BEAD_CHECK enum bead_error bead_due_deliver(const struct bead_play *play, const struct bead_due *due, struct bead_sample *sample,
                                            struct bead_message *msg);
/* Moves on to the next time, when all chains have been sampled. */
void bead_due_pass(const struct bead_play *play, const struct bead_due *due);

/* True if a consumer wants the uncertainties of peaks. */
bool bead_compare_peaks(const struct bead_play *play);
/* True if one with these needs takes peaks of contacts, perhaps only to know since when its peaks are not predictable. */
bool bead_compare_contacts(const struct bead_play *play, const struct bead_needs *needs);
/* The least time between two different maxima of a chain, s: half its shortest period. 0: no consumer wants the uncertainties of
 * peaks. */
double bead_compare_apart(const struct bead_play *play, size_t chain);
/* Creates the comparison runs and the check runs that consumers want. Errors: MEMORY, SCENE, NUMBERS. */
BEAD_CHECK enum bead_error bead_compare_create(const struct bead_play *play, struct bead_played *played, struct bead_message *msg);
/* Finds the uncertainties of peaks after the runs, if a consumer wants them. Errors: MEMORY, NUMBERS, STOPPED. */
BEAD_CHECK enum bead_error bead_compare_finish(const struct bead_play *play, struct bead_played *played, struct bead_message *msg);
void bead_compare_free(struct bead_played *played);
