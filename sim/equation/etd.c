/* Exponential time differencing, see etd.h: the coefficients of a step and the step itself, for kdv_solver.c. */
#include "sim/equation/etd.h"

#include <math.h>

/* Long double arithmetic: its sines are the same bits on all x86-64 processors, those of double are not. */
struct wide {
    long double re, im;
};

static const long double pi = 3.141592653589793238462643383279503L;
enum { CONTOUR = 32 }; /* points on the unit circle about z: the mean is exact to rounding */

static struct wide times(struct wide a, struct wide b)
{
    return (struct wide){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static struct wide over(struct wide a, struct wide b)
{
    long double norm = b.re * b.re + b.im * b.im;
    return (struct wide){(a.re * b.re + a.im * b.im) / norm, (a.im * b.re - a.re * b.im) / norm};
}

static struct wide turn(long double angle)
{
    return (struct wide){cosl(angle), sinl(angle)};
}

struct functions {
    struct wide q, f1, f2, f3;
};

/* The coefficients over h at z, with e = exp(z) and half = exp(z / 2) given. */
static struct functions formulas(struct wide z, struct wide e, struct wide half)
{
    struct wide z2 = times(z, z), z3 = times(z2, z);
    struct wide e1 = times(e, (struct wide){4 - 3 * z.re + z2.re, -3 * z.im + z2.im});
    struct wide e2 = times(e, (struct wide){z.re - 2, z.im});
    struct wide e3 = times(e, (struct wide){4 - z.re, -z.im});
    struct functions f;
    f.q = over((struct wide){half.re - 1, half.im}, z);
    f.f1 = over((struct wide){e1.re - 4 - z.re, e1.im - z.im}, z3);
    f.f2 = over((struct wide){2 * (e2.re + 2 + z.re), 2 * (e2.im + z.im)}, z3);
    f.f3 = over((struct wide){e3.re - 4 - 3 * z.re - z2.re, e3.im - 3 * z.im - z2.im}, z3);
    return f;
}

static void add(struct wide *sum, struct wide x)
{
    sum->re += x.re / CONTOUR;
    sum->im += x.im / CONTOUR;
}

static struct functions contour(long double angle, const struct wide circle[CONTOUR], const struct wide growth[CONTOUR])
{
    struct functions sum = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    struct wide whole = turn(angle), half = turn(angle / 2);
    for (int i = 0; i < CONTOUR; i++) { /* exp(z + r) = exp(z) exp(r), with exp(r) = growth^2 */
        struct wide z = {circle[i].re, circle[i].im + angle};
        struct functions f = formulas(z, times(whole, times(growth[i], growth[i])), times(half, growth[i]));
        add(&sum.q, f.q);
        add(&sum.f1, f.f1);
        add(&sum.f2, f.f2);
        add(&sum.f3, f.f3);
    }
    return sum;
}

static struct bead_complex narrow(struct wide x, long double h)
{
    return (struct bead_complex){(double)(h * x.re), (double)(h * x.im)};
}

void bead_etd_rows(const long double *omega, size_t modes, long double h, struct bead_etd_row *rows)
{
    const long double cancels = 2; /* the formulas lose digits below this |z| */
    struct wide circle[CONTOUR], growth[CONTOUR];
    for (int i = 0; i < CONTOUR; i++) { /* none of them on the imaginary axis, where z + r could be 0 */
        circle[i] = turn(2 * pi * (i + 0.5L) / CONTOUR);
        growth[i] = turn(circle[i].im / 2);
        long double size = expl(circle[i].re / 2);
        growth[i] = (struct wide){size * growth[i].re, size * growth[i].im};
    }
    for (size_t j = 0; j <= modes; j++) {
        long double angle = omega[j] * h;
        struct wide whole = turn(angle), half = turn(angle / 2);
        struct functions f =
            fabsl(angle) < cancels ? contour(angle, circle, growth) : formulas((struct wide){0, angle}, whole, half);
        rows[j] = (struct bead_etd_row){narrow(whole, 1), narrow(half, 1), narrow(f.q, h),
                                        narrow(f.f1, h),  narrow(f.f2, h), narrow(f.f3, h)};
    }
}

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
