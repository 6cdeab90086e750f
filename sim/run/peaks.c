/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the largest force of every contact or bead during a run: see peaks.h. */
#include "sim/run/peaks.h"

#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/events.h"
#include "sim/run/force_curve.h"

/* Maxima this close to the best so far, relatively, are refined. */
static const double close_call = 1e-3;

/* Vectors extend beyond the last bead. */
enum { PADDING = 16 };
/* Allowance for rounding in `least`, relative. */
static const double least_part = 1e-9;

struct bead_peaks {
    const struct bead_chain *chain;
    bool of_beads;
    size_t first, count; /* first..count-1 are searched */
    struct bead_peak *best;
    struct bead_peak *rival;  /* [beads]: the last other maximum; time NaN: none. NULL: not asked */
    struct bead_peak *second; /* [beads]: the second highest; the same */
    double apart;             /* s: maxima of `best` and `second` that are closer are one */
    unsigned char *mark;      /* [beads]: has a maximum in this step */
    unsigned char *high;      /* [beads]: contacts that may be compressed beyond `least` in this step; NULL: not needed */
    bool *late;               /* [beads]: was still rising at the limit */
    double *least;            /* [beads]: compressions beyond the static one, m, required for a higher maximum */
};

/* The static force, at time 0; time NaN if there is none. */
static struct bead_peak static_peak(const struct bead_chain *chain, bool of_beads, size_t i)
{
    const double *still = chain->static_force, here = i < chain->contacts ? still[i] : 0;
    const double force = of_beads ? 0.5 * ((i > 0 ? still[i - 1] : 0) + here) : here;
    return (struct bead_peak){.value = force, .time = force > 0 ? 0 : NAN};
}

/* A maximum lower than this part of the highest is no rival. */
static const double rivalry = 0.5;
/* Nor is it a second one, if the wave of both, the force beyond the static one, is not at least this part: it is the wave that
 * errors of the run make lower. */
static const double second_part = 0.9;

static double second_bar(const struct bead_peaks *p, size_t i)
{
    const double still = static_peak(p->chain, p->of_beads, i).value;
    return still + second_part * (p->best[i].value - still);
}

/* Maxima of lower forces do not matter. */
static double interest(const struct bead_peaks *p, size_t i)
{
    const double best = p->best[i].value, second = p->second ? fmax(second_bar(p, i), p->second[i].value) : best;
    return p->rival ? fmin(rivalry * best, second) : second;
}

/* A lower bound of the compression of contact k beyond the static one, m, at a higher maximum. A bead has a higher force only if
 * one of its contacts does. */
static double least_of(const struct bead_peaks *p, const struct bead_chain *chain, size_t k)
{
    const double here = interest(p, k), best = p->of_beads && k + 1 < chain->beads ? fmin(here, interest(p, k + 1)) : here;
    return chain->law->compression(chain->stiffness[k], &chain->spec->law, best) * (1 - least_part) - chain->static_compression[k];
}

enum bead_error bead_peaks_create(const struct bead_stepper *stepper, bool of_beads, struct bead_span span,
                                  struct bead_peaks **peaks, struct bead_message *msg)
{
    size_t beads = stepper->beads;
    struct bead_peaks *p = *peaks = calloc(1, sizeof *p);
    if (p) {
        p->chain = stepper->chain;
        p->of_beads = of_beads;
        p->count = of_beads ? beads : stepper->chain->contacts;
        p->first = span.first < p->count ? span.first : p->count;
        p->count = span.last < p->count ? span.last + 1 : p->count;
        p->best = calloc(beads, sizeof *p->best);
        p->mark = calloc(beads + PADDING, 1);
        p->high = of_beads ? calloc(beads + PADDING, 1) : NULL;
        p->late = calloc(beads, sizeof *p->late);
        p->least = calloc(beads + PADDING, sizeof(double));
    }
    if (!p || !p->best || !p->mark || (of_beads && !p->high) || !p->late || !p->least) {
        bead_peaks_destroy(p);
        *peaks = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the peaks of %zu beads", beads);
    }
    const struct bead_chain *c = stepper->chain;
    for (size_t i = 0; i < beads; i++)
        p->best[i] = static_peak(c, of_beads, i);
    for (size_t k = 0; k < c->contacts; k++)
        p->least[k] = c->law->one_sided ? least_of(p, c, k) : -INFINITY;
    return BEAD_OK;
}

