/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits the decay of a wave along a chain, first exponential, then a power law, with bootstrap errors. For sweeps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/random.h"
#include "sim/statistics/statistics.h"

/* The power law needs at least three doublings of the distance: over the first, one law changes into the other. */
enum { FARTHER = 8, POINTS = 3 };

size_t bead_decay_reach(const double *logs, size_t places, size_t first, size_t cell)
{
    for (size_t p = first; p + cell <= places; p++) {
        double mean = 0;
        for (size_t k = 0; k < cell; k++)
            mean += logs[p + k] / (double)cell;
        if (mean <= -1)
            return p;
    }
    return places > 0 ? places - 1 : 0;
}

/* Running sums of x and y, relative to the first point. */
struct sums {
    double x0, x, y, xx, xy;
    size_t count;
};

static void add_point(struct sums *s, double x, double y)
{
    if (!isfinite(x) || !isfinite(y))
        return;
    if (s->count++ == 0)
        s->x0 = x;
    x -= s->x0;
    s->x += x;
    s->y += y;
    s->xx += x * x;
    s->xy += x * y;
}

static double slope_of(const struct sums *s, double *offset)
{
    const double n = (double)s->count, spread = s->xx - s->x * s->x / n;
    if (s->count < POINTS || !(spread > 0))
        return NAN;
    const double slope = (s->xy - s->x * s->y / n) / spread;
    *offset = (s->y - slope * s->x) / n - slope * s->x0;
    return slope;
}

void bead_decay_fit(const double *logs, size_t places, size_t first, size_t last, struct bead_decay *decay)
{
    struct sums near = {0}, far = {0};
    *decay = (struct bead_decay){NAN, NAN, NAN, NAN, NAN, NAN, NAN, first, last};
    for (size_t p = first; p <= last && p < places; p++)
        add_point(&near, (double)p, logs[p]);
    for (size_t p = last > 0 ? last : 1; p < places && places > FARTHER * last; p++)
        add_point(&far, bead_log((double)p), logs[p]);
    decay->rate = -slope_of(&near, &decay->length_offset);
    if (!isnan(decay->rate))
        decay->length = decay->rate > 0 ? 1 / decay->rate : INFINITY;
    decay->exponent = slope_of(&far, &decay->exponent_offset);
}

/* ---- many configurations ---- */

/* Means over the drawn rows, place by place. */
static void find_means(const struct bead_decay_profiles *profiles, const double *logs, const size_t *drawn, double *mean)
{
    memset(mean, 0, profiles->places * sizeof *mean);
    for (size_t i = 0; i < profiles->rows; i++) {
        const double *row = logs + drawn[i] * profiles->places;
        for (size_t p = 0; p < profiles->places; p++)
            mean[p] += row[p];
    }
    for (size_t p = 0; p < profiles->places; p++)
        mean[p] /= (double)profiles->rows;
}

static void fit_both(const struct bead_decay_profiles *profiles, const size_t *drawn, double *mean, struct bead_decay decay[2])
{
    find_means(profiles, profiles->force, drawn, mean);
    size_t last = bead_decay_reach(mean, profiles->places, profiles->first, profiles->cell);
    bead_decay_fit(mean, profiles->places, profiles->first, last, &decay[0]);
    find_means(profiles, profiles->energy, drawn, mean);
    bead_decay_fit(mean, profiles->places, profiles->first, last, &decay[1]);
}

/* Standard deviation of values added one by one (Welford). */
struct spread {
    double mean, squares;
    size_t count;
};

static void add_value(struct spread *s, double value)
{
    if (!isfinite(value))
        return;
    double off = value - s->mean;
    s->mean += off / (double)++s->count;
    s->squares += off * (value - s->mean);
}

static double deviation_of(const struct spread *s)
{
    return s->count > 1 ? sqrt(s->squares / (double)(s->count - 1)) : NAN;
}

/* Errors of lengths come from the spread of rates, 1 / length, as a length may be infinite. */
static void find_errors(const struct bead_decay_profiles *profiles, size_t resamples, uint64_t seed, size_t *drawn, double *mean,
                        struct bead_decay decay[2])
{
    struct spread rate[2] = {{0}}, exponent[2] = {{0}};
    for (size_t r = 0; r < resamples; r++) {
        struct bead_decay again[2];
        for (size_t i = 0; i < profiles->rows; i++)
            drawn[i] = bead_draw_below(seed, r, i, profiles->rows);
        fit_both(profiles, drawn, mean, again);
        for (size_t k = 0; k < 2; k++) {
            add_value(&rate[k], 1 / again[k].length);
            add_value(&exponent[k], again[k].exponent);
        }
    }
    for (size_t k = 0; k < 2; k++) {
        if (isfinite(decay[k].length))
            decay[k].length_error = deviation_of(&rate[k]) * decay[k].length * decay[k].length;
        if (!isnan(decay[k].exponent))
            decay[k].exponent_error = deviation_of(&exponent[k]);
    }
}

enum bead_error bead_decay_of(const struct bead_decay_profiles *profiles, size_t resamples, uint64_t seed,
                              struct bead_decay *of_force, struct bead_decay *of_energy, struct bead_message *msg)
{
    struct bead_decay decay[2];
    BEAD_FREED size_t *drawn = NULL;
    BEAD_FREED double *mean = NULL;
    BEAD_TRY(bead_new(&drawn, profiles->rows, msg, "decay lengths"));
    BEAD_TRY(bead_new(&mean, profiles->places, msg, "decay lengths"));
    for (size_t i = 0; i < profiles->rows; i++)
        drawn[i] = i;
    fit_both(profiles, drawn, mean, decay);
    if (profiles->rows > 1)
        find_errors(profiles, resamples, seed, drawn, mean, decay);
    *of_force = decay[0];
    *of_energy = decay[1];
    return BEAD_OK;
}
