/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Logarithm, cube root and the powers 2/5 and 3/2, with the same bits on every processor. */
#include "sim/base/elementary.h"

#include <math.h>

#include "sim/base/wide.h"

/* A sum of two numbers, the second much smaller than the first. */
struct pair {
    double high, low;
};

/* x y exactly, unless it overflows or underflows: T. J. Dekker, Numer. Math. 18, 224 (1971). */
static struct pair product(double x, double y)
{
    const double splitter = 0x1p27 + 1, a = splitter * x, b = splitter * y;
    const double x1 = a - (a - x), x2 = x - x1, y1 = b - (b - y), y2 = y - y1, p = x * y;
    return (struct pair){p, ((x1 * y1 - p) + x1 * y2 + x2 * y1) + x2 * y2};
}

/* Between these limits the products below neither overflow nor lose digits. */
static const double small = 0x1p-400, large = 0x1p300;

/* The C library's root is right to 1 unit in the last place; one Newton step with the exact remainder rounds it correctly. */
double bead_cbrt(double x)
{
    const double y = cbrt(x);
    if (!(x > 0 && isfinite(x)))
        return y;
    if (x < small || x > large)
        return x < small ? 0x1p-100 * bead_cbrt(0x1p300 * x) : 0x1p100 * bead_cbrt(0x1p-300 * x);
    const struct pair square = product(y, y), cube = product(square.high, y);
    return y + ((x - cube.high) - (cube.low + square.low * y)) / (3 * square.high);
}

/* Like bead_cbrt, for y^5 = x^2. */
double bead_two_fifths(double x)
{
    const double y = pow(x, 0.4);
    if (!(x > 0 && isfinite(x)))
        return y;
    if (x < 0x1p-150 || x > 0x1p150)
        return x < 1 ? 0x1p-120 * bead_two_fifths(0x1p300 * x) : 0x1p120 * bead_two_fifths(0x1p-300 * x);
    const struct pair wanted = product(x, x), square = product(y, y), fourth = product(square.high, square.high);
    const struct pair fifth = product(fourth.high, y);
    const double low = fifth.low + (fourth.low + 2 * square.high * square.low) * y;
    return y + ((wanted.high - fifth.high) + (wanted.low - low)) / (5 * fourth.high);
}

/* x sqrt(x), with the remainder of the root. */
double bead_three_halves(double x)
{
    const double root = sqrt(x);
    if (!(x > 0 && isfinite(x)))
        return x * root;
    if (x < small || x > large)
        return x < small ? 0x1p-600 * bead_three_halves(0x1p400 * x) : 0x1p600 * bead_three_halves(0x1p-400 * x);
    const struct pair square = product(root, root), power = product(x, root);
    return power.high + (power.low + x * ((x - square.high) - square.low) / (2 * root));
}

/* x = 2^k m with m about 1; ln m = 2 artanh s, s = (m - 1) / (m + 1), by its series. */
double bead_log(double x)
{
    enum { TERMS = 11 };
    if (!(x > 0 && isfinite(x)))
        return x == 0 ? -INFINITY : x < 0 ? NAN : x;
    int k;
    double m = frexp(x, &k);
    if (m < 0.70710678118654752) {
        m *= 2;
        k--;
    }
    const double s = (m - 1) / (m + 1), square = s * s;
    double series = 0;
    for (int i = TERMS; i > 0; i--)
        series = square * (series + 1.0 / (2 * i + 1));
    /* ln 2 in two parts: products of the first with k are exact */
    return k * 0x1.62e42feep-1 + (2 * s + (2 * s * series + k * 0x1.a39ef35793c76p-33));
}