void bead_peaks_destroy(struct bead_peaks *peaks)
{
    if (!peaks)
        return;
    free(peaks->best);
    free(peaks->rival);
    free(peaks->second);
    free(peaks->mark);
    free(peaks->high);
    free(peaks->late);
    free(peaks->least);
    free(peaks);
}

const struct bead_peak *bead_peaks_found(const struct bead_peaks *peaks)
{
    return peaks->best;
}

/* Keeps another maximum of each. */
static enum bead_error keep_others(struct bead_peaks *p, const struct bead_stepper *stepper, struct bead_peak **others,
                                   struct bead_message *msg)
{
    const struct bead_chain *c = stepper->chain;
    BEAD_TRY(bead_new(others, stepper->beads, msg, "the peaks of %zu beads", stepper->beads));
    for (size_t i = 0; i < stepper->beads; i++)
        (*others)[i].time = NAN;
    for (size_t k = 0; k < c->contacts && c->law->one_sided; k++)
        p->least[k] = least_of(p, c, k);
    return BEAD_OK;
}

enum bead_error bead_peaks_keep_rivals(struct bead_peaks *p, const struct bead_stepper *stepper, struct bead_message *msg)
{
    return keep_others(p, stepper, &p->rival, msg);
}

enum bead_error bead_peaks_keep_second(struct bead_peaks *p, const struct bead_stepper *stepper, double apart,
                                       struct bead_message *msg)
{
    p->apart = apart;
    return keep_others(p, stepper, &p->second, msg);
}

const struct bead_peak *bead_peaks_rivals(const struct bead_peaks *peaks)
{
    return peaks->rival;
}

const struct bead_peak *bead_peaks_second(const struct bead_peaks *peaks)
{
    return peaks->second;
}

/* A maximum within the step. */
struct maximum {
    double x, value;
};

/* If contacts nearby open or close within the step, d'' has kinks that the septic smooths out: takes compressions and their rates
 * at x from the forces themselves, then the vertex of the parabola through them. */
static void sharpen(const struct bead_stepper *s, const struct bead_force_curve *curve, struct maximum *most)
{
    const double near = 1e-3, x = most->x,
                 bend = (bead_force_curve_rate(curve, x + near) - bead_force_curve_rate(curve, x - near)) / (2 * near);
    double force = 0, rate = 0, d[2];
    bool exact = false;
    if (!(bend < 0))
        return;
    for (size_t i = 0; i < curve->count; i++) {
        const size_t k = curve->contact[i];
        const double a = s->chain->stiffness[k];
        const struct bead_law_spec *spec = &s->chain->spec->law;
        if (bead_events_compression(s->events, s, k, x, d)) {
            exact = true;
        } else {
            d[0] = bead_polynomial_value(&curve->compression[i], x);
            d[1] = bead_polynomial_slope(&curve->compression[i], x);
        }
        double stiffness = s->chain->law->stiffness(a, spec, d[0]);
        if (curve->count == 1)
            d[0] -= 0.5 * d[1] * d[1] / bend;
        rate += (curve->count > 1 ? stiffness : 1) * d[1];
        force += s->chain->law->force(a, spec, d[0]);
    }
    if (curve->count > 1)
        force -= 0.5 * rate * rate / bend;
    if (!exact)
        return;
    *most = (struct maximum){fmin(fmax(x - rate / bend, 0), 1), curve->part * force};
}

/* An upper bound of the compression of contact k within the step, m, beyond the static one: no compression exceeds both ends by
 * more than its fastest rate allows. One that rises at the start, falls at the end and is concave at both lies below its tangents
 * there, if it is concave in between as well: assumed of steps that are a part of the shortest period (test_peaks tries it). */
static double compression_bound(const struct bead_state *start, const struct bead_state *end, double h, size_t k)
{
    const double d0 = start->u[k] - start->u[k + 1], d1 = end->u[k] - end->u[k + 1], rate0 = start->v[k] - start->v[k + 1],
                 rate1 = end->v[k] - end->v[k + 1], bound = fmax(d0, d1) + h * fmax(fabs(rate0), fabs(rate1));
    const bool turns = rate0 > 0 && rate1 < 0 && start->a[k] < start->a[k + 1] && end->a[k] < end->a[k + 1];
    return turns ? fmin(bound, d0 + rate0 * (d1 - d0 - rate1 * h) / (rate0 - rate1)) : bound;
}

