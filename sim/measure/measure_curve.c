/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polynomials through equally spaced samples, for maxima and crossings between them. */
#include "sim/measure/measure_private.h"

#include <math.h>

/* Bisections that reduce an interval of length 2 to rounding errors. */
enum { BISECTIONS = 54 };

struct bead_curve bead_curve_through(const double *values, size_t count)
{
    struct bead_curve curve = {.count = count};
    for (size_t i = 0; i < count; i++)
        curve.difference[i] = values[i];
    for (size_t order = 1; order < count; order++) {
        for (size_t i = count - 1; i >= order; i--)
            curve.difference[i] = (curve.difference[i] - curve.difference[i - 1]) / (double)order;
    }
    return curve;
}

double bead_curve_value(const struct bead_curve *curve, double x)
{
    double value = 0;
    for (size_t i = curve->count; i-- > 0;)
        value = value * (x - (double)i) + curve->difference[i];
    return value;
}

static double curve_slope(const struct bead_curve *curve, double x)
{
    double value = 0, slope = 0;
    for (size_t i = curve->count; i-- > 0;) {
        slope = slope * (x - (double)i) + value;
        value = value * (x - (double)i) + curve->difference[i];
    }
    return slope;
}

double bead_curve_crossing(const struct bead_curve *curve, double value, double low, double high)
{
    double sign = bead_curve_value(curve, low) - value >= 0 ? 1 : -1;
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (low + high);
        if (sign * (bead_curve_value(curve, middle) - value) >= 0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double bead_curve_maximum(const struct bead_curve *curve, double low, double high)
{
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (low + high);
        if (curve_slope(curve, middle) > 0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double bead_curve_integral(const struct bead_curve *curve, double from, double to)
{
    /* Gauss-Legendre, exact up to degree 7. */
    static const double node[2] = {0.3399810435848563, 0.8611363115940526}, weight[2] = {0.6521451548625461, 0.3478548451374538};
    const double centre = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (size_t i = 0; i < 2; i++)
        sum += weight[i] * (bead_curve_value(curve, centre - half * node[i]) + bead_curve_value(curve, centre + half * node[i]));
    return half * sum;
}

size_t bead_curve_window(size_t count, size_t at, size_t *points)
{
    *points = count < BEAD_CURVE_POINTS ? count : BEAD_CURVE_POINTS;
    size_t half = *points / 2, first = at > half ? at - half : 0;
    return first + *points > count ? count - *points : first;
}

double bead_samples_maximum(const double *values, size_t count, double *largest)
{
    size_t at = 0, points;
    for (size_t i = 1; i < count; i++)
        at = values[i] > values[at] ? i : at;
    *largest = count > 0 ? values[at] : NAN;
    if (at == 0 || at + 1 >= count)
        return NAN;
    size_t first = bead_curve_window(count, at, &points);
    struct bead_curve curve = bead_curve_through(values + first, points);
    double x = bead_curve_maximum(&curve, (double)(at - 1 - first), (double)(at + 1 - first)), value = bead_curve_value(&curve, x);
    if (value >= *largest) /* else a kink is nearby */
        *largest = value;
    return value >= values[at] ? (double)first + x : (double)at;
}

double bead_samples_crossing(const double *values, size_t count, size_t from, int step, double level)
{
    for (size_t i = from; step > 0 ? i + 1 < count : i > 0;) {
        size_t next = step > 0 ? i + 1 : i - 1, low = step > 0 ? i : next, points;
        if (values[i] >= level && values[next] < level) {
            size_t first = bead_curve_window(count, low, &points);
            struct bead_curve curve = bead_curve_through(values + first, points);
            return (double)first + bead_curve_crossing(&curve, level, (double)(low - first), (double)(low + 1 - first));
        }
        i = next;
    }
    return NAN;
}
