/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses method and step for a chain, from its scene, forces and energy; the plan tells why. */
#include "sim/run/method_choice.h"

#include <math.h>
#include <string.h>

#include "sim/base/wide.h"
#include "sim/chain/contact_walk.h"
#include "sim/integrate/stepper.h"

/* The accuracy that the theta in a method's row stands for. */
static const double row_accuracy = 1e-6;
/* From this accuracy on, contact events need no correction: shorter steps without it cost less (tests/bench). */
static const double low_accuracy = 1.5e-4;
/* Where contacts cannot open, forces are smooth. Peaks are better than asked then (tests/bench); what bounds these steps is the
 * energy of the fastest vibrations over many periods (tests/stress). Only far from opening: the branch point spoils much before it
 * is reached. */
static const double smooth_theta = 1, smooth_order = 8, smooth_cap = 2.2, far_from_opening = 0.1;

/* With damping steps follow the state, which takes shorter ones than a bound for the whole run. */
static const double damped_part = 0.7;
/* Where the damping's exponent a is below 1 its force has an infinite slope at every turn of a contact, which leaves the order 1 +
 * a. Steps are those of other damping at this accuracy. */
static const double steep_accuracy = 1e-3;

/* Errors add up on the way along a chain, and grow behind the front where it is disordered: with contacts that open, chains of more
 * than `usual_beads` are stepped for an accuracy smaller by this power of their length, up to about as many beads as the longest
 * have that peaks were compared for (tests/stress/stress_accuracy.c). */
static const double usual_beads = 70, most_beads = 600, length_power = 1.2;

static double share_of(const struct bead_chain *chain)
{
    const double beads = (double)chain->beads;
    return beads > usual_beads ? bead_pow(usual_beads / fmin(beads, most_beads), length_power) : 1;
}

/* Energy that would open a contact, J. */
static double opening_energy(const struct bead_contact_walk *w)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    return w->static_force * w->static_compression - law->row->energy(w->stiffness, law, w->static_compression);
}

/* No contact can hold more energy above the static state than the striker brings. */
static bool never_opens(const struct bead_chain *chain)
{
    const double v = chain->spec->striker_velocity, energy = 0.5 * chain->striker_mass * v * v;
    bool never = chain->law->one_sided;
    struct bead_contact_walk w;
    for (bead_contact_walk_start(&w, chain, true); never && bead_contact_walk_next(&w);)
        never = energy < far_from_opening * opening_energy(&w);
    return never;
}

static void allow_for_damping(const struct bead_chain *chain, struct bead_method_choice *choice)
{
    const double a = chain->spec->damping_exponent;
    choice->theta *= damped_part;
    if (!(a < 1))
        return;
    const double order = 1 + a;
    choice->theta *= bead_pow(steep_accuracy / row_accuracy, 1 / choice->order - 1 / order);
    choice->order = order;
}

/* The method that `auto` picks, and why. */
static const char *automatic(const struct bead_chain *chain, double share, double accuracy, const char **why)
{
    if (chain->spec->damping_coefficient > 0) {
        *why = "damping: forces follow velocities";
        return "rk4";
    }
    if (!chain->law->one_sided) {
        *why = "contacts pull as well as push: nothing opens";
        return "rkn8-plain";
    }
    if (never_opens(chain)) {
        *why = "the energy cannot open any contact";
        return "rkn8-plain";
    }
    if (share * accuracy >= low_accuracy) {
        *why = "the requested accuracy is low: contact events need no correction";
        return "rkn8-plain";
    }
    if (!chain->law->exponent) {
        *why = "contact events cannot be corrected: the law is not a power of the compression";
        return "rkn8-plain";
    }
    *why = "contacts open and close";
    return "rkn8";
}

enum bead_error bead_choose_method(const struct bead_chain *chain, const struct bead_simulate *asked,
                                   struct bead_method_choice *choice, struct bead_message *msg)
{
    const char *file = chain->scene->file, *why = "as asked";
    const bool any = strcmp(asked->method, "auto") == 0;
    const double share = share_of(chain);
    const char *name = any ? automatic(chain, share, asked->accuracy, &why) : asked->method;
    const struct bead_method *method = bead_method_row(name);
    if (!method)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: simulate.method: there is no method `%s`: see --list methods", file, name);
    if (chain->spec->damping_coefficient > 0 && !method->info.damping)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%s: simulate.method: `%s` is for forces without damping; use rk4 or auto", file,
                         name);
    if (method->events && chain->law->one_sided && !chain->law->exponent)
        return bead_fail(msg, BEAD_ERROR_SCENE,
                         "%s: simulate.method: `%s` corrects contact events, which law `%s` does not allow; use rkn8-plain or auto",
                         file, name, chain->law->name);
    *choice = (struct bead_method_choice){method, method->info.theta, method->info.theta_order, method->info.theta_cap, 1, why};
    if (chain->spec->damping_coefficient > 0)
        allow_for_damping(chain, choice);
    if (method->events && chain->law->one_sided)
        choice->share = share;
    if (!any || !method->tableau)
        return BEAD_OK;
    if (never_opens(chain)) {
        choice->theta = smooth_theta;
        choice->order = smooth_order;
        choice->cap = smooth_cap;
    } else if (!chain->law->one_sided) {
        /* Steps of the corrected method, whose errors are those of smooth forces as well. */
        const struct bead_method_info *corrected = &bead_method_row("rkn8")->info;
        choice->theta = corrected->theta;
        choice->order = corrected->theta_order;
    }
    return BEAD_OK;
}

double bead_method_theta(const struct bead_method_choice *choice, double accuracy)
{
    return fmin(choice->theta * bead_pow(choice->share * accuracy / row_accuracy, 1 / choice->order), choice->cap);
}

double bead_method_error(const struct bead_method_choice *choice, double theta)
{
    return fmin(row_accuracy / choice->share * pow(theta / choice->theta, choice->order), 1);
}
