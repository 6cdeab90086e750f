/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds up energies and integrates the loss to damping: see budget.h.
 *
 * The force f of a contact takes the power f D from the beads, with D the rate of its compression, and the elastic force e stores
 * e D: (f - e) D is lost. That is gamma |D|^(a+1) in a closed contact. If damping would pull, the contact has no force, and the
 * rest of its elastic energy is lost as it opens. Both are smooth within a step, because steps end where contacts close or open;
 * compressions within it are the polynomials used for samples. */
#include "sim/run/budget.h"

#include <math.h>

#include "sim/integrate/damped_contacts.h"
#include "sim/integrate/dense.h"

/* Gauss-Legendre quadrature on 0..1, exact up to degree 11. */
enum { NODES = 6 };
static const double node[NODES] = {0.033765242898423975, 0.16939530676686776, 0.38069040695840156,
                                   0.61930959304159844,  0.83060469323313224, 0.96623475710157603},
                    weight[NODES] = {0.085662246189585178, 0.18038078652406930, 0.23395696728634552,
                                     0.23395696728634552,  0.18038078652406930, 0.085662246189585178};

static double power(const struct bead_stepper *s, size_t k, double d, double rate)
{
    return (bead_damped_contacts_within(s, k, d, rate) - s->chain->law->force(s->table.stiffness[k], s->table.law, d)) * rate;
}

/* True if the beads of contact k move alike, or do not touch. */
static bool idle(const struct bead_stepper *s, size_t k)
{
    const bool still = s->start.v[k] == s->start.v[k + 1] && s->end.v[k] == s->end.v[k + 1];
    const bool open = s->was_closed && !s->was_closed[k] && bead_stepper_compression(s, &s->start, k) <= 0 &&
                      bead_stepper_compression(s, &s->end, k) <= 0;
    return still || open;
}

double bead_dissipation(const struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    double sum = 0;
    for (size_t k = 0; k < n && bead_stepper_damped(s); k++) {
        if (idle(s, k))
            continue;
        const struct bead_polynomial d = bead_dense_compression(s, k);
        for (int i = 0; i < NODES; i++)
            sum += weight[i] * power(s, k, bead_polynomial_value(&d, node[i]), bead_polynomial_slope(&d, node[i]) / s->h);
    }
    return sum * s->h;
}

/* Energy of a contact relative to its static state, including the work of the force that holds the precompression. Gravity is the
 * potential energy of the beads on their slope: contact k carries the weight of those above it, except that of the striker, which
 * the static state leaves out. */
static void add_contact(const struct bead_stepper *s, const struct bead_state *state, size_t k, struct bead_budget *budget)
{
    const struct bead_chain *c = s->chain;
    const double d0 = c->static_compression[k], change = state->u[k] - state->u[k + 1], a = c->stiffness[k];
    const double held = c->spec->tilt != 0 ? fmin(c->spec->precompression, c->static_force[k]) : c->static_force[k];
    *(k + 1 < c->beads ? &budget->contacts : &budget->wall) +=
        c->law->energy(a, &c->spec->law, d0 + change) - c->law->energy(a, &c->spec->law, d0) - held * change;
    budget->gravity -= (c->static_force[k] - held) * change;
}

/* A pendulum's is potential energy of gravity. */
static void add_spring(const struct bead_chain *c, size_t bead, double u, struct bead_budget *budget)
{
    const double gravity = 0.5 * bead_chain_pendulum_of(c, c->material[bead]) * (u * u);
    budget->gravity += gravity;
    budget->springs += bead_chain_spring_energy(c, bead, u) - gravity;
}

static struct bead_budget add_up(const struct bead_stepper *s, const struct bead_state *state, double dissipated)
{
    struct bead_budget budget = {.gravity = 0 - s->chain->striker_force * state->u[0], .dissipated = dissipated};
    for (size_t j = 0; j < s->active; j++) {
        budget.kinetic += 0.5 * s->chain->mass[j] * (state->v[j] * state->v[j]);
        if (s->chain->spring)
            add_spring(s->chain, j, state->u[j], &budget);
        if (j < s->chain->contacts)
            add_contact(s, state, j, &budget);
    }
    return budget;
}

enum bead_error bead_budget_find(const struct bead_stepper *s, double t, double dissipated, struct bead_budget *budget,
                                 struct bead_message *msg)
{
    struct bead_stepper *part;
    if (s->steps == 0 || t <= s->t0) {
        *budget = add_up(s, s->steps == 0 ? &s->end : &s->start, dissipated);
        return BEAD_OK;
    }
    if (t >= s->t1) {
        *budget = add_up(s, &s->end, dissipated + bead_dissipation(s));
        return BEAD_OK;
    }
    enum bead_error err = bead_stepper_branch(s, &part, msg);
    while (!err && part->t1 < t) { /* repeated if damped contacts close or open */
        bead_stepper_advance(part, t);
        dissipated += bead_dissipation(part);
    }
    if (!err)
        *budget = add_up(part, &part->end, dissipated);
    bead_stepper_destroy(err ? NULL : part);
    return err;
}
