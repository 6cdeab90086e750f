/* Which contacts of a step have to be corrected. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/events_private.h"

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

/* Two beads of reduced mass m part or meet at less than sqrt(2 E/m). On a slope the energy grows: no bound. */
void bead_events_bound(struct bead_events *e, const struct bead_stepper *s)
{
    double lightest = 0;
    for (size_t k = 0; k < s->beads; k++) {
        double left = e->inverse_mass[k], right = e->inverse_mass[k + 1];
        e->hardness[k] = e->stiffness[k] * fmax(left, right);
        e->hardest = fmax(e->hardest, e->hardness[k]);
        lightest = fmax(lightest, left + right);
    }
    e->fastest = s->chain->striker_force == 0 ? sqrt(2 * bead_chain_energy(s->chain) * lightest) : 0;
    e->reach = BEAD_EVENTS_REACH;
}

static double force_power(const struct bead_patch_rule *rule, double r)
{
    return rule->hertz ? r * sqrt(r) : pow(r, rule->spec->power);
}

/* Effect in units of A (h r)^p h/m of a branch point x steps outside. */
static double loss_outside(double x)
{
    const double near = 1 + x * (1 / BEAD_EFFECT_DECAY), far = (1 + 0.5 * x) * (1 + 0.5 * x);
    return BEAD_EFFECT_OUTSIDE / (near * near * near * far * far);
}

/* How far outside a branch point may matter at most: halving, to three digits. Fewer candidates then need effect_of(). */
static void find_reach(struct bead_events *e, double h, double tolerance)
{
    const double worst = e->hardest * h * force_power(&e->rule, h * e->fastest);
    double low = 0, high = BEAD_EVENTS_REACH;
    while (e->fastest > 0 && high - low > 1e-3) {
        double x = 0.5 * (low + high);
        *(worst * loss_outside(x) > tolerance ? &low : &high) = x;
    }
    e->reach = high;
    e->reach_h = h;
    e->reach_tolerance = tolerance;
}

/* The same in units of A h/m of the one that compression d and rate h r, away from zero, point to. */
static double outside(const struct bead_events *e, double d, double r)
{
    return r > 0 && d < e->reach * r ? force_power(&e->rule, r) * loss_outside(d / r) : 0;
}

static double larger(double x, double y)
{
    return x > y ? x : y;
}

/* What contact k can do to a velocity, m/s. */
static double effect_of(const struct bead_events *e, const struct bead_stepper *s, size_t k, double h)
{
    const double *u = s->start.u, *v = s->start.v, *y = s->end.u, *w = s->end.v, d = e->static_compression[k];
    double d0 = d + (u[k] - u[k + 1]), d1 = d + (y[k] - y[k + 1]), r0 = h * (v[k] - v[k + 1]), r1 = h * (w[k] - w[k + 1]);
    double loss;
    if (d0 > 0 && d1 > 0 && !(r0 < 0 && r1 > 0))
        loss = larger(outside(e, d0, r0), outside(e, d1, -r1));
    else
        loss = BEAD_EFFECT_INSIDE * force_power(&e->rule, larger(fabs(r0), fabs(r1)));
    return loss * h * e->hardness[k];
}

bool bead_events_flag(struct bead_events *e, const struct bead_stepper *s)
{
    const double h = s->h;
    e->flagged_count = 0;
    if (h != e->reach_h || s->event_tolerance != e->reach_tolerance)
        find_reach(e, h, s->event_tolerance);
    const struct bead_event_ends ends = {.static_compression = e->static_compression,
                                         .u0 = s->start.u,
                                         .v0 = s->start.v,
                                         .u1 = s->end.u,
                                         .v1 = s->end.v,
                                         .h = h,
                                         .reach = e->reach};
    if (!s->kernels->mark_events(s->active, &ends, e->mark))
        return true;
    for (size_t i = 0; i * BEAD_EVENTS_LANES < s->active; i++) {
        uint64_t left;
        memcpy(&left, e->mark + i * BEAD_EVENTS_LANES, BEAD_EVENTS_LANES);
        for (; left; left &= left - 1) {
            size_t k = i * BEAD_EVENTS_LANES + (size_t)__builtin_ctzll(left) / 8;
            const double change = effect_of(e, s, k, h);
            if (!(change > s->event_tolerance))
                continue;
            if (!bead_events_grow((void **)&e->flagged, &e->flagged_room, e->flagged_count + 1, sizeof *e->flagged) ||
                !bead_events_grow((void **)&e->effect, &e->effect_room, e->flagged_count + 1, sizeof *e->effect))
                return false;
            e->effect[e->flagged_count] = change;
            e->flagged[e->flagged_count++] = k;
        }
    }
    return true;
}

bool bead_events_simple(const struct bead_events *e, const struct bead_stepper *s, size_t k)
{
    const double *u = s->start.u, *v = s->start.v, *y = s->end.u, *w = s->end.v, d = e->static_compression[k];
    double d0 = d + (u[k] - u[k + 1]), d1 = d + (y[k] - y[k + 1]), r0 = v[k] - v[k + 1], r1 = w[k] - w[k + 1];
    return d0 > 0 ? d1 <= 0 && (r0 < 0 || r1 < 0) : d1 > 0 && (r0 > 0 || r1 > 0);
}
