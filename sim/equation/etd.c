/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exponential time differencing, see etd.h: the coefficients of a step, and the step. */
#include "sim/equation/etd.h"

#include <math.h>

/* Below this angle the formulas lose digits; there TERMS terms of the series are exact to rounding. */
static const double cancels = 2, rounding = 1e-22;
enum { TERMS = 28 };

/* Coefficients of the powers of z in q / 2, f1, f2 and f3: the series of exp in Cox and Matthews' formulas, without terms that
 * cancel. */
struct series {
    double q[TERMS], f1[TERMS], f2[TERMS], f3[TERMS];
};

static void make_series(struct series *to)
{
    double one = 1, half = 0.5; /* 1 / (n + 1)!, and with z / 2 for z */
    for (int n = 0; n < TERMS; n++) {
        const double three = one / ((n + 2) * (n + 3));
        to->q[n] = half;
        to->f1[n] = (n + 1) * (n + 1) * three;
        to->f2[n] = 2 * (n + 1) * three;
        to->f3[n] = (1 - n) * three;
        one /= n + 2;
        half /= 2 * (n + 2);
    }
}

/* The number of terms that count, which is even. */
static int terms_at(double angle)
{
    int n = 2;
    for (double size = angle * angle; n < TERMS && size > rounding; n += 2)
        size *= angle * angle / ((n + 1) * (n + 2));
    return n;
}

/* h sum of a_n (i angle)^n, n < terms: the even powers are real. */
static struct bead_complex sum_of(const double a[TERMS], int terms, double angle, double h)
{
    struct bead_complex sum = {0, 0};
    for (int n = terms - 2; n >= 0; n -= 2) {
        sum.re = a[n] - angle * angle * sum.re;
        sum.im = a[n + 1] - angle * angle * sum.im;
    }
    return (struct bead_complex){h * sum.re, h * (angle * sum.im)};
}

static struct bead_etd_row by_series(const struct series *a, double angle, double h)
{
    const int n = terms_at(angle);
    return (struct bead_etd_row){.q = sum_of(a->q, n, angle, h),
                                 .f1 = sum_of(a->f1, n, angle, h),
                                 .f2 = sum_of(a->f2, n, angle, h),
                                 .f3 = sum_of(a->f3, n, angle, h)};
}

/* a / (i angle)^3, over_h for h / angle^3 */
static struct bead_complex over_cube(double re, double im, double over_h)
{
    return (struct bead_complex){-im * over_h, re * over_h};
}

/* At z = i angle, with e = exp(z) and half = exp(z / 2). */
static struct bead_etd_row formulas(double a, struct bead_complex e, struct bead_complex half, double h)
{
    const double square = a * a, over_a = h / a, over_a3 = over_a / square;
    const struct bead_complex e1 = bead_complex_times(e, (struct bead_complex){4 - square, -3 * a}),
                              e2 = bead_complex_times(e, (struct bead_complex){-2, a}),
                              e3 = bead_complex_times(e, (struct bead_complex){4, -a});
    return (struct bead_etd_row){.q = {half.im * over_a, (1 - half.re) * over_a},
                                 .f1 = over_cube(e1.re - 4, e1.im - a, over_a3),
                                 .f2 = over_cube(2 * (e2.re + 2), 2 * (e2.im + a), over_a3),
                                 .f3 = over_cube(e3.re - 4 + square, e3.im - 3 * a, over_a3)};
}

void bead_etd_rows(const struct bead_pair *omega, size_t modes, double h, struct bead_etd_row *rows)
{
    struct series series;
    make_series(&series);
    for (size_t j = 0; j <= modes; j++) {
        const struct bead_pair angle = bead_pair_times(omega[j], 0.5 * h);
        const double whole_angle = 2 * angle.high;
        struct bead_complex half;
        bead_turn_to(angle, &half.re, &half.im);
        const struct bead_complex whole = bead_complex_times(half, half);
        rows[j] = fabs(whole_angle) < cancels ? by_series(&series, whole_angle, h) : formulas(whole_angle, whole, half, h);
        rows[j].whole = whole;
        rows[j].half = half;
    }
}

/* ---- steps ---- */

static void add_product(struct bead_complex *sum, struct bead_complex a, struct bead_complex b)
{
    struct bead_complex product = bead_complex_times(a, b);
    sum->re += product.re;
    sum->im += product.im;
}

void bead_etd_step(const struct bead_etd_row *rows, size_t modes, bead_etd_slope slope, void *context, struct bead_etd_work *work,
                   const struct bead_complex *from, struct bead_complex *to)
{
    struct bead_complex *const *n = work->slope, *a = work->a, *b = work->b;
    for (size_t j = 0; j <= modes; j++) {
        a[j] = bead_complex_times(rows[j].half, from[j]);
        add_product(&a[j], rows[j].q, n[0][j]);
    }
    slope(context, a, n[1]);
    for (size_t j = 0; j <= modes; j++) {
        b[j] = bead_complex_times(rows[j].half, from[j]);
        add_product(&b[j], rows[j].q, n[1][j]);
    }
    slope(context, b, n[2]);
    for (size_t j = 0; j <= modes; j++) {
        b[j] = bead_complex_times(rows[j].half, a[j]);
        add_product(&b[j], rows[j].q, (struct bead_complex){2 * n[2][j].re - n[0][j].re, 2 * n[2][j].im - n[0][j].im});
    }
    slope(context, b, n[3]);
    for (size_t j = 0; j <= modes; j++) {
        struct bead_complex sum = bead_complex_times(rows[j].whole, from[j]);
        add_product(&sum, rows[j].f1, n[0][j]);
        add_product(&sum, rows[j].f2, (struct bead_complex){n[1][j].re + n[2][j].re, n[1][j].im + n[2][j].im});
        add_product(&sum, rows[j].f3, n[3][j]);
        to[j] = sum;
    }
}
