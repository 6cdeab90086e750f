/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the contacts of a step that need a correction, which events.c then makes. */

#include "sim/base/elementary.h"
#include "sim/base/wide.h"
#include "sim/chain/law_beginning.h"
#include "sim/integrate/events_private.h"

/* Speed of a contact with weight 1 in units of the striker's velocity, reached in most chains; and the slowest contact that is
 * weighed, in units of that. */
static const double usual_speed = 1 / 8.0, least_speed = 1 / 16384.0;

/* Two beads of reduced mass m separate or meet at less than sqrt(2 E/m). On a slope, or with a drive, the energy grows: no bound.
 */
void bead_events_bound(struct bead_events *e, const struct bead_stepper *s)
{
    double lightest = 0;
    for (size_t k = 0; k < s->beads; k++) {
        double left = e->inverse_mass[k], right = e->inverse_mass[k + 1];
        e->hardness[k] = e->speeds.weighed[k] = bead_chain_coefficient(s->chain, k, e->rule.exponent) * fmax(left, right);
        e->hardest = fmax(e->hardest, e->hardness[k]);
        lightest = fmax(lightest, left + right);
    }
    e->fastest = s->chain->striker_force == 0 && s->driven == SIZE_MAX ? sqrt(2 * bead_chain_energy(s->chain) * lightest) : 0;
    e->limits =
        (struct bead_event_limits){&e->rule, e->speeds.weighed, BEAD_EFFECT_OUTSIDE, BEAD_EFFECT_DECAY, BEAD_EVENTS_REACH, 0, 0};
    e->unit = s->chain->speed;
    e->speeds.unit = e->unit * usual_speed;
    e->speeds.least = e->speeds.unit * least_speed;
}

static double force_power(const struct bead_patch_rule *rule, double r)
{
    return rule->hertz ? r * sqrt(r) : pow(r, rule->exponent);
}

/* Its inverse, if possible without bead_pow, which takes a tenth of a step's time. */
static double force_root(const struct bead_patch_rule *rule, double power)
{
    const double root = rule->hertz ? bead_cbrt(power) : 0;
    return rule->hertz ? root * root : bead_pow(power, 1 / rule->exponent);
}

/* Effect of a branch point x steps outside, in units of A (h r)^p h/m. */
static double loss_outside(const struct bead_event_limits *limits, double x)
{
    const double near = 1 + x * (1 / limits->decay), far = (1 + 0.5 * x) * (1 + 0.5 * x);
    return limits->outside / (near * near * near * far * far);
}

/* Steps of nearly the same length share their limits. */
static const double alike = 0.9;

/* Finds the largest distance at which a branch point outside matters, by bisection to three digits, and the slowest rates that
 * matter anywhere: both reduce the number of candidates. */
static void find_limits(struct bead_events *e, double h, double tolerance)
{
    const double worst = e->hardest * h * force_power(&e->rule, h * e->fastest);
    double low = 0, high = BEAD_EVENTS_REACH;
    while (e->fastest > 0 && high - low > 1e-3) {
        double x = 0.5 * (low + high);
        *(worst * loss_outside(&e->limits, x) > tolerance ? &low : &high) = x;
    }
    e->limits.reach = high;
    e->limits.slow = alike * force_root(&e->rule, tolerance / (BEAD_EFFECT_INSIDE * e->hardest * h));
    e->limits.tolerance = tolerance;
    e->limits_h = h;
}

/* Flags contacts of the beads that have not been dropped; kernels count from their first. */
static size_t flag_kept(struct bead_events *e, const struct bead_stepper *s)
{
    const size_t o = s->first;
    struct bead_patch_source source = e->source;
    struct bead_event_limits limits = e->limits;
    struct bead_event_flags flags = {e->flags.d0 + o, e->flags.r0 + o,  e->flags.d1 + o,
                                     e->flags.r1 + o, e->flags.contact, e->flags.effect};
    const double **const array[] = {&source.u0, &source.v0, &source.u1, &source.v1, &source.static_compression, &limits.hardness};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        *array[i] += o;
    flags.d0[-1] = flags.r0[-1] = flags.d1[-1] = flags.r1[-1] = 0; /* no contact before the first bead */
    const size_t count = s->kernels->flag_events(s->active - o, &source, &limits, &flags);
    for (size_t i = 0; i < count; i++)
        flags.contact[i] += o;
    return count;
}

void bead_events_flag(struct bead_events *e, const struct bead_stepper *s, double tolerance)
{
    const double h = s->h;
    if (h > e->limits_h || h < alike * alike * e->limits_h || tolerance != e->limits.tolerance)
        find_limits(e, h / alike, tolerance);
    e->flagged_count = flag_kept(e, s);
    if (e->flagged_count > 0 && e->kinks_known)
        s->kernels->correct_kinks(&e->source, &e->method, e->flagged_count, &e->flags, tolerance, &e->kinks);
}
