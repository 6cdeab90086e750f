/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the method and the steps of a run from the settings of its scene: see run.h. */
#include <math.h>
#include <stdio.h>

#include "sim/base/wide.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/integrate/stepper.h"
#include "sim/run/method_choice.h"
#include "sim/run/run.h"

/* Tolerance of a comparison run, or its step if that is fixed, relative to the run: coarser, which is cheap, or finer if a coarser
 * run could not follow the motion. */
static const double coarser_tolerance = 10, finer_tolerance = 0.1, longer_step = 2, shorter_step = 0.5;

double bead_run_tolerance_factor(const struct bead_chain *const *chains, size_t count, const struct bead_simulate *asked)
{
    const bool fixed = asked->step > 0;
    bool room = chains[0]->spec->system->has_contacts || !fixed;
    for (size_t i = 0; chains[0]->spec->system->has_contacts && i < count; i++) {
        struct bead_method_choice choice;
        struct bead_message msg;
        double omega = bead_chain_omega(chains[i], bead_chain_energy(chains[i]));
        if (bead_choose_method(chains[i], asked, &choice, &msg))
            continue; /* the run itself will report it */
        room = room && (fixed ? longer_step * asked->step * omega <= choice.method->info.theta_max
                              : bead_method_theta(&choice, coarser_tolerance * asked->accuracy) < choice.cap);
    }
    if (fixed)
        return room ? longer_step : shorter_step;
    return room ? coarser_tolerance : finer_tolerance;
}

double bead_run_effective_factor(const struct bead_chain *chain, const struct bead_simulate *asked, double factor)
{
    struct bead_method_choice choice;
    struct bead_message msg;
    if (bead_choose_method(chain, asked, &choice, &msg))
        return factor; /* the run itself will report it */
    return fmin(factor, bead_pow(choice.cap / bead_method_theta(&choice, asked->accuracy), choice.order));
}

/* Steps are parts of the periods of contacts, and contacts without a force have none. */
static enum bead_error nothing_moves(const struct bead_chain *chain, struct bead_message *msg)
{
    char at[128];
    const bool starts = chain->spec->start_count > 0;
    const char *const key = starts ? "chain.start" : "chain.striker.velocity";
    return bead_fail(msg, BEAD_ERROR_SCENE,
                     "%s%s: nothing moves at first, so no step follows from the motion: give a velocity, such as `%s`, or a step, "
                     "such as `simulate: {step: 1 us}`",
                     bead_chain_place(chain, key, at, sizeof at), key,
                     starts ? "start: [{bead: 0, velocity: 0.4 m/s}]" : "velocity: 0.4 m/s");
}

enum bead_error bead_run_stepping(const struct bead_chain *chain, const struct bead_simulate *asked, double tolerance_factor,
                                  struct bead_stepping *stepping, struct bead_message *msg)
{
    struct bead_method_choice choice;
    char at[128];
    BEAD_TRY(bead_choose_method(chain, asked, &choice, msg));
    tolerance_factor = tolerance_factor > 0 ? tolerance_factor : 1;
    const struct bead_method_info *method = &choice.method->info;
    double omega = bead_chain_omega(chain, bead_chain_energy(chain)), step = tolerance_factor * asked->step;
    double theta = bead_method_theta(&choice, tolerance_factor * asked->accuracy);
    *stepping = (struct bead_stepping){.method = choice.method,
                                       .step = step > 0 ? step : theta / omega,
                                       .omega = omega,
                                       .theta = theta,
                                       .accuracy = choice.share * tolerance_factor * asked->accuracy,
                                       .variable = !(step > 0) && (method->variable || bead_chain_is_damped(chain)),
                                       .why = choice.why};
    /* omega is a generous bound: only steps of more than twice the limit are certainly unstable. */
    if (step * omega > 2 * method->theta_max)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%ssimulate.step: %.3g s is too long for `%s` to be stable: at most %.3g s",
                         bead_chain_place(chain, "simulate.step", at, sizeof at), step, method->name, method->theta_max / omega);
    if (!(stepping->step > 0) || !isfinite(stepping->step))
        return nothing_moves(chain, msg);
    return BEAD_OK;
}

/* Expected relative errors of peaks above this are worth a warning. */
static const double poor = 1e-4;

struct bead_long_step bead_run_long_step(const struct bead_chain *chain, const struct bead_simulate *asked)
{
    struct bead_long_step step = {""};
    struct bead_method_choice choice;
    struct bead_message msg;
    char at[128];
    const double omega = bead_chain_omega(chain, bead_chain_energy(chain));
    if (!(asked->step > 0) || bead_choose_method(chain, asked, &choice, &msg) ||
        !(bead_method_error(&choice, asked->step * omega) > poor))
        return step;
    snprintf(step.text, sizeof step.text,
             "%ssimulate.step: steps of %.3g us are too long: for peak forces to %.3g `%s` takes at most %.2g us here; "
             "leave `step` out, or check the uncertainties of the peaks",
             bead_chain_place(chain, "simulate.step", at, sizeof at), 1e6 * asked->step, asked->accuracy, choice.method->info.name,
             1e6 * bead_method_theta(&choice, asked->accuracy) / omega);
    return step;
}
