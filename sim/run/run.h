/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run: one chain stepped through time, and sampled between the steps.
 *
 *   bead_run_create(&settings, &run, &msg);
 *   bead_run_step(run, &msg);           again and again: bead_play_run of play.h does it
 *   bead_run_sample(run, t, ...);       start of the last step <= t <= its end
 *   bead_run_finish(run, &outcome);
 *   bead_run_destroy(run);
 *
 * Output times never force the step: states between steps come from Hermite interpolation (dense.h). */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"
#include "sim/integrate/kernels.h"

struct bead_heights;
struct bead_record;
struct bead_run;

/* The event that ends a run for which the scene gives no end: none; the front reaches the end of the chain; the first pulse is over
 * there (front.h). */
enum bead_passage { BEAD_PASSAGE_NONE, BEAD_PASSAGE_OF_FRONT, BEAD_PASSAGE_OF_PULSE };

struct bead_run_settings {
    const struct bead_chain *chain;
    const struct bead_simulate *simulate; /* requested accuracy, method and step; usually from the chain's scene */
    const struct bead_kernels *kernels;
    double end;                /* s: the last step ends here; INFINITY: unknown, steps keep their length */
    enum bead_passage passage; /* ends the run if `end` is unknown; peaks count until the front arrives, forces still rising then
                                  until the passage is over */
    bool contact_peaks, bead_peaks;
    bool rivals;                       /* and their rivals: see peaks.h */
    double peaks_apart;                /* s: and the second highest maxima, at least this far from the highest; 0: none */
    bool heights;                      /* and the largest forces in each part of the run: see heights.h */
    const struct bead_span *peak_span; /* peaks of these contacts and beads only; NULL: all */
    double widening;                   /* beads far behind the front are dropped: see behind.h; 0: none */
    size_t target;                     /* then the first contact or bead whose peaks are wanted; 0: all are */
    bool budget;                       /* samples include the energy budget */
    bool states;                       /* the outcome includes all beads when the front arrives and at the end */
    bool full_window, hash;
    struct bead_record *record; /* keeps every step; NULL: none */
    double tolerance_factor;    /* of a comparison run: times the requested accuracy, or step; 0: 1 */
    bool other_grid;            /* a check run: on a coarser grid, if the grid decides the errors of an equation */
};

struct bead_stepping {
    const struct bead_method *method;
    double step;     /* s, the first */
    double omega;    /* rad/s, upper bound of the frequencies */
    double theta;    /* step in units of 1/omega */
    double accuracy; /* the steps are chosen for it */
    bool variable;   /* later steps follow the state */
    const char *why; /* reason for the method */
};
/* Method and step of a chain's run; `tolerance_factor` as in bead_run_settings. Errors: SCENE (with the method's name; a step too
 * long to be stable). */
BEAD_CHECK enum bead_error bead_run_stepping(const struct bead_chain *chain, const struct bead_simulate *asked,
                                             double tolerance_factor, struct bead_stepping *stepping, struct bead_message *msg);
/* The tolerance factor for comparison runs of all these chains: 10 times the requested accuracy or twice the requested step; a
 * tenth or half if the method cannot take longer steps. For equations, whose runs may be unstable with longer steps: 10, or
 * half. */
double bead_run_tolerance_factor(const struct bead_chain *const *chains, size_t count, const struct bead_simulate *asked);
/* Error bound of a run at `factor` times the tolerance, in units of the requested accuracy: less than `factor` if the method
 * cannot take steps that long. */
double bead_run_effective_factor(const struct bead_chain *chain, const struct bead_simulate *asked, double factor);

/* A warning that the requested step is too long for accurate peaks; "" if it is not, or if none was requested. */
struct bead_long_step {
    char text[256];
};
struct bead_long_step bead_run_long_step(const struct bead_chain *chain, const struct bead_simulate *asked);

BEAD_CHECK enum bead_error bead_run_create(const struct bead_run_settings *settings, struct bead_run **run,
                                           struct bead_message *msg);
void bead_run_destroy(struct bead_run *run);

double bead_run_time(const struct bead_run *run); /* s: end of the last step */
/* Time when the front reached the end of the chain, s; NaN: not yet. */
double bead_run_arrival(const struct bead_run *run);
/* Time when the passage that the settings ask for was over or given up, s; NaN: not yet. */
double bead_run_over(const struct bead_run *run);
/* Ends the run here, because the passage will never be over. */
void bead_run_give_up(struct bead_run *run);
bool bead_run_is_lost(const struct bead_run *run); /* the front will never arrive, or was given up */
/* True if dropped beads may have changed a peak: the run must be repeated with more beads. */
bool bead_run_cut_short(const struct bead_run *run);
/* Peaks so far, [beads]; NULL: not requested. */
const struct bead_peak *bead_run_bead_peaks(const struct bead_run *run);
/* Rivals of the peaks of contacts, or beads; NULL: not kept. */
const struct bead_peak *bead_run_rivals(const struct bead_run *run, bool of_beads);
/* The second highest maxima, the same. */
const struct bead_peak *bead_run_second_peaks(const struct bead_run *run, bool of_beads);
/* NULL: not kept. */
const struct bead_heights *bead_run_heights(const struct bead_run *run);
/* Errors: NUMBERS if the energy diverges. */
BEAD_CHECK enum bead_error bead_run_step(struct bead_run *run, struct bead_message *msg);
/* Samples fields (BEAD_FIELD_BITs) of the beads in `span` at time t: sets time, active and field. Borrowed until the next call. */
BEAD_CHECK enum bead_error bead_run_sample(struct bead_run *run, double t, unsigned fields, struct bead_span span,
                                           struct bead_sample *sample, struct bead_message *msg);
/* The outcome at time `end` (in the last step); peaks are borrowed from the run. */
void bead_run_finish(struct bead_run *run, double end, struct bead_outcome *outcome);
/* Work done so far; the hash covers every bit of every state (0: not requested). */
struct bead_run_work {
    uint64_t steps, evaluations, hash;
};
struct bead_run_work bead_run_work(const struct bead_run *run);
