/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Logarithm, cube root, the powers 2/5 and 3/2, cosine and sine, with the same bits on every processor. */
#include "sim/base/elementary.h"

#include <math.h>
#include <stdint.h>

#include "sim/base/wide.h"

/* x y exactly, unless it overflows or underflows: T. J. Dekker, Numer. Math. 18, 224 (1971). */
static inline struct bead_pair product(double x, double y)
{
    const double splitter = 0x1p27 + 1, a = splitter * x, b = splitter * y;
    const double x1 = a - (a - x), x2 = x - x1, y1 = b - (b - y), y2 = y - y1, p = x * y;
    return (struct bead_pair){p, ((x1 * y1 - p) + x1 * y2 + x2 * y1) + x2 * y2};
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
    const struct bead_pair square = product(y, y), cube = product(square.high, y);
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
    const struct bead_pair wanted = product(x, x), square = product(y, y), fourth = product(square.high, square.high);
    const struct bead_pair fifth = product(fourth.high, y);
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
    const struct bead_pair square = product(root, root), power = product(x, root);
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

/* The larger first. */
static inline struct bead_pair sum(double a, double b)
{
    const double high = a + b;
    return (struct bead_pair){high, (a - high) + b};
}

struct bead_pair bead_pair_times(struct bead_pair a, double b)
{
    const struct bead_pair p = product(a.high, b);
    return sum(p.high, p.low + a.low * b);
}

/* Reduces the angle by whole quarters, to within pi / 4, for the Taylor series, whose next term is below 2^-63; adds the leading
 * terms last, and the part of the angle beyond a double to first order. W. J. Cody, W. Waite, Software Manual for the Elementary
 * Functions (Prentice-Hall, 1980), chapter 8. */
void bead_turn_to(struct bead_pair angle, double *cosine, double *sine)
{
    enum { TERMS = 8 };
#define BY(k)                                                                \
    {                                                                        \
        1. / ((2 * (k) + 1) * (2 * (k) + 2)), 1. / (2 * (k) * (2 * (k) + 1)) \
    }
    static const double by[TERMS][2] = {BY(1), BY(2), BY(3), BY(4), BY(5), BY(6), BY(7), BY(8)};
#undef BY
    const double quarter = 0x1.921fb54442d18p0, quarter_low = 0x1.1a62633145c07p-54, to_whole = 0x1.8p52;
    const double n = (angle.high * (1 / quarter) + to_whole) - to_whole;
    const struct bead_pair turned = product(n, quarter);
    const struct bead_pair x = sum(angle.high - turned.high, (angle.low - turned.low) - n * quarter_low);
    const double square = x.high * x.high, half = 0.5 * square, one = 1 - half;
    double even = 0, odd = 0; /* cos x = 1 - x^2 / 2 + x^4 even / 2, sin x = x - x^3 odd */
    for (int k = TERMS - 1; k >= 0; k--) {
        even = (1 - square * even) * by[k][0];
        odd = (1 - square * odd) * by[k][1];
    }
    const double c = one + (((1 - one) - half) + (half * square * even - x.high * x.low));
    const double s = x.high - (x.high * square * odd - x.low * one);
    const double turns[] = {c, s, -c, -s};
    const unsigned quadrant = (unsigned)((uint64_t)(int64_t)n & 3);
    *cosine = turns[(4 - quadrant) & 3];
    *sine = turns[(5 - quadrant) & 3];
}
