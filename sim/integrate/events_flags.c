/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides which contacts of a step need a correction; events.c then makes it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/integrate/events_private.h"

/* Room for `count` elements of `size` bytes in an array that keeps what it has. */
bool bead_events_grow(void **array, size_t *room, size_t count, size_t size)
{
    if (count <= *room)
        return true;
    void *made = reallocarray(*array, count + count / 2 + 16, size);
    if (!made)
        return false;
    *array = made;
    *room = count + count / 2 + 16;
    return true;
}

/* Contacts that have been as fast as this part of the striker, which those of most chains are, count as they are; and rates that
 * are too small to be weighed, as parts of that. */
static const double usual_speed = 1 / 8.0, least_speed = 1 / 16384.0;

/* Two beads of reduced mass m part or meet at less than sqrt(2 E/m). On a slope the energy grows: no bound. */
void bead_events_bound(struct bead_events *e, const struct bead_stepper *s)
{
    double lightest = 0;
    for (size_t k = 0; k < s->beads; k++) {
        double left = e->inverse_mass[k], right = e->inverse_mass[k + 1];
        e->hardness[k] = e->speeds.weighed[k] = e->stiffness[k] * fmax(left, right);
        e->hardest = fmax(e->hardest, e->hardness[k]);
        lightest = fmax(lightest, left + right);
    }
    e->fastest = s->chain->striker_force == 0 ? sqrt(2 * bead_chain_energy(s->chain) * lightest) : 0;
    e->limits = (struct bead_event_limits){&e->rule, e->speeds.weighed, BEAD_EVENTS_REACH, 0, 0};
    e->unit = fabs(s->chain->spec->striker_velocity);
    e->speeds.unit = e->unit * usual_speed;
    e->speeds.least = e->speeds.unit * least_speed;
}

static double force_power(const struct bead_patch_rule *rule, double r)
{
    return rule->hertz ? r * sqrt(r) : pow(r, rule->exponent);
}

/* Its inverse. bead_pow takes as long as a tenth of a step. */
static double force_root(const struct bead_patch_rule *rule, double power)
{
    const double root = rule->hertz ? bead_cbrt(power) : 0;
    return rule->hertz ? root * root : bead_pow(power, 1 / rule->exponent);
}

/* Effect in units of A (h r)^p h/m of a branch point x steps outside. */
static double loss_outside(double x)
{
    const double near = 1 + x * (1 / BEAD_EFFECT_DECAY), far = (1 + 0.5 * x) * (1 + 0.5 * x);
    return BEAD_EFFECT_OUTSIDE / (near * near * near * far * far);
}

/* Steps of nearly the same length share their limits. */
static const double alike = 0.9;

/* How far outside a branch point may matter at most: halving, to three digits. Fewer candidates are then to be weighed; so it is
 * with rates that matter nowhere. */
static void find_limits(struct bead_events *e, double h, double tolerance)
{
    const double worst = e->hardest * h * force_power(&e->rule, h * e->fastest);
    double low = 0, high = BEAD_EVENTS_REACH;
    while (e->fastest > 0 && high - low > 1e-3) {
        double x = 0.5 * (low + high);
        *(worst * loss_outside(x) > tolerance ? &low : &high) = x;
    }
    e->limits.reach = high;
    e->limits.slow = alike * force_root(&e->rule, tolerance / (BEAD_EFFECT_INSIDE * e->hardest * h));
    e->limits.tolerance = tolerance;
    e->limits_h = h;
}

/* Arrays of the flagged contacts, which keep what they have. */
static bool make_room(struct bead_events *e, size_t count)
{
    struct bead_kinks *k = &e->kinks;
    double **const array[] = {&e->flags.effect, &k->left,      &k->impulse[0], &k->impulse[1],
                              &k->impulse[2],   &k->moment[0], &k->moment[1],  &k->moment[2]};
    size_t room = e->flag_room;
    bool ok = bead_events_grow((void **)&e->flags.contact, &room, count, sizeof *e->flags.contact);
    for (size_t i = 0; ok && i < sizeof array / sizeof *array; i++) {
        room = e->flag_room;
        ok = bead_events_grow((void **)array[i], &room, count, sizeof(double));
    }
    e->flag_room = ok ? room : e->flag_room;
    return ok;
}

