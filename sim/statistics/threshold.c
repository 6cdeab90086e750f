/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the magnetism at the threshold between delocalised waves and clean propagation, for sweeps. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "sim/base/elementary.h"
#include "sim/base/memory.h"
#include "sim/base/random.h"
#include "sim/statistics/statistics.h"

/* Magnetisms up to this belong to the plateau. */
static const double flat = 0.2;

/* exp(-rate (1 - M^2)) = plateau. */
static double find_law(const double *, const double *, size_t, const struct bead_threshold *t)
{
    double square = 1 + bead_log(t->plateau) / t->rate;
    return square >= 0 ? sqrt(square) : NAN;
}

/* The magnetism at which the means, followed down from M = 1, first fall to `level`, by linear interpolation. */
static double crossing(const double *magnetism, const double *mean, size_t count, double level)
{
    for (size_t i = count; i-- > 1;) {
        if (mean[i] >= level && mean[i - 1] < level)
            return magnetism[i - 1] + (magnetism[i] - magnetism[i - 1]) * (level - mean[i - 1]) / (mean[i] - mean[i - 1]);
    }
    return NAN;
}

static double find_half(const double *magnetism, const double *mean, size_t count, const struct bead_threshold *t)
{
    return crossing(magnetism, mean, count, (1 + t->plateau) / 2);
}

static double find_log_half(const double *magnetism, const double *mean, size_t count, const struct bead_threshold *t)
{
    return crossing(magnetism, mean, count, sqrt(t->plateau));
}

static double find_rise(const double *magnetism, const double *mean, size_t count, const struct bead_threshold *t)
{
    return crossing(magnetism, mean, count, 1.2 * t->plateau);
}

static const struct bead_threshold_info rows[] = {
    {"law", "where exp(-k (1 - M^2)), fitted at high M, meets the plateau: M_c^2 = 1 + ln(plateau) / k", find_law},
    {"half", "where the mean falls to the middle between 1 and the plateau, (1 + plateau) / 2", find_half},
    {"log-half", "where the mean falls to the geometric middle between 1 and the plateau, sqrt(plateau)", find_log_half},
    {"rise", "where the mean falls to 1.2 times the plateau", find_rise},
};

const struct bead_threshold_info *bead_threshold_info(size_t index)
{
    return index < sizeof rows / sizeof *rows ? &rows[index] : NULL;
}

const struct bead_threshold_info *bead_threshold_info_named(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    }
    return NULL;
}

/* Find both regimes in the means; false: one of them is missing. */
static bool find_regimes(const double *magnetism, const double *mean, size_t count, struct bead_threshold *t)
{
    double sum = 0, xx = 0, xy = 0;
    size_t low = 0;
    for (; low < count && magnetism[low] <= flat + 1e-9; low++)
        sum += mean[low];
    t->plateau = low > 0 ? sum / (double)low : NAN;
    t->low = t->high = NAN;
    if (!(t->plateau > 0))
        return false;
    /* From M = 1 down, so that random maxima at low M do not count. */
    for (size_t i = count; i-- > low && mean[i] >= sqrt(t->plateau);) {
        double x = 1 - magnetism[i] * magnetism[i], y = -bead_log(mean[i]);
        if (!(x > 1e-12))
            continue;
        t->high = isnan(t->high) ? magnetism[i] : t->high;
        t->low = magnetism[i];
        xx += x * x;
        xy += x * y;
    }
    t->rate = xx > 0 ? xy / xx : NAN;
    return t->rate > 0; /* of a plateau above 1, no mean leads down to it */
}

static double mean_of(const struct bead_group_results *group, uint64_t seed, uint64_t stream, uint64_t *drawn)
{
    double sum = 0;
    for (size_t i = 0; i < group->count; i++) {
        size_t from = drawn ? bead_draw_below(seed, stream, (*drawn)++, group->count) : i;
        sum += group->values[from];
    }
    return sum / (double)group->count;
}

/* Deviations of plateau, rate and threshold between bootstrap samples. */
struct spread {
    double sum[3], squares[3];
    size_t count[3];
};

static void note(struct spread *spread, const struct bead_threshold *t)
{
    const double values[3] = {t->plateau, t->rate, t->critical};
    for (size_t i = 0; i < 3; i++) {
        if (!isfinite(values[i]))
            continue;
        spread->sum[i] += values[i];
        spread->squares[i] += values[i] * values[i];
        spread->count[i]++;
    }
}

