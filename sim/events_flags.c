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
    e->limits = (struct bead_event_limits){&e->rule, e->hardness, BEAD_EVENTS_REACH, 0, 0};
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

/* Steps of nearly the same length share their limits. */
static const double alike = 0.9;

/* How far outside a branch point may matter at most: halving, to three digits. Fewer candidates are then to be weighed; so it is
 * with rates that matter nowhere. */
static void find_limits(struct bead_events *e, double h, double tolerance)
{
    const double worst = e->hardest * h * force_power(&e->rule, h * e->fastest);
    const double power = e->rule.hertz ? 1.5 : e->rule.spec->power;
    double low = 0, high = BEAD_EVENTS_REACH;
    while (e->fastest > 0 && high - low > 1e-3) {
        double x = 0.5 * (low + high);
        *(worst * loss_outside(x) > tolerance ? &low : &high) = x;
    }
    e->limits.reach = high;
    e->limits.slow = alike * pow(tolerance / (BEAD_EFFECT_INSIDE * e->hardest * h), 1 / power);
    e->limits.tolerance = tolerance;
    e->limits_h = h;
}

void bead_events_flag(struct bead_events *e, const struct bead_stepper *s)
{
    const double h = s->h;
    if (h > e->limits_h || h < alike * alike * e->limits_h || s->event_tolerance != e->limits.tolerance)
        find_limits(e, h / alike, s->event_tolerance);
    e->flagged_count = s->kernels->flag_events(s->active, &e->source, &e->limits, &e->flags);
}