/* An upper bound of the force within the step. Rules out nearly all maxima behind the front. */
static double force_bound(const struct bead_peaks *p, const struct bead_stepper *s, size_t index)
{
    const struct bead_chain *c = s->chain;
    double force = 0;
    for (size_t k = p->of_beads && index > 0 ? index - 1 : index; k <= index && k < c->contacts; k++)
        force += c->law->force(c->stiffness[k], &c->spec->law,
                               c->static_compression[k] + compression_bound(&s->start, &s->end, s->h, k));
    return p->of_beads ? 0.5 * force : force;
}

/* Keeps the highest maximum, and others if requested. An open one is the flank of a later maximum. */
static void keep(struct bead_peaks *p, size_t index, struct bead_peak found)
{
    const struct bead_peak before = p->best[index];
    const bool is_best = found.value > before.value, is_other = !is_best || (before.time > 0 && !before.open);
    const struct bead_peak lower = is_best ? before : found;
    struct bead_peak *second = p->second ? &p->second[index] : NULL;
    if (is_best)
        p->best[index] = found;
    if (p->rival && is_other)
        p->rival[index] = lower;
    if (second && is_other && found.time - before.time > p->apart && lower.value > second->value)
        *second = lower;
    if (second && second->value < second_bar(p, index))
        second->time = NAN;
}

/* The maximum within a part of the step at whose start the force rises and at whose end it falls, if it comes before the limit and
 * is higher than `least`; else returns false. */
static bool maximum_in_part(const struct bead_stepper *s, const struct bead_curve_part *part, double rate0, double rate1,
                            double least, double limit, struct bead_peak *found)
{
    const double x = bead_curve_part_turn(part, rate0, rate1);
    struct maximum most = {x, bead_force_curve_value(part->curve, x)};
    if (s->events && x > 0 && most.value > least * (1 - close_call))
        sharpen(s, part->curve, &most);
    *found = (struct bead_peak){.value = most.value, .time = s->t0 + most.x * s->h};
    return found->time <= limit && found->value > least;
}

/* Keeps that maximum. */
static void keep_maximum(struct bead_peaks *p, const struct bead_stepper *s, size_t index, struct bead_peak found)
{
    keep(p, index, found);
    for (size_t k = p->of_beads && index > 0 ? index - 1 : index; k <= index && k < s->chain->contacts; k++)
        p->least[k] = least_of(p, s->chain, k);
}

/* With damping, the force may be largest at the moment when the contact closes. */
static void find_jump(struct bead_peaks *p, const struct bead_stepper *s, size_t index, const struct bead_force_curve *curve,
                      double limit)
{
    double value = bead_force_curve_value(curve, 0);
    if (s->t0 <= limit && value > p->best[index].value && bead_force_curve_rate(curve, 0) <= 0)
        keep(p, index, (struct bead_peak){.value = value, .time = s->t0});
}

/* Is the peak so far that of a contact which closed with damping as the step began? The pulse may be higher than its first jump. */
static bool has_jumped(const struct bead_peaks *p, const struct bead_stepper *s, size_t index)
{
    return bead_stepper_damped(s) && p->best[index].time == s->t0;
}

/* Finds the maxima of a curve within the step: of a bead, whose force is the sum of two contacts, there may be more than one. Keeps
 * them, or returns true at the first one that is higher than the peak. */
static bool find_maxima(struct bead_peaks *p, const struct bead_stepper *s, size_t index, const struct bead_force_curve *curve,
                        double limit, bool keeps)
{
    double rate0 = bead_force_curve_rate(curve, 0), end = bead_force_curve_rate(curve, 1);
    const int parts = rate0 > 0 && end <= 0 && !p->of_beads ? 1 : BEAD_CURVE_PARTS;
    for (int i = 1; i <= parts; i++) {
        struct bead_curve_part part = {curve, (i - 1) / (double)parts, 1.0 / parts};
        struct bead_peak found;
        double rate1 = i == parts ? end : bead_force_curve_rate(curve, part.from + part.length);
        const double least = keeps ? interest(p, index) : p->best[index].value;
        if (rate0 > 0 && rate1 <= 0 && maximum_in_part(s, &part, rate0, rate1, least, limit, &found)) {
            if (!keeps)
                return true;
            keep_maximum(p, s, index, found);
        }
        rate0 = rate1;
    }
    return false;
}

