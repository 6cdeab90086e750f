/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can run: chains of beads (run.h) and equations (equation_run.c), each kind a const table with its own struct bead_run.
 * Sessions use only these tables. */
#ifndef BEADREEL_SIM_RUN_RUN_KINDS_H
#define BEADREEL_SIM_RUN_RUN_KINDS_H

#include "sim/equation/equation.h"
#include "sim/run/run.h"

struct bead_run_kind {
    enum bead_error (*create)(const struct bead_run_settings *settings, struct bead_run **run, struct bead_message *msg);
    void (*destroy)(struct bead_run *run);
    double (*time)(const struct bead_run *run);
    double (*over)(const struct bead_run *run); /* the passage, s; NaN: not yet, or there is none */
    enum bead_error (*step)(struct bead_run *run, struct bead_message *msg);
    enum bead_error (*sample)(struct bead_run *run, double t, unsigned fields, struct bead_span span, struct bead_sample *sample,
                              struct bead_message *msg);
    void (*finish)(struct bead_run *run, double end, struct bead_outcome *outcome);
    uint64_t (*evaluations)(const struct bead_run *run);
    uint64_t (*steps)(const struct bead_run *run);
    uint64_t (*hash)(const struct bead_run *run);
    /* What such a run would do: `tolerance_factor` as in bead_run_settings. */
    enum bead_error (*pace)(const struct bead_chain *chain, const struct bead_simulate *asked, double tolerance_factor,
                            struct bead_pace *pace, struct bead_message *msg);
};

extern const struct bead_run_kind bead_run_of_equation;
const struct bead_run_kind *bead_run_kind_of(const struct bead_chain *chain);

/* The tolerance factor of a comparison run of all these chains: see bead_run_tolerance_factor. */
double bead_run_tolerance_factor_of(const struct bead_chain *const *chains, size_t count, const struct bead_simulate *asked);

/* A run of any kind. */
struct bead_runner {
    const struct bead_run_kind *kind; /* NULL: none */
    struct bead_run *run;
};
BEAD_CHECK enum bead_error bead_runner_create(const struct bead_run_settings *settings, struct bead_runner *runner,
                                              struct bead_message *msg);
void bead_runner_destroy(struct bead_runner *runner);

#endif
