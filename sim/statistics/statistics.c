/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics for sweeps and measures: summaries of samples, least-squares lines, participation. */
#include "sim/statistics/statistics.h"

#include <math.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double quantile(const double *sorted, size_t count, double part)
{
    double place = part * (double)(count - 1);
    size_t below = (size_t)place;
    double rest = place - (double)below;
    return below + 1 < count ? sorted[below] + rest * (sorted[below + 1] - sorted[below]) : sorted[count - 1];
}

void bead_summary_of(double *values, size_t count, struct bead_summary *s)
{
    *s = (struct bead_summary){count, NAN, NAN, NAN, NAN, NAN, NAN, {NAN, NAN}};
    if (count == 0)
        return;
    qsort(values, count, sizeof *values, by_value);
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    s->mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += (values[i] - s->mean) * (values[i] - s->mean);
    if (count > 1) {
        s->deviation = sqrt(squares / (double)(count - 1));
        s->standard_error = s->deviation / sqrt((double)count);
    }
    s->low = values[0];
    s->high = values[count - 1];
    s->median = quantile(values, count, 0.5);
    s->quartile[0] = quantile(values, count, 0.25);
    s->quartile[1] = quantile(values, count, 0.75);
}

/* The summary of the values, each moved by `sign` times its own `off`. */
static struct bead_summary summary_moved(const double *values, const double *off, double sign, size_t count, double *room)
{
    struct bead_summary moved;
    for (size_t i = 0; i < count; i++)
        room[i] = values[i] + sign * off[i];
    bead_summary_of(room, count, &moved);
    return moved;
}

static double farther(double least, double value, double most)
{
    return fmax(value - least, most - value);
}

void bead_summary_uncertainty(const double *values, const double *off, size_t count, double *room, struct bead_summary *uncertainty)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += off[i];
    *uncertainty = (struct bead_summary){count, sum / (double)count, NAN, NAN, NAN, NAN, NAN, {NAN, NAN}};
    if (!isfinite(sum) || count == 0)
        return;
    const struct bead_summary least = summary_moved(values, off, -1, count, room),
                              value = summary_moved(values, off, 0, count, room), most = summary_moved(values, off, 1, count, room);
    uncertainty->low = farther(least.low, value.low, most.low);
    uncertainty->high = farther(least.high, value.high, most.high);
    uncertainty->median = farther(least.median, value.median, most.median);
    for (size_t i = 0; i < 2; i++)
        uncertainty->quartile[i] = farther(least.quartile[i], value.quartile[i], most.quartile[i]);
}

struct bead_line bead_line_of(const double *x, const double *y, size_t count)
{
    const double n = (double)count;
    double mx = 0, my = 0, sxx = 0, sxy = 0, rest = 0;
    for (size_t i = 0; i < count; i++) {
        mx += x[i] / n;
        my += y[i] / n;
    }
    for (size_t i = 0; i < count; i++) {
        sxx += (x[i] - mx) * (x[i] - mx);
        sxy += (x[i] - mx) * (y[i] - my);
    }
    if (count < 3 || !(sxx > 0) || !isfinite(sxx + sxy))
        return (struct bead_line){NAN, NAN, NAN, NAN, NAN};
    const double slope = sxy / sxx;
    for (size_t i = 0; i < count; i++) {
        const double off = y[i] - my - slope * (x[i] - mx);
        rest += off * off;
    }
    return (struct bead_line){slope, sqrt(rest / (n - 2) / sxx), my - slope * mx, mx, sxx};
}

/* The normal quantile of .0013, both tails. */
static const double z = 3.2159797607880902;

/* The quantile of Student's distribution: M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 26.7.5. From four
 * degrees of freedom on, the tails are .0013 to .0016. */
static double student(double freedom)
{
    const double z2 = z * z, g1 = (z2 + 1) / 4, g2 = ((5 * z2 + 16) * z2 + 3) / 96,
                 g3 = (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
    return z * (1 + (g1 + (g2 + g3 / freedom) / freedom) / freedom);
}

size_t bead_sample_every(size_t all)
{
    enum { SPARSEST = 64, LEAST = 5 };
    const size_t most = all / LEAST;
    return most > SPARSEST ? SPARSEST : most > 1 ? most : 1;
}

double bead_sample_error(const struct bead_summary *sample, size_t all)
{
    if (sample->count == all)
        return 0;
    const double left = 1 - (double)sample->count / (double)all;
    return student((double)sample->count - 1) * sample->standard_error * sqrt(left);
}

double bead_participation(const double *y, size_t count)
{
    double sum = 0, squares = 0, largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(y[i]));
    for (size_t i = 0; i < count && largest > 0; i++) {
        double part = fabs(y[i]) / largest;
        sum += part;
        squares += part * part;
    }
    return largest > 0 ? sum * sum / squares : NAN;
}
