/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: finds the contacts that open or close, see events.h. Lanes are contacts. */
#include <math.h>

#include "sim/integrate/events_patch.h"

/* Compressions at both ends of the step, and their rates times its length. */
struct event_ends {
    lanes d0, r0, d1, r1;
};

/* Finds and keeps those of contacts k, k + 1, ... */
static inline struct event_ends keep_ends(const struct bead_patch_source *s, const struct bead_event_flags *flags, size_t k)
{
    const lanes d = load_lanes(s->static_compression + k);
    const struct event_ends e = {
        d + (load_lanes(s->u0 + k) - load_lanes(s->u0 + k + 1)), s->h * (load_lanes(s->v0 + k) - load_lanes(s->v0 + k + 1)),
        d + (load_lanes(s->u1 + k) - load_lanes(s->u1 + k + 1)), s->h * (load_lanes(s->v1 + k) - load_lanes(s->v1 + k + 1))};
    store_lanes(flags->d0 + k, e.d0);
    store_lanes(flags->r0 + k, e.r0);
    store_lanes(flags->d1 + k, e.d1);
    store_lanes(flags->r1 + k, e.r1);
    return e;
}

/* Keeps the ends of contacts 0..n. Lists those before n that may have a branch point in the step or within limits->reach steps
 * outside, because the faster rate could reach it and is not too slow to matter. Contacts at rest that just touch, d = r = 0, have
 * none. Returns their number. */
static size_t list_near(size_t n, const struct bead_patch_source *source, const struct bead_event_limits *limits,
                        const struct bead_event_flags *flags)
{
    /* If a compression dips to zero within the step, it is less than half its rate at both ends. */
    const double near = limits->reach > 0.5 ? limits->reach : 0.5;
    const lanes slow = (lanes){0} + limits->slow;
    const struct bead_patch_source here = *source;
    const struct bead_event_flags kept = *flags;
    size_t count = 0, k = 0;
    for (; k < n; k += LANES) {
        const struct event_ends e = keep_ends(&here, &kept, k);
        const lanes rate = larger_lanes(magnitude(e.r0), magnitude(e.r1));
        const unsigned close = less_bits(smaller_lanes(e.d0, e.d1), near * rate) & less_bits(-rate, larger_lanes(e.d0, e.d1));
        count += pack_numbers(close & less_bits(slow, rate), k, kept.contact + count);
    }
    keep_ends(&here, &kept, k);
    return count;
}

static inline lanes force_power(const struct bead_patch_rule *rule, lanes r)
{
    if (__builtin_expect(rule->hertz, 1))
        return r * ROOT_OF(r);
    for (size_t i = 0; i < LANES; i++)
        r[i] = pow(r[i], rule->exponent);
    return r;
}

/* Error of a velocity, in units of A h/m, from the branch point outside to which compression d and rate r, away from zero, point.
 */
static inline lanes loss_outside(const struct bead_event_limits *limits, lanes d, lanes r)
{
    const lanes zero = {0};
    const lane_masks counts = (r > 0) & (d < limits->reach * r);
    if (!any_lane(counts))
        return zero;
    r = choose(counts, r, zero + 1);
    const lanes x = choose(counts, d / r, zero), near = 1 + x * (1 / limits->decay), far = (1 + 0.5 * x) * (1 + 0.5 * x);
    return choose(counts, force_power(limits->rule, r) * (limits->outside / (near * near * near * far * far)), zero);
}

/* Largest effect of LANES listed contacts on a velocity, m/s. */
static inline lanes weigh_events(const struct bead_event_flags *flags, const struct bead_event_limits *limits, double h,
                                 const size_t *contact)
{
    const lanes zero = {0}, a = gather_lanes(flags->d0, contact), b = gather_lanes(flags->d1, contact);
    const lanes p = gather_lanes(flags->r0, contact), q = gather_lanes(flags->r1, contact);
    const lane_masks a_closed = a > 0, b_closed = b > 0, closed = a_closed & b_closed, dips = (p < 0) & (q > 0);
    const double dip = limits->reach > 0.5 ? limits->reach : 0.5;
    const lane_masks inside = (a_closed ^ b_closed) | (closed & dips & ((a < -dip * p) | (b < dip * q))) |
                              (~(a_closed | b_closed) & (p > 0) & (q < 0) & (a + p > 0) & (b - q > 0));
    const lanes unit = h * gather_lanes(limits->hardness, contact);
    const lanes most = force_power(limits->rule, larger_lanes(magnitude(p), magnitude(q))) * unit;
    const lanes effect = choose(inside, BEAD_EFFECT_INSIDE * most, zero);
    const lane_masks outside = closed & ~dips & (limits->outside * most > limits->tolerance);
    if (!any_lane(outside))
        return effect;
    return choose(outside, larger_lanes(loss_outside(limits, a, p), loss_outside(limits, b, -q)) * unit, effect);
}

static size_t flag_events(size_t n, const struct bead_patch_source *source, const struct bead_event_limits *limits,
                          struct bead_event_flags *flags)
{
    const lanes tolerance = (lanes){0} + limits->tolerance;
    size_t *contact = flags->contact, near = list_near(n, source, limits, flags), count = 0;
    for (size_t i = 0; i < LANES; i++)
        contact[near + i] = 0; /* fills the last vector */
    for (size_t i = 0; i < near; i += LANES) {
        const lanes effect = weigh_events(flags, limits, source->h, contact + i);
        const unsigned real = near - i < LANES ? (1u << (near - i)) - 1 : ~0u;
        double some[LANES];
        store_lanes(some, effect);
        for (unsigned left = less_bits(tolerance, effect) & real; left; left &= left - 1) {
            const size_t j = (size_t)__builtin_ctz(left);
            contact[count] = contact[i + j];
            flags->effect[count++] = some[j];
        }
    }
    return count;
}

/* A rate counts once it falls: the final rate of a contact that the front is just reaching is still unknown. Rates that have grown
 * by less than `much` keep their weight. */
static bool weigh_speeds(size_t n, const double *v, const struct bead_event_speeds *speeds)
{
    const struct bead_event_speeds s = *speeds;
    const double much = 1.25;
    const lanes unit = (lanes){0} + s.unit, least = (lanes){0} + s.least, one = (lanes){0} + 1;
    bool any = false;
    for (size_t k = 0; k < n; k += LANES) {
        const lanes rate = magnitude(load_lanes(v + k) - load_lanes(v + k + 1)), most = load_lanes(s.most + k);
        const lanes known = load_lanes(s.known + k);
        const lane_masks rising = rate > most, fresh = ~rising & (most > much * known) & (most > least);
        if (any_lane(rising))
            store_lanes(s.most + k, larger_lanes(rate, most));
        if (!any_lane(fresh))
            continue;
        any = true;
        const lanes weight = larger_lanes(unit / choose(fresh, most, one), one);
        store_lanes(s.known + k, choose(fresh, most, known));
        store_lanes(s.weighed + k, choose(fresh, load_lanes(s.hardness + k) * weight, load_lanes(s.weighed + k)));
    }
    return any;
}
