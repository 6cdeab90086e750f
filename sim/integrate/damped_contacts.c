/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the times at which contacts with damping open and close, where the stepper ends its steps: see damped_contacts.h. */
#include "sim/integrate/damped_contacts.h"

#include "sim/integrate/dense.h"

/* A contact this near to closing, in units of its motion in a step, counts as closed. */
static const double touching = 1e-6;
/* A change of the force's sign within this first part of a step counts as one at its start. */
static const double at_once = 1e-6;

/* Ahead of the front contacts open and close by rounding errors: forces that change velocities in a step by less than this part of
 * the largest at the start end no step. */
static const double unseen = 0x1p-43;

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
        s->closed[k] = d > 0 ? closed_force(s, k, d, change) > 0 : change >= 0 && d >= -touching * change * s->h;
    }
}

/* A contact over the step: its compression as a cubic, accurate enough to locate an event. */
struct contact_curve {
    const struct bead_stepper *stepper;
    size_t contact;
    struct bead_polynomial compression;
};

static double closing(const void *context, double x)
{
    const struct contact_curve *c = context;
    return bead_polynomial_value(&c->compression, x);
}

static double pushing(const void *context, double x)
{
    const struct contact_curve *c = context;
    double d = bead_polynomial_value(&c->compression, x), change = bead_polynomial_slope(&c->compression, x) / c->stepper->h;
    const double force = closed_force(c->stepper, c->contact, d, change);
    return force != 0 ? force : d;
}

static double change_of(const struct bead_stepper *s, size_t k)
{
    double d0 = bead_stepper_compression(s, &s->start, k), d1 = bead_stepper_compression(s, &s->end, k);
    double r0 = s->h * rate(&s->start, k), r1 = s->h * rate(&s->end, k);
    struct contact_curve curve = {s, k, {{d0, r0, 3 * (d1 - d0) - 2 * r0 - r1, 2 * (d0 - d1) + r0 + r1, 0, 0, 0, 0}}};
    if (!s->closed[k] && d0 < 0)
        return d1 > 0 ? fmax(bead_find_root(closing, &curve, d0, d1), 2 * at_once) : 1;
    /* Closed, or open although compressed: its force changes sign. */
    double f0 = pushing(&curve, 0), f1 = pushing(&curve, 1);
    if (fmax(fabs(f0), fabs(f1)) * s->h * s->chain->inverse_mass[k] < unseen * s->chain->speed)
        return 1;
    return (f0 > 0) != (f1 > 0) && (f0 > 0) == (s->closed[k] != 0) ? bead_find_root(pushing, &curve, f0, f1) : 1;
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
