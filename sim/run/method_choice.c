/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses method and step for a chain from its scene, forces and energy, and gives the reason for the plan. */
#include "sim/run/method_choice.h"

#include <math.h>

#include "sim/base/wide.h"
#include "sim/chain/contact_walk.h"
#include "sim/chain/drive.h"
#include "sim/chain/law_beginning.h"
#include "sim/integrate/stepper.h"

/* The accuracy for which a method's row gives theta. */
static const double row_accuracy = 1e-6;
/* From this accuracy, shorter steps without correction of contact events cost less (tests/bench). */
static const double low_accuracy = 1.5e-4;
/* If contacts cannot open, forces are smooth and peaks are more accurate than requested (tests/bench); the energy of the fastest
 * vibrations over many periods limits the steps (tests/stress). Only far from opening: the branch point does harm long before a
 * contact reaches it. */
static const double smooth_theta = 1, smooth_order = 8, smooth_cap = 2.2, far_from_opening = 0.1;

/* With damping, steps follow the state, and must be shorter than with a bound for the whole run. */
static const double damped_part = 0.7;
/* Errors add up along a chain, and grow behind the front if it is disordered: if contacts open, chains of more than `usual_beads`
 * are stepped for an accuracy smaller by this power of their length, up to about the longest chains whose peaks were compared
 * (tests/stress/stress_accuracy.c). */
static const double usual_beads = 70, most_beads = 600, length_power = 1.2;

static double share_of(const struct bead_chain *chain)
{
    const double beads = (double)chain->beads;
    return beads > usual_beads ? bead_pow(usual_beads / fmin(beads, most_beads), length_power) : 1;
}

bool bead_is_long(const struct bead_chain *chain)
{
    return (double)chain->beads > most_beads;
}

/* Energy that would open a contact, J. */
static double opening_energy(const struct bead_contact_walk *w)
{
    const struct bead_law_spec *law = &w->chain->spec->law;
    return w->static_force * w->static_compression - law->row->energy(w->stiffness, law, w->static_compression);
}

/* No contact can store more energy above the static state than the striker and other beads that move at first bring. */
static bool never_opens(const struct bead_chain *chain)
{
    const double v = chain->spec->striker_velocity, energy = 0.5 * chain->striker_mass * v * v + chain->started;
    bool never = chain->law->one_sided && !bead_is_driven(chain->spec);
    struct bead_contact_walk w;
    for (bead_contact_walk_start(&w, chain, true); never && bead_contact_walk_next(&w);)
        never = energy < far_from_opening * opening_energy(&w);
    return never;
}

struct reason {
    const char *method, *why;
};

/* The method that `auto` picks. */
static struct reason automatic(const struct bead_chain *chain, double share, double accuracy)
{
    if (bead_chain_is_damped(chain))
        return (struct reason){"rk8", "damping: forces depend on velocities"};
    if (!chain->law->one_sided)
        return (struct reason){"rkn8-plain", "contacts pull as well as push: nothing opens"};
    if (never_opens(chain))
        return (struct reason){"rkn8-plain", "the energy cannot open any contact"};
    if (share * accuracy >= low_accuracy)
        return (struct reason){"rkn8-plain", "the requested accuracy is low: contact events need no correction"};
    if (isnan(bead_chain_exponent(chain)))
        return (struct reason){"rkn8-plain",
                               "contact events cannot be corrected: the law's force does not begin as a power of the compression"};
    return (struct reason){"rkn8", "contacts open and close"};
}

enum bead_error bead_choose_method(const struct bead_chain *chain, const struct bead_simulate *asked,
                                   struct bead_method_choice *choice, struct bead_message *msg)
{
    const bool any = strcmp(asked->method, "auto") == 0;
    const double share = share_of(chain);
    const struct reason reason = any ? automatic(chain, share, asked->accuracy) : (struct reason){asked->method, "as asked"};
    char at[128];
    const char *file = bead_chain_place(chain, "simulate.method", at, sizeof at), *name = reason.method;
    const struct bead_method *method = bead_method_row(name);
    if (!method)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%ssimulate.method: there is no method `%s`: see --list methods", file, name);
    if (bead_chain_is_damped(chain) && !method->info.damping)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%ssimulate.method: `%s` is for forces without damping; use rk8, rk4 or auto", file,
                         name);
    if (bead_is_driven(chain->spec) && method->composition)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%ssimulate.method: `%s` does not support drives; use rk8, rk4, rkn8 or auto", file,
                         name);
    if (method->events && chain->law->one_sided && isnan(bead_chain_exponent(chain)))
        return bead_fail(msg, BEAD_ERROR_SCENE,
                         "%ssimulate.method: `%s` corrects contact events, which law `%s` does not allow; use rkn8-plain or auto",
                         file, name, chain->law->name);
    *choice =
        (struct bead_method_choice){method, method->info.theta, method->info.theta_order, method->info.theta_cap, 1, reason.why};
    if (bead_chain_is_damped(chain))
        choice->theta *= damped_part;
    if (method->events && chain->law->one_sided)
        choice->share = share;
    if (!any || !method->tableau || method->tableau->av)
        return BEAD_OK;
    if (never_opens(chain)) {
        choice->theta = smooth_theta;
        choice->order = smooth_order;
        choice->cap = smooth_cap;
    } else if (!chain->law->one_sided) {
        /* Steps of the corrected method, whose errors are like those of smooth forces. */
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
