/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the times at which contacts with damping open and close, where the stepper ends its steps: see damped_contacts.h. */
#include "sim/integrate/damped_contacts.h"

#include "sim/integrate/dense.h"

/* Choices far above rounding and far below a step: a tenth or ten times either changes no bit of the peaks of eleven damped chains
 * (exponents between .7 and 3, at 1e-4 and 1e-6). They miss a contact that opens and closes within such a part of a step. */

/* A force that changes sign within this first part of a step counts as changing at its start. */
static const double at_once = 1e-6;
/* A difference quotient over this part of a step. */
static const double nearby = 1e-4;

static double rate(const struct bead_state *state, size_t k)
{
    return state->v[k] - state->v[k + 1];
}

/* Force of a closed contact, N; negative if it would have to stick, 0 where it has opened and nothing damps it. */
static double closed_force(const struct bead_stepper *s, size_t k, double d, double change)
{
    double elastic = s->chain->law->force(s->table.stiffness[k], s->table.law, d);
    return s->table.damping > 0 ? elastic + bead_damping_force(&s->table, d, change) : elastic;
}

static double closed_force_in(const struct bead_stepper *s, const struct bead_state *state, size_t k)
{
    return closed_force(s, k, bead_stepper_compression(s, state, k), rate(state, k));
}

double bead_damped_contacts_within(const struct bead_stepper *s, size_t k, double d, double change)
{
    if (!s->was_closed) /* two-sided: never open */
        return closed_force(s, k, d, change);
    return s->was_closed[k] ? fmax(closed_force(s, k, d, change), 0) : 0;
}

void bead_damped_contacts_update(struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    for (size_t k = 0; k < n; k++) {
        const double d = bead_stepper_compression(s, &s->end, k), change = rate(&s->end, k);
        /* Beads at rest touch: damping acts between them from the first motion on. */
        s->closed[k] = d > 0 ? closed_force(s, k, d, change) > 0 : change >= 0 && !(d < 0);
    }
}

/* A contact over the step, with its compression as in samples. */
struct contact_curve {
    const struct bead_stepper *stepper;
    size_t contact;
    struct bead_polynomial compression;
};

/* Changes sign where a contact opens, or closes although compressed. */
static double push(const struct bead_stepper *s, size_t k, double d, double change)
{
    const double force = s->table.damping > 0 ? closed_force(s, k, d, change) : d;
    return force != 0 ? force : d;
}

static double push_in(const struct bead_stepper *s, const struct bead_state *state, size_t k)
{
    return push(s, k, bead_stepper_compression(s, state, k), rate(state, k));
}

static double closing(const void *context, double x)
{
    const struct contact_curve *c = context;
    return bead_polynomial_value(&c->compression, x);
}

static double pushing(const void *context, double x)
{
    const struct contact_curve *c = context;
    double d = bead_polynomial_value(&c->compression, x), change = bead_polynomial_slope(&c->compression, x) / c->stepper->h;
    return push(c->stepper, c->contact, d, change);
}

/* Does the contact, open at the start, close as its beads touch? */
static bool closes(const struct bead_stepper *s, size_t k)
{
    return !s->closed[k] && bead_stepper_compression(s, &s->start, k) < 0;
}

/* What a force of 1 N in a contact accelerates its beads by, together. */
static double lightness(const struct bead_stepper *s, size_t k)
{
    return s->chain->inverse_mass[k] + (k + 1 < s->beads ? s->chain->inverse_mass[k + 1] : 0);
}

static double change_of(const struct bead_stepper *s, size_t k)
{
    const bool closing_now = closes(s, k);
    const double f0 = closing_now ? bead_stepper_compression(s, &s->start, k) : push_in(s, &s->start, k),
                 f1 = closing_now ? bead_stepper_compression(s, &s->end, k) : push_in(s, &s->end, k);
    if ((f0 > 0) == (f1 > 0) || (f0 > 0) != (s->closed[k] != 0))
        return 1;
    if (fmax(fabs(closed_force_in(s, &s->start, k)), fabs(closed_force_in(s, &s->end, k))) * s->h * lightness(s, k) <
        s->event_tolerance)
        return 1;
    const struct contact_curve curve = {s, k, bead_dense_compression(s, k)};
    return closing_now ? fmax(bead_find_root(closing, &curve, f0, f1), 2 * at_once) : bead_find_root(pushing, &curve, f0, f1);
}

double bead_damped_contacts_miss(const struct bead_stepper *s, size_t k)
{
    const double d = bead_stepper_compression(s, &s->end, k), change = rate(&s->end, k);
    double off, jump; /* in steps, and its effect on a velocity per step, m/s */
    if (closes(s, k)) {
        off = d / (change * s->h);
        jump = off * closed_force(s, k, fmax(d, 0), change);
    } else {
        const struct contact_curve curve = {s, k, bead_dense_compression(s, k)};
        const double slope = (push(s, k, d, change) - pushing(&curve, 1 - nearby)) / nearby;
        off = push(s, k, d, change) / slope;
        jump = s->table.damping > 0 ? 0.5 * off * off * slope : 0;
    }
    return fabs(jump) * s->h * lightness(s, k) > s->event_tolerance && fabs(off) < 1 ? -off : 0; /* further away is another event */
}

struct bead_damped_contact bead_damped_contacts_first(const struct bead_stepper *s)
{
    const size_t n = bead_stepper_contacts(s);
    struct bead_damped_contact first = {1, 0};
    for (size_t k = 0; k < n; k++) {
        bool idle = !s->closed[k] && !(bead_stepper_compression(s, &s->end, k) > 0);
        double at = idle ? 1 : change_of(s, k);
        if (at > at_once && at < first.at)
            first = (struct bead_damped_contact){at, k};
    }
    return first;
}
