/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of run_kinds.h for beads; that for equations is in equation_run.c. */
#include "sim/run/run_kinds.h"

#include "sim/chain/chain_data.h"
#include "sim/integrate/stepper.h"

/* A sampling interval in units of 1/omega that shows every oscillation. */
static const double resolving = 0.25;

static enum bead_error pace_of_beads(const struct bead_chain *chain, const struct bead_simulate *asked, double tolerance_factor,
                                     struct bead_pace *pace, struct bead_message *msg)
{
    struct bead_stepping stepping;
    enum bead_error err = bead_run_stepping(chain, asked, tolerance_factor, &stepping, msg);
    if (!err)
        *pace = (struct bead_pace){stepping.method->info.name, stepping.step, resolving / stepping.omega, stepping.variable,
                                   stepping.why};
    return err;
}

static const struct bead_run_kind of_beads = {
    .create = bead_run_create,
    .destroy = bead_run_destroy,
    .time = bead_run_time,
    .over = bead_run_over,
    .is_lost = bead_run_is_lost,
    .is_cut_short = bead_run_cut_short,
    .give_up = bead_run_give_up,
    .step = bead_run_step,
    .sample = bead_run_sample,
    .finish = bead_run_finish,
    .work = bead_run_work,
    .pace = pace_of_beads,
};

const struct bead_run_kind *bead_run_kind_of(const struct bead_chain *chain)
{
    return chain->spec->system->has_contacts ? &of_beads : &bead_run_of_equation;
}

enum bead_error bead_runner_create(const struct bead_run_settings *settings, struct bead_runner *runner, struct bead_message *msg)
{
    *runner = (struct bead_runner){bead_run_kind_of(settings->chain), NULL, settings->chain};
    return runner->kind->create(settings, &runner->run, msg);
}

void bead_runner_destroy(struct bead_runner *runner)
{
    if (runner->kind && runner->run)
        runner->kind->destroy(runner->run);
    *runner = (struct bead_runner){NULL, NULL, NULL};
}