static void find_peak(struct bead_peaks *p, const struct bead_stepper *s, size_t index, double limit)
{
    if (!bead_stepper_damped(s) && force_bound(p, s, index) < interest(p, index))
        return;
    struct bead_force_curve curve = bead_force_curve_of(s, index, p->of_beads);
    if (bead_stepper_damped(s))
        find_jump(p, s, index, &curve, limit);
    find_maxima(p, s, index, &curve, limit, true);
}

/* A force still rising at the limit, and higher than any maximum before: the peak is its value at the limit, marked as open. */
static void find_open(struct bead_peaks *p, const struct bead_stepper *s, size_t index, double limit)
{
    const struct bead_peak *best = &p->best[index];
    if (!bead_stepper_damped(s) && force_bound(p, s, index) < best->value)
        return;
    struct bead_force_curve curve = bead_force_curve_of(s, index, p->of_beads);
    double x = (limit - s->t0) / s->h, value = bead_force_curve_value(&curve, x);
    if (bead_force_curve_rate(&curve, x) > 0 && value > best->value)
        keep(p, index, (struct bead_peak){.value = value, .time = limit, .open = true});
}

/* Marks the contacts that belong to beads or contacts first..n-1. */
static bool mark_contacts(struct bead_peaks *p, const struct bead_stepper *s, size_t n)
{
    const struct bead_state *start = &s->start, *end = &s->end;
    const size_t k = p->of_beads && p->first > 0 ? p->first - 1 : p->first, contacts = s->chain->contacts;
    const struct bead_step_ends ends = {start->u + k, start->v + k, start->a + k, end->u + k, end->v + k, end->a + k, s->h};
    return s->kernels->turns((n < contacts ? n : contacts) - k, &ends, p->least + k, p->mark + k, p->high ? p->high + k : NULL);
}

/* The rate of a bead's force in a state, N/s, and the mean magnitude of the rates of its contacts. */
struct bead_slope {
    double rate, swing;
};

static struct bead_slope slope_of(const struct bead_stepper *s, const struct bead_state *state, size_t j)
{
    const double before = j > 0 ? bead_dense_force_rate(s, state, j - 1) : 0, here = bead_dense_force_rate(s, state, j);
    return (struct bead_slope){0.5 * (before + here), 0.5 * (fabs(before) + fabs(here))};
}

/* Second time derivative of the force of bead j, N/s^2. */
static double bead_bend(const struct bead_stepper *s, const struct bead_state *state, size_t j)
{
    const double near = 1e-4;
    double bend = 0;
    for (size_t k = j > 0 ? j - 1 : 0; k <= j && k < s->chain->contacts; k++) {
        const double a = s->chain->stiffness[k], rate = state->v[k] - state->v[k + 1];
        const double d = bead_stepper_compression(s, state, k), change = near * fabs(d);
        double (*stiffness)(double, const struct bead_law_spec *, double) = s->chain->law->stiffness;
        bend += stiffness(a, s->table.law, d) * (state->a[k] - state->a[k + 1]);
        if (change > 0)
            bend +=
                (stiffness(a, s->table.law, d + change) - stiffness(a, s->table.law, d - change)) / (2 * change) * (rate * rate);
    }
    return 0.5 * bend;
}

/* A bead's force changes little while one contact force rises as the other falls: it may reach a new maximum within the step
 * although it falls (or rises) at both ends. It then bends enough in the other direction at one of them. */
static bool may_swing(const struct bead_peaks *p, const struct bead_stepper *s, size_t j, struct bead_slope at0,
                      struct bead_slope at1)
{
    const double most = s->h * (at0.swing > at1.swing ? at0.swing : at1.swing), best = interest(p, j);
    if (!(bead_stepper_bead_force(s, &s->start, j) + bead_stepper_bead_force(s, &s->end, j) + most >
          2 * best)) /* up and down at the fastest rate */
        return false;
    const double sign = at0.rate > 0 ? 1 : -1, half = 0.5 * sign * s->h;
    return sign * at0.rate < -half * bead_bend(s, &s->start, j) || sign * at1.rate < half * bead_bend(s, &s->end, j);
}

/* A bead's force may turn if its rate changes sign, if one of its contact forces turns, or if they change in opposite directions.
 */
static bool may_turn(const struct bead_peaks *p, const struct bead_stepper *s, size_t j, bool contact_turns)
{
    if (force_bound(p, s, j) < interest(p, j))
        return false;
    const struct bead_slope at0 = slope_of(s, &s->start, j), at1 = slope_of(s, &s->end, j);
    if (contact_turns || (at0.rate > 0 && at1.rate <= 0))
        return true;
    /* If neither contact force turns and both rise, or both fall, so does their sum. */
    const bool alike = at0.swing == fabs(at0.rate) && at1.swing == fabs(at1.rate) && (at0.rate > 0) == (at1.rate > 0);
    return !alike && may_swing(p, s, j, at0, at1);
}

