/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hermite interpolants, and zeros by false position. */
#include "sim/integrate/polynomial.h"

#include <math.h>
#include <stdbool.h>

struct bead_polynomial bead_polynomial_hermite(const double at0[4], const double at1[4])
{
    double c0 = at0[0], c1 = at0[1], c2 = at0[2] / 2, c3 = at0[3] / 6;
    double r0 = at1[0] - (c0 + c1 + c2 + c3), r1 = at1[1] - (c1 + 2 * c2 + 3 * c3), r2 = at1[2] - (2 * c2 + 6 * c3),
           r3 = at1[3] - 6 * c3;
    return (struct bead_polynomial){{c0, c1, c2, c3, 35 * r0 - 15 * r1 + 2.5 * r2 - r3 / 6, -84 * r0 + 39 * r1 - 7 * r2 + r3 / 2,
                                     70 * r0 - 34 * r1 + 6.5 * r2 - r3 / 2, -20 * r0 + 10 * r1 - 2 * r2 + r3 / 6}};
}

struct bead_polynomial bead_polynomial_quintic(const double at0[3], const double at1[3])
{
    double c0 = at0[0], c1 = at0[1], c2 = at0[2] / 2, r0 = at1[0] - (c0 + c1 + c2), r1 = at1[1] - (c1 + 2 * c2),
           r2 = at1[2] - 2 * c2;
    return (struct bead_polynomial){
        {c0, c1, c2, 10 * r0 - 4 * r1 + 0.5 * r2, -15 * r0 + 7 * r1 - r2, 6 * r0 - 3 * r1 + 0.5 * r2, 0, 0}};
}

double bead_polynomial_value(const struct bead_polynomial *p, double x)
{
    double value = p->c[7];
    for (int i = 6; i >= 0; i--)
        value = value * x + p->c[i];
    return value;
}

double bead_polynomial_slope(const struct bead_polynomial *p, double x)
{
    double slope = 7 * p->c[7];
    for (int i = 6; i >= 1; i--)
        slope = slope * x + i * p->c[i];
    return slope;
}

/* A polynomial over x0 <= x <= x0 + width in Bernstein's form lies between the smallest and the largest of its coefficients b.
 * De Casteljau's scheme halves the interval until it lies below, begins above, or is as narrow as rounding. */
static double first_above(const double b[8], double x0, double width)
{
    static const double smallest = 0x1p-50;
    double left[8], right[8];
    bool below = true;
    for (int i = 0; i < 8; i++)
        below = below && !(b[i] > 0);
    if (below || b[0] > 0 || width < smallest)
        return below ? INFINITY : x0;
    for (int i = 0; i < 8; i++)
        right[i] = b[i];
    for (int i = 0; i < 8; i++) {
        left[i] = right[0];
        for (int k = 0; k + 1 < 8 - i; k++)
            right[k] = 0.5 * (right[k] + right[k + 1]);
    }
    double x = first_above(left, x0, 0.5 * width);
    return isfinite(x) ? x : first_above(right, x0 + 0.5 * width, 0.5 * width);
}

double bead_polynomial_first_above(const struct bead_polynomial *p, double limit)
{
    double b[8];
    for (int i = 0; i < 8; i++) {
        double part = 1; /* binomial(i, k) / binomial(7, k) */
        b[i] = p->c[0] - limit;
        for (int k = 1; k <= i; k++) {
            part *= (double)(i - k + 1) / (8 - k);
            b[i] += part * p->c[k];
        }
    }
    return first_above(b, 0, 1);
}

double bead_find_root(bead_function f, const void *context, double f0, double f1)
{
    double low = 0, high = 1;
    int kept = 0; /* the end that did not move last time, -1 low, +1 high: its value is halved if it does not move again */
    for (int i = 0; i < 60 && high - low > 1e-15; i++) {
        double x = f1 == f0 ? 0.5 : low - f0 * (high - low) / (f1 - f0);
        if (!(x > low && x < high) || i % 8 == 7)
            x = 0.5 * (low + high);
        double fx = f(context, x);
        if (fx == 0)
            return x;
        if ((fx > 0) == (f1 > 0)) {
            high = x;
            f1 = fx;
            f0 *= kept < 0 ? 0.5 : 1;
            kept = -1;
        } else {
            low = x;
            f0 = fx;
            f1 *= kept > 0 ? 0.5 : 1;
            kept = 1;
        }
    }
    return 0.5 * (low + high);
}
