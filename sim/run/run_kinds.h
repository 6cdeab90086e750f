/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Run kinds: chains of beads (run.h) and equations (equation_run.c), each a const table with its own struct bead_run. play.c uses
 * only these tables. */
#pragma once

#include "sim/equation/equation.h"
#include "sim/run/run.h"

struct bead_run_kind {
    enum bead_error (*create)(const struct bead_run_settings *settings, struct bead_run **run, struct bead_message *msg);
    void (*destroy)(struct bead_run *run);
    double (*time)(const struct bead_run *run);
    double (*over)(const struct bead_run *run);       /* time when the passage was over, s; NaN: not yet, or no passage */
    bool (*is_lost)(const struct bead_run *run);      /* it never will be */
    bool (*is_cut_short)(const struct bead_run *run); /* to be repeated with more beads */
    void (*give_up)(struct bead_run *run);            /* count it as over now */
    enum bead_error (*step)(struct bead_run *run, struct bead_message *msg);
    enum bead_error (*sample)(struct bead_run *run, double t, unsigned fields, struct bead_span span, struct bead_sample *sample,
                              struct bead_message *msg);
    void (*finish)(struct bead_run *run, double end, struct bead_outcome *outcome);
    struct bead_run_work (*work)(const struct bead_run *run);
    /* Method and step of such a run; `tolerance_factor` as in bead_run_settings. */
    enum bead_error (*pace)(const struct bead_chain *chain, const struct bead_simulate *asked, double tolerance_factor,
                            struct bead_pace *pace, struct bead_message *msg);
};

extern const struct bead_run_kind bead_run_of_equation;
const struct bead_run_kind *bead_run_kind_of(const struct bead_chain *chain);

/* A run of any kind. */
struct bead_runner {
    const struct bead_run_kind *kind; /* NULL: none */
    struct bead_run *run;
    const struct bead_chain *chain;
};
BEAD_CHECK enum bead_error bead_runner_create(const struct bead_run_settings *settings, struct bead_runner *runner,
                                              struct bead_message *msg);
void bead_runner_destroy(struct bead_runner *runner);