static bool mark_beads(struct bead_peaks *p, const struct bead_stepper *s, size_t n)
{
    const size_t contacts = s->chain->contacts;
    bool any = false;
    if (!mark_contacts(p, s, n))
        return false;
    unsigned char turns = p->first > 0 ? p->mark[p->first - 1] : 0, high = p->first > 0 ? p->high[p->first - 1] : 0;
    for (size_t j = p->first; j < n; j++) {
        const unsigned char turns_here = j < contacts ? p->mark[j] : 0, high_here = j < contacts ? p->high[j] : 0;
        p->mark[j] = (high | high_here) && may_turn(p, s, j, turns | turns_here);
        any = any || p->mark[j];
        turns = turns_here;
        high = high_here;
    }
    return any;
}

/* Follows the forces that were still rising at the limit to the end of their first pulse. */
static void follow_late(struct bead_peaks *p, const struct bead_stepper *s, size_t n, double over)
{
    for (size_t i = p->first; s->t0 <= over && i < n; i++) {
        if (!p->late[i])
            continue;
        find_peak(p, s, i, over);
        if (p->best[i].open && over <= s->t1)
            find_open(p, s, i, over);
    }
}

/* Marks the forces that may have maxima within the step. */
static bool mark_all(struct bead_peaks *p, const struct bead_stepper *s, size_t n)
{
    if (bead_stepper_damped(s))
        memset(p->mark, 1, n);
    return bead_stepper_damped(s) || (p->of_beads ? mark_beads(p, s, n) : mark_contacts(p, s, n));
}

/* Is a force higher than its peak within the step? */
static bool is_higher(struct bead_peaks *p, const struct bead_stepper *s, size_t index, double over)
{
    if (!bead_stepper_damped(s) && force_bound(p, s, index) <= p->best[index].value)
        return false;
    const struct bead_force_curve curve = bead_force_curve_of(s, index, p->of_beads);
    return find_maxima(p, s, index, &curve, over, false);
}

/* The force at the end of the step, or of the run if that comes before. */
static double last_force(const struct bead_peaks *p, const struct bead_stepper *s, size_t index, double over)
{
    if (over >= s->t1)
        return p->of_beads ? bead_stepper_bead_force(s, &s->end, index) : s->end.f[index] + s->chain->static_force[index];
    const struct bead_force_curve curve = bead_force_curve_of(s, index, p->of_beads);
    return bead_force_curve_value(&curve, (over - s->t0) / s->h);
}

/* Marks the peaks that forces of the step exceed, at its end or within it, long after the first pulse. */
static void find_exceeded(struct bead_peaks *p, const struct bead_stepper *s, size_t n, double over)
{
    const bool any = mark_all(p, s, n);
    for (size_t i = p->first; i < n; i++) {
        struct bead_peak *best = &p->best[i];
        if (best->open || best->exceeded)
            continue;
        best->exceeded = last_force(p, s, i, over) > best->value || (any && p->mark[i] && is_higher(p, s, i, over));
    }
}

void bead_peaks_step(struct bead_peaks *p, const struct bead_stepper *s, double limit, double over)
{
    size_t n = s->active < p->count ? s->active : p->count;
    p->first = s->first > p->first ? s->first : p->first; /* the others have been dropped */
    if (n <= p->first)
        return;
    if (s->t0 > limit) {
        follow_late(p, s, n, over);
        if (s->t0 <= over)
            find_exceeded(p, s, n, over);
        return;
    }
    const bool any = mark_all(p, s, n);
    const unsigned char *mark = p->mark + p->first, *end = p->mark + n;
    for (; any && (mark = memchr(mark, 1, (size_t)(end - mark))); mark++)
        find_peak(p, s, (size_t)(mark - p->mark), limit);
    for (size_t i = p->first; limit <= s->t1 && i < n; i++) {
        find_open(p, s, i, limit);
        p->late[i] = p->best[i].open || has_jumped(p, s, i);
    }
    if (limit < over) {
        follow_late(p, s, n, over);
        if (limit < s->t1)
            find_exceeded(p, s, n, over);
    }
}