static double deviation(const struct spread *spread, size_t i)
{
    double n = (double)spread->count[i];
    return n > 1 ? sqrt(fmax(spread->squares[i] - spread->sum[i] * spread->sum[i] / n, 0) / (n - 1)) : NAN;
}

static void resample(const struct bead_group_results *groups, size_t count, const struct bead_threshold_info *how, size_t resamples,
                     uint64_t seed, const double *magnetism, double *mean, struct bead_threshold *found)
{
    struct spread spread = {{0}, {0}, {0}};
    for (size_t r = 0; r < resamples; r++) {
        struct bead_threshold t;
        uint64_t drawn = 0;
        for (size_t g = 0; g < count; g++)
            mean[g] = mean_of(&groups[g], seed, r, &drawn);
        if (!find_regimes(magnetism, mean, count, &t))
            continue;
        t.critical = how->find(magnetism, mean, count, &t);
        note(&spread, &t);
    }
    found->plateau_error = deviation(&spread, 0);
    found->rate_error = deviation(&spread, 1);
    found->critical_error = deviation(&spread, 2);
}

enum bead_error bead_threshold_fit(const struct bead_group_results *groups, size_t count, const struct bead_threshold_info *how,
                                   size_t resamples, uint64_t seed, struct bead_threshold *t, struct bead_message *msg)
{
    *t = (struct bead_threshold){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    BEAD_FREED double *magnetism;
    BEAD_TRY(bead_new(&magnetism, 2 * count, msg, "a threshold"));
    double *mean = magnetism + count;
    for (size_t g = 0; g < count; g++) {
        magnetism[g] = groups[g].magnetism;
        mean[g] = mean_of(&groups[g], 0, 0, NULL);
        if (groups[g].count == 0 || !(mean[g] > 0) || (g > 0 && !(magnetism[g] > magnetism[g - 1])))
            return bead_fail(msg, BEAD_ERROR_NUMBERS, "no threshold: group %zu has no positive mean or is out of order", g);
    }
    if (!find_regimes(magnetism, mean, count, t))
        return bead_fail(msg, BEAD_ERROR_NUMBERS,
                         "no threshold: it needs magnetisms up to 0.2, for the plateau, and some near 1 with higher forces");
    t->critical = how->find(magnetism, mean, count, t);
    resample(groups, count, how, resamples, seed, magnetism, mean, t);
    return BEAD_OK;
}

/* The means of a threshold, and room to change them. */
struct moving {
    const struct bead_threshold_info *how;
    const double *magnetism, *mean;
    double *moved;
    size_t count;
};

/* M_c if means from..to - 1 are larger by `part` of themselves. */
static double critical_if(const struct moving *m, size_t from, size_t to, double part)
{
    struct bead_threshold t;
    memcpy(m->moved, m->mean, m->count * sizeof *m->moved);
    for (size_t g = from; g < to; g++)
        m->moved[g] *= 1 + part;
    return find_regimes(m->magnetism, m->moved, m->count, &t) ? m->how->find(m->magnetism, m->moved, m->count, &t) : NAN;
}

/* How far these means move M_c if they are off by `part`, either way. */
static double shift_by(const struct moving *m, size_t from, size_t to, double part)
{
    const double here = critical_if(m, 0, 0, 0), up = fabs(critical_if(m, from, to, part) - here),
                 down = fabs(critical_if(m, from, to, -part) - here);
    return up > down || isnan(up) ? up : down;
}

enum bead_error bead_threshold_uncertainty(const struct bead_group_results *groups, size_t count,
                                           const struct bead_threshold_info *how, double part, double common, double *uncertainty,
                                           struct bead_message *msg)
{
    BEAD_FREED double *memory;
    BEAD_TRY(bead_new(&memory, 3 * count, msg, "a threshold"));
    double *magnetism = memory, *mean = memory + count;
    const struct moving m = {how, magnetism, mean, memory + 2 * count, count};
    for (size_t g = 0; g < count; g++) {
        magnetism[g] = groups[g].magnetism;
        mean[g] = mean_of(&groups[g], 0, 0, NULL);
    }
    *uncertainty = shift_by(&m, 0, count, common);
    for (size_t g = 0; g < count; g++)
        *uncertainty += shift_by(&m, g, g + 1, part);
    return BEAD_OK;
}
