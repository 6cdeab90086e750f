/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds when the first pulse is over at the last contact and at the last sensor. */
#include "sim/run/front.h"

#include "sim/run/force_curve.h"

/* A pulse is over below the first part of its maximum, or at a minimum below the second. */
static const double over = 0.05, parted = 0.5;
/* The pulse has not arrived until the maximum exceeds this part of the largest force in the chain. */
static const double come = 1e-3;

/* A force may prolong the run by the time in which the front passes this many contacts. */
static const double patience = 40;

void bead_passing_begin(struct bead_passing *p, const struct bead_chain *chain)
{
    *p = (struct bead_passing){.places = 1, .time = NAN};
    p->patience = patience / (double)chain->contacts * bead_chain_passage(chain, bead_chain_energy(chain));
    p->place[0] = (struct bead_passing_place){{chain->contacts - 1}, 1, 0, NAN};
    size_t last = 0;
    for (size_t i = 0; i < chain->sensor_count; i++)
        last = chain->sensors[i].bead > last ? chain->sensors[i].bead : last;
    if (last == 0)
        return;
    struct bead_passing_place *sensor = &p->place[p->places++];
    *sensor = (struct bead_passing_place){{last - 1, last}, last < chain->contacts ? 2 : 1, 0, NAN};
}

/* The forces of a place over the last step. */
struct stretch {
    const struct bead_passing_place *place;
    struct bead_force_curve both, single[2]; /* of the place, and of each of its contacts */
    double level;                            /* N: subtracted from forces */
};

static double force_at(const void *context, double x)
{
    const struct stretch *p = context;
    double force = -p->level;
    for (size_t i = 0; i < p->place->contacts; i++)
        force += bead_force_curve_value(&p->single[i], x) - p->both.stepper->chain->static_force[p->place->contact[i]];
    return force;
}

/* The x at which the force falls below its level; 1 if it does not. */
static double find_fall(const struct stretch *p)
{
    double at0 = force_at(p, 0), at1 = force_at(p, 1);
    return at0 <= 0 ? 0 : at1 >= 0 ? 1 : bead_find_root(force_at, p, at0, at1);
}

/* The larger of the force at the end of the step and its maximum within it, if any. */
static double largest_within(const struct stretch *p, double rate0, double rate1)
{
    const double end = force_at(p, 1);
    const struct bead_curve_part whole = {&p->both, 0, 1};
    return rate0 > 0 && rate1 < 0 ? fmax(force_at(p, bead_curve_part_turn(&whole, rate0, rate1)), end) : end;
}

/* The x of a minimum that separates pulses; NaN: none. */
static double find_minimum(const struct stretch *p, double rate0, double rate1)
{
    const int parts = rate0 < 0 && rate1 > 0 ? 1 : BEAD_CURVE_PARTS;
    double x = NAN, before = rate0;
    for (int i = 1; i <= parts && isnan(x); i++) {
        const struct bead_curve_part part = {&p->both, (i - 1) / (double)parts, 1.0 / parts};
        const double after = i == parts ? rate1 : bead_force_curve_rate(&p->both, part.from + part.length);
        x = before < 0 && after > 0 ? bead_curve_part_turn(&part, before, after) : NAN;
        before = after;
    }
    return force_at(p, x) < parted * p->place->most ? x : NAN;
}

static void watch_place(struct bead_passing_place *place, double largest, const struct bead_stepper *s)
{
    double force = 0;
    for (size_t i = 0; i < place->contacts; i++)
        force += place->contact[i] < s->active ? s->end.f[place->contact[i]] : 0;
    if (!(fmax(place->most, force) > come * largest))
        return;
    struct stretch p = {.place = place, .level = 0};
    for (size_t i = 0; i < place->contacts; i++)
        p.single[i] = bead_force_curve_of(s, place->contact[i], false);
    p.both = place->contacts == 1 ? p.single[0] : bead_force_curve_of(s, place->contact[1], true);
    const double rate0 = bead_force_curve_rate(&p.both, 0), rate1 = bead_force_curve_rate(&p.both, 1);
    place->most = fmax(place->most, largest_within(&p, rate0, rate1));
    double x = find_minimum(&p, rate0, rate1);
    p.level = over * place->most;
    x = force_at(&p, 1) < 0 ? find_fall(&p) : x;
    place->passed = s->t0 + x * s->h;
}

void bead_passing_watch(struct bead_passing *p, const struct bead_front *front, const struct bead_stepper *s)
{
    double last = front->arrival; /* NaN: not yet */
    if (!isnan(p->time))
        return;
    for (size_t i = 0; i < p->places; i++) {
        struct bead_passing_place *place = &p->place[i];
        if (isnan(place->passed))
            watch_place(place, front->largest_force, s);
        last = isnan(place->passed) || isnan(last) ? NAN : fmax(last, place->passed);
    }
    const double most = front->arrival + p->patience;
    p->time = isnan(last) && s->t1 >= most ? most : last;
}