/* Which of contacts 0..n-1 of `source` matter, and their kinks. Returns how many. */
static size_t flag_some(const struct bead_events *e, const struct bead_stepper *s, size_t n, const struct bead_patch_source *source,
                        const struct bead_event_limits *limits, struct bead_event_flags *flags, struct bead_kinks *kinks)
{
    const size_t count = s->kernels->flag_events(n, source, limits, flags);
    if (count > 0 && e->kinks_known)
        s->kernels->correct_kinks(source, &e->method, count, flags, s->event_tolerance, kinks);
    return count;
}

/* Contacts from.. of the chain, n of them: those that matter come behind the ones there are. */
static size_t flag_block(const struct bead_events *e, const struct bead_stepper *s, size_t from, size_t n)
{
    const size_t at = e->flagged_count;
    struct bead_event_flags flags = e->flags;
    struct bead_event_limits limits = e->limits;
    struct bead_kinks kinks = e->kinks;
    struct bead_patch_source source = e->source;
    const double **const moved[] = {&source.u0,           &source.v0,           &source.a0,        &source.u1,
                                    &source.v1,           &source.a1,           &source.stiffness, &source.static_compression,
                                    &source.static_force, &source.inverse_mass, &limits.hardness};
    double **const behind[] = {&flags.effect,     &kinks.left,      &kinks.impulse[0], &kinks.impulse[1],
                               &kinks.impulse[2], &kinks.moment[0], &kinks.moment[1],  &kinks.moment[2]};
    for (size_t i = 0; i < sizeof moved / sizeof *moved; i++)
        *moved[i] += from;
    for (size_t i = 0; i < sizeof behind / sizeof *behind; i++)
        *behind[i] += at;
    flags.contact += at;
    const size_t count = flag_some(e, s, n, &source, &limits, &flags, &kinks);
    for (size_t i = 0; i < count; i++)
        flags.contact[i] += from;
    return count;
}

/* The last contact of a block is the one before the next one's first. */
static void pass_on(struct bead_event_flags *flags)
{
    double *const array[] = {flags->d0, flags->r0, flags->d1, flags->r1};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        *(array[i] - 1) = *(array[i] + BEAD_EVENTS_BLOCK - 1);
}

bool bead_events_flag(struct bead_events *e, const struct bead_stepper *s)
{
    const double h = s->h;
    if (h > e->limits_h || h < alike * alike * e->limits_h || s->event_tolerance != e->limits.tolerance)
        find_limits(e, h / alike, s->event_tolerance);
    e->flagged_count = 0;
    e->flags.d0[-1] = e->flags.r0[-1] = e->flags.d1[-1] = e->flags.r1[-1] = 0; /* of the striker, which has none before it */
    for (size_t from = 0; from < s->active; from += BEAD_EVENTS_BLOCK) {
        const size_t left = s->active - from, n = left < BEAD_EVENTS_BLOCK ? left : BEAD_EVENTS_BLOCK;
        if (from > 0)
            pass_on(&e->flags);
        /* For as many as will be active some time: room that grows with every step costs more than the step. */
        const size_t most = s->beads - from < BEAD_EVENTS_BLOCK ? s->beads - from : BEAD_EVENTS_BLOCK;
        if (!make_room(e, e->flagged_count + most + BEAD_EVENTS_MARGIN))
            return false;
        e->flagged_count += from > 0 ? flag_block(e, s, from, n) : flag_some(e, s, n, &e->source, &e->limits, &e->flags, &e->kinks);
    }
    return true;
}
