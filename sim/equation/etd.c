/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exponential time differencing, see etd.h: the coefficients of a step, and the step. */
#include "sim/equation/etd.h"

static struct bead_turn over(struct bead_turn a, struct bead_turn b)
{
    bead_wide norm = b.re * b.re + b.im * b.im;
    return (struct bead_turn){(a.re * b.re + a.im * b.im) / norm, (a.im * b.re - a.re * b.im) / norm};
}

/* The coefficients over h, complex numbers. */
struct functions {
    struct bead_turn q, f1, f2, f3;
};

/* At z = i angle, with e = exp(z) and half = exp(z / 2). */
static struct functions formulas(bead_wide angle, struct bead_turn e, struct bead_turn half)
{
    const struct bead_turn z = {0, angle}, z3 = {0, -angle * angle * angle};
    const bead_wide square = -angle * angle;
    struct bead_turn e1 = bead_turn_on(e, (struct bead_turn){4 + square, -3 * angle});
    struct bead_turn e2 = bead_turn_on(e, (struct bead_turn){-2, angle}), e3 = bead_turn_on(e, (struct bead_turn){4, -angle});
    struct functions f;
    f.q = over((struct bead_turn){half.re - 1, half.im}, z);
    f.f1 = over((struct bead_turn){e1.re - 4, e1.im - angle}, z3);
    f.f2 = over((struct bead_turn){2 * (e2.re + 2), 2 * (e2.im + angle)}, z3);
    f.f3 = over((struct bead_turn){e3.re - 4 - square, e3.im - 3 * angle}, z3);
    return f;
}

/* Below this angle the formulas lose digits; there TERMS terms of the series are exact to rounding. */
static const double cancels = 2, rounding = 1e-22;
enum { TERMS = 28 };

/* Coefficients of the powers of z in q / 2, f1, f2 and f3. */
struct series {
    bead_wide q[TERMS], f1[TERMS], f2[TERMS], f3[TERMS];
};

static void make_series(struct series *to)
{
    bead_wide one = 1, half = 0.5; /* 1 / (n + 1)!, and with z / 2 for z */
    for (int n = 0; n < TERMS; n++) {
        const bead_wide two = one / (n + 2), three = two / (n + 3);
        to->q[n] = half;
        to->f1[n] = 4 * three - 3 * two + one;
        to->f2[n] = 2 * (two - 2 * three);
        to->f3[n] = 4 * three - two;
        one = two;
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

/* sum of a_n (i angle)^n, n < terms: the even powers are real. */
static struct bead_turn sum_of(const bead_wide a[TERMS], int terms, bead_wide angle, bead_wide square)
{
    struct bead_turn sum = {0, 0};
    for (int n = terms - 2; n >= 0; n -= 2) {
        sum.re = a[n] - square * sum.re;
        sum.im = a[n + 1] - square * sum.im;
    }
    sum.im *= angle;
    return sum;
}

static struct functions by_series(const struct series *a, bead_wide angle)
{
    const bead_wide square = angle * angle;
    const int n = terms_at((double)angle);
    return (struct functions){sum_of(a->q, n, angle, square), sum_of(a->f1, n, angle, square), sum_of(a->f2, n, angle, square),
                              sum_of(a->f3, n, angle, square)};
}

static struct bead_complex narrow(struct bead_turn x, bead_wide h)
{
    return (struct bead_complex){(double)(h * x.re), (double)(h * x.im)};
}

void bead_etd_rows(const bead_wide *omega, size_t modes, bead_wide h, struct bead_etd_row *rows)
{
    struct series series;
    make_series(&series);
    for (size_t j = 0; j <= modes; j++) {
        const bead_wide angle = omega[j] * h;
        const struct bead_turn half = bead_turn_by(angle / 2), whole = bead_turn_on(half, half);
        const struct functions f = bead_wide_abs(angle) < cancels ? by_series(&series, angle) : formulas(angle, whole, half);
        rows[j] = (struct bead_etd_row){narrow(whole, 1), narrow(half, 1), narrow(f.q, h),
                                        narrow(f.f1, h),  narrow(f.f2, h), narrow(f.f3, h)};
    }
}

/* ---- within a step ---- */

/* a / (i angle)^3 */
static struct bead_complex over_cube(double re, double im, double angle)
{
    const double cube = angle * angle * angle;
    return (struct bead_complex){-im / cube, re / cube};
}

/* As `formulas`, over h. */
static struct bead_etd_row near_formulas(double a, struct bead_complex e, struct bead_complex half)
{
    const double square = a * a;
    const struct bead_complex e1 = bead_complex_times(e, (struct bead_complex){4 - square, -3 * a}),
                              e2 = bead_complex_times(e, (struct bead_complex){-2, a}),
                              e3 = bead_complex_times(e, (struct bead_complex){4, -a});
    return (struct bead_etd_row){.q = {half.im / a, (1 - half.re) / a},
                                 .f1 = over_cube(e1.re - 4, e1.im - a, a),
                                 .f2 = over_cube(2 * (e2.re + 2), 2 * (e2.im + a), a),
                                 .f3 = over_cube(e3.re - 4 + square, e3.im - 3 * a, a)};
}

static struct bead_complex near_sum(const bead_wide a[TERMS], int terms, double angle)
{
    struct bead_complex sum = {0, 0};
    for (int n = terms - 2; n >= 0; n -= 2) {
        sum.re = (double)a[n] - angle * angle * sum.re;
        sum.im = (double)a[n + 1] - angle * angle * sum.im;
    }
    sum.im *= angle;
    return sum;
}

static struct bead_complex times(double h, struct bead_complex z)
{
    return (struct bead_complex){h * z.re, h * z.im};
}

void bead_etd_rows_within(const bead_wide *w, size_t modes, bead_wide h, struct bead_etd_row *rows)
{
    const bead_wide difference[] = {w[0], w[1] - w[0], w[2] - 2 * w[1] + w[0], w[3] - 3 * (w[2] - w[1]) - w[0]};
    struct bead_turn at[4]; /* exp(i h / 2) to the powers of the differences of the frequencies */
    struct series a;
    make_series(&a);
    for (size_t n = 0; n < 4; n++)
        at[n] = bead_turn_by(difference[n] * h / 2);
    for (size_t j = 0; j <= modes; j++) {
        const double angle = (double)w[j] * (double)h, step = (double)h;
        const struct bead_complex half = narrow(at[0], 1), whole = bead_complex_times(half, half);
        const int n = terms_at(angle);
        const struct bead_etd_row row = fabs(angle) < cancels ? (struct bead_etd_row){.q = near_sum(a.q, n, angle),
                                                                                      .f1 = near_sum(a.f1, n, angle),
                                                                                      .f2 = near_sum(a.f2, n, angle),
                                                                                      .f3 = near_sum(a.f3, n, angle)}
                                                              : near_formulas(angle, whole, half);
        rows[j] =
            (struct bead_etd_row){whole, half, times(step, row.q), times(step, row.f1), times(step, row.f2), times(step, row.f3)};
        for (size_t k = 0; k < 3; k++)
            at[k] = bead_turn_on(at[k], at[k + 1]);
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
