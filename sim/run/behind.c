/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drops beads far behind the front, and follows the motion that this may have changed: see behind.h. */
#include "sim/run/behind.h"

#include "sim/chain/contact_walk.h"

/* Steps between cuts; fewest beads dropped at once; extra beads kept, and fewest beads kept. */
enum { EVERY = 8, FEWEST = 8, SPARE = 20, LEAST = 24 };
/* Beads between the edge and the target at the time of a peak. */
enum { MARGIN = 16 };
/* The front is where forces exceed this part of the largest. */
static const double part = 1e-4;

const char *bead_behind_refusal(const struct bead_chain *chain)
{
    if (!chain->law->hertz || chain->law->as_printed)
        return "only Hertz's law lets no signal catch up";
    if (bead_chain_is_damped(chain))
        return "damping changes the speed of signals";
    if (chain->striker_force != 0)
        return "gravity acts on all beads";
    if (chain->spring_rate > 0)
        return "springs pull beads back to their places";
    if (bead_is_driven(chain->spec))
        return "a drive goes on and on";
    if (chain->spec->start_count > 0)
        return "not only the striker moves at first";
    struct bead_contact_walk w; /* chains of a plan have no arrays */
    for (bead_contact_walk_start(&w, chain, true); bead_contact_walk_next(&w);) {
        if (w.static_compression < 0)
            return "beads that are apart hold the front up";
        if (w.static_force != 0)
            return "in a precompressed chain signals overtake the front";
    }
    return NULL;
}

/* Beads a second: sqrt(K/m) of the stiffest contact at bead x, with the mean mass m of its beads. */
static double signal_speed(const struct bead_stepper *s, size_t x)
{
    const struct bead_chain *c = s->chain;
    double most = 0;
    for (size_t k = x > 1 ? x - 1 : 0; k < x + 2 && k < c->contacts; k++) {
        const double stiffness = c->law->stiffness(c->stiffness[k], s->table.law, bead_stepper_compression(s, &s->end, k));
        most = fmax(most, 2 * stiffness / (c->mass[k] + c->mass[k + 1 < c->beads ? k + 1 : k]));
    }
    return sqrt(most);
}

static double energy_of(const struct bead_stepper *s, size_t from, size_t to)
{
    const struct bead_chain *c = s->chain;
    double energy = 0;
    for (size_t j = from; j < to; j++)
        energy += 0.5 * c->mass[j] * (s->end.v[j] * s->end.v[j]) +
                  c->law->energy(c->stiffness[j], s->table.law, bead_stepper_compression(s, &s->end, j));
    return energy;
}

double bead_behind_step(struct bead_behind *b, struct bead_stepper *s, double largest, bool peak)
{
    const size_t contacts = s->chain->contacts, before = s->first;
    if (!(b->widening > 0))
        return 0;
    if (before > 0)
        b->edge += s->h * signal_speed(s, (size_t)b->edge);
    b->reached = b->reached || (peak && before > 0 && b->edge + MARGIN > (double)b->target);
    if (s->steps % EVERY != 0)
        return 0;
    size_t front = bead_stepper_contacts(s);
    while (front > before && s->end.f[front - 1] < part * largest)
        front--;
    b->reached = b->reached || (before > 0 && b->edge > (double)front); /* it will be near any later peak */
    const double ahead = (double)contacts - (double)front;
    const double kept = fmax(LEAST, (double)front - (double)b->target + b->widening * ahead + SPARE);
    if (!((double)front - kept >= (double)(before + FEWEST)))
        return 0;
    bead_stepper_drop(s, (size_t)((double)front - kept));
    b->edge = fmax(b->edge, (double)s->first);
    return energy_of(s, before, s->first);
}
