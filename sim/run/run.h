/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run: one chain stepped through time, and sampled between the steps.
 *
 *   bead_run_create(&settings, &run, &msg);
 *   while (bead_run_time(run) < t) bead_run_step(run, &msg);
 *   bead_run_sample(run, t, ...);       start of the last step <= t <= its end
 *   bead_run_finish(run, &outcome);
 *   bead_run_destroy(run);
 *
 * Output times never force the step: states between steps come from Hermite interpolation (dense.h). */
#ifndef BEADREEL_SIM_RUN_RUN_H
#define BEADREEL_SIM_RUN_RUN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"
#include "sim/integrate/kernels.h"

struct bead_record;
struct bead_run;

/* What ends a run whose end the scene does not give: a time that is not known before; the front's arrival at the end of the chain;
 * the first pulse being over there (passing.h). */
enum bead_passage { BEAD_PASSAGE_NONE, BEAD_PASSAGE_OF_FRONT, BEAD_PASSAGE_OF_PULSE };

struct bead_run_settings {
    const struct bead_chain *chain;
    const struct bead_simulate *simulate; /* accuracy, method and step asked for; mostly those of the chain's scene */
    const struct bead_kernels *kernels;
    double end;                /* s: the last step ends here; INFINITY: not known, steps keep their length */
    enum bead_passage passage; /* not knowing end, the run is over then; peaks count until the front's
                                  arrival only, those still rising then until it is over */
    bool contact_peaks, bead_peaks;
    const struct bead_span *peak_span; /* of these contacts and beads only; NULL: all */
    bool budget;                       /* samples have the energy budget */
    bool states;                       /* the beads as the front arrives and at the end, for the outcome */
    bool full_window, hash;
    struct bead_record *record; /* gets every step; NULL: none */
    double tolerance_factor;    /* a comparison run: accuracy, or the step given, times this; 0: as asked */
};

/* Method and step that a chain is run with as asked. Errors: SCENE (with the method's name), NUMBERS (step too long to be stable).
 */
struct bead_stepping {
    const struct bead_method *method;
    double step;     /* s, the first */
    double omega;    /* rad/s, bound of the frequencies */
    double theta;    /* step in units of 1/omega */
    double accuracy; /* that the steps are made for */
    bool variable;   /* later steps follow the state */
    const char *why; /* this method */
};
BEAD_CHECK enum bead_error bead_run_stepping(const struct bead_chain *chain, const struct bead_simulate *asked,
                                             struct bead_stepping *stepping, struct bead_message *msg);

/* The same for a comparison run, a second run with another tolerance. */
BEAD_CHECK enum bead_error bead_run_comparison_stepping(const struct bead_chain *chain, const struct bead_simulate *asked,
                                                        double tolerance_factor, struct bead_stepping *stepping,
                                                        struct bead_message *msg);
/* The tolerance factor of a comparison run of all these chains: 10 times the accuracy, or 2 times the step asked for; a
 * tenth or half where the method has no room for that. */
double bead_run_tolerance_factor(const struct bead_chain *const *chains, size_t count, const struct bead_simulate *asked);
/* What a run at `factor` times the tolerance may be off by, in units of what was asked: less than that where its steps are the
 * longest that the method may take. */
double bead_run_effective_factor(const struct bead_chain *chain, const struct bead_simulate *asked, double factor);

/* In words, that a step given is too long for peaks worth having; "" where it is not, or none is given. */
struct bead_long_step {
    char text[256];
};
struct bead_long_step bead_run_long_step(const struct bead_chain *chain, const struct bead_simulate *asked);

BEAD_CHECK enum bead_error bead_run_create(const struct bead_run_settings *settings, struct bead_run **run,
                                           struct bead_message *msg);
void bead_run_destroy(struct bead_run *run);

double bead_run_time(const struct bead_run *run); /* s: end of the last step */
/* When the front reached the end of the chain; NaN: not yet. */
double bead_run_arrival(const struct bead_run *run);
/* When the passage of the settings was over, s; NaN: it is not yet. */
double bead_run_over(const struct bead_run *run);
/* [beads], so far; NULL: not asked for. */
const struct bead_peak *bead_run_bead_peaks(const struct bead_run *run);
/* Errors: NUMBERS where energy or a number ran away. */
BEAD_CHECK enum bead_error bead_run_step(struct bead_run *run, struct bead_message *msg);
/* Fields (BEAD_FIELD_BITs) of the beads in `span` at time t into `sample` (time, active and field are set). Borrowed until the next
 * call. */
BEAD_CHECK enum bead_error bead_run_sample(struct bead_run *run, double t, unsigned fields, struct bead_span span,
                                           struct bead_sample *sample, struct bead_message *msg);
/* The outcome at time `end` (in the last step); peaks are borrowed from the run. */
void bead_run_finish(struct bead_run *run, double end, struct bead_outcome *outcome);
uint64_t bead_run_evaluations(const struct bead_run *run);
uint64_t bead_run_steps(const struct bead_run *run);
uint64_t bead_run_hash(const struct bead_run *run);

#endif
