/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete Fourier transforms for spectral.c. */
#include "sim/equation/fourier.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "sim/base/wide.h"

enum { FACTORS_MAX = 64 };

struct bead_fourier {
    size_t points, length;            /* real numbers; complex ones transformed */
    size_t factor[FACTORS_MAX];       /* of `length`; 0 after the last */
    struct bead_complex *turn;        /* [points] exp(-2 pi i k / points) */
    struct bead_complex *one, *other; /* [length] */
};

static void find_factors(size_t rest, size_t *factor)
{
    for (; rest % 4 == 0; rest /= 4)
        *factor++ = 4;
    for (size_t p = 2; rest > 1; p++) {
        p = p * p > rest ? rest : p;
        for (; rest % p == 0; rest /= p)
            *factor++ = p;
    }
    *factor = 0;
}

enum bead_error bead_fourier_create(size_t points, struct bead_fourier **fourier, struct bead_message *msg)
{
    struct bead_fourier *f = *fourier = calloc(1, sizeof *f);
    const size_t length = points % 2 ? points : points / 2;
    struct bead_complex *memory =
        f && points < SIZE_MAX / 4 / sizeof *memory ? malloc((points + 2 * length) * sizeof *memory) : NULL;
    if (!memory) {
        free(f);
        *fourier = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for Fourier transforms of %zu points", points);
    }
    *f = (struct bead_fourier){points, length, {0}, memory, memory + points, memory + points + length};
    find_factors(length, f->factor);
    const struct bead_turn step = bead_turn_by(-2 * bead_wide_pi / points);
    struct bead_turn at = {1, 0};
    for (size_t k = 0; k < points; k++, at = bead_turn_on(at, step))
        f->turn[k] = (struct bead_complex){(double)at.re, (double)at.im};
    return BEAD_OK;
}

void bead_fourier_destroy(struct bead_fourier *f)
{
    if (f)
        free(f->turn);
    free(f);
}

static inline struct bead_complex plus(struct bead_complex a, struct bead_complex b)
{
    return (struct bead_complex){a.re + b.re, a.im + b.im};
}

static inline struct bead_complex minus(struct bead_complex a, struct bead_complex b)
{
    return (struct bead_complex){a.re - b.re, a.im - b.im};
}

static inline struct bead_complex conjugate(struct bead_complex a)
{
    return (struct bead_complex){a.re, -a.im};
}

/* One stage: transforms the numbers x[q + stride (k + m r)], r < p, over r, and stores the results, turned by k r of p m, as
 * y[q + stride (p k + r)]. */
struct stage {
    size_t p, m, stride;
    const struct bead_complex *turn; /* of the first stage's p m */
    size_t unit;                     /* stride in `turn` between those of p m */
};

static void by_two(const struct stage *s, const struct bead_complex *restrict x, struct bead_complex *restrict y)
{
    for (size_t k = 0; k < s->m; k++) {
        const struct bead_complex w = s->turn[k * s->unit], *a = x + s->stride * k, *b = a + s->stride * s->m;
        struct bead_complex *to = y + s->stride * 2 * k, *next = to + s->stride;
        for (size_t q = 0; q < s->stride; q++) {
            to[q] = plus(a[q], b[q]);
            next[q] = bead_complex_times(minus(a[q], b[q]), w);
        }
    }
}

static void by_four(const struct stage *s, const struct bead_complex *restrict x, struct bead_complex *restrict y)
{
    const size_t n = s->stride, far = n * s->m;
    for (size_t k = 0; k < s->m; k++) {
        const struct bead_complex w = s->turn[k * s->unit], w2 = s->turn[2 * k * s->unit], w3 = s->turn[3 * k * s->unit];
        const struct bead_complex *a = x + n * k;
        struct bead_complex *to = y + n * 4 * k;
        for (size_t q = 0; q < n; q++) {
            const struct bead_complex sum = plus(a[q], a[q + 2 * far]), gap = minus(a[q], a[q + 2 * far]);
            const struct bead_complex odd = plus(a[q + far], a[q + 3 * far]), rest = minus(a[q + far], a[q + 3 * far]);
            to[q] = plus(sum, odd);
            to[q + n] = bead_complex_times((struct bead_complex){gap.re + rest.im, gap.im - rest.re}, w);
            to[q + 2 * n] = bead_complex_times(minus(sum, odd), w2);
            to[q + 3 * n] = bead_complex_times((struct bead_complex){gap.re - rest.im, gap.im + rest.re}, w3);
        }
    }
}

/* Odd p, inlined with its value if small. The roots of unity for r and p - r are conjugates. */
static inline __attribute__((always_inline)) void by_odd(const struct stage *s, size_t p, const struct bead_complex *restrict x,
                                                         struct bead_complex *restrict y)
{
    const size_t n = s->stride, far = n * s->m, root = s->unit * s->m;
    for (size_t k = 0; k < s->m; k++) {
        const struct bead_complex *a = x + n * k;
        struct bead_complex *to = y + n * p * k;
        for (size_t q = 0; q < n; q++) {
            struct bead_complex sum = a[q];
            for (size_t t = 1; t < p; t++)
                sum = plus(sum, a[q + t * far]);
            to[q] = sum;
        }
        for (size_t r = 1; 2 * r < p; r++) {
            const struct bead_complex w = s->turn[k * r * s->unit], back = s->turn[k * (p - r) * s->unit];
            for (size_t q = 0; q < n; q++) {
                struct bead_complex even = a[q], odd = {0, 0};
                for (size_t t = 1; 2 * t < p; t++) {
                    const struct bead_complex u = s->turn[t * r % p * root], b = a[q + t * far], c = a[q + (p - t) * far];
                    even = plus(even, (struct bead_complex){u.re * (b.re + c.re), u.re * (b.im + c.im)});
                    odd = plus(odd, (struct bead_complex){u.im * (b.im - c.im), u.im * (b.re - c.re)});
                }
                to[q + r * n] = bead_complex_times((struct bead_complex){even.re - odd.re, even.im + odd.im}, w);
                to[q + (p - r) * n] = bead_complex_times((struct bead_complex){even.re + odd.re, even.im - odd.im}, back);
            }
        }
    }
}

static void by_three(const struct stage *s, const struct bead_complex *x, struct bead_complex *y)
{
    by_odd(s, 3, x, y);
}

static void by_five(const struct stage *s, const struct bead_complex *x, struct bead_complex *y)
{
    by_odd(s, 5, x, y);
}

static void by_any(const struct stage *s, const struct bead_complex *x, struct bead_complex *y)
{
    by_odd(s, s->p, x, y);
}

typedef void (*stage_function)(const struct stage *s, const struct bead_complex *x, struct bead_complex *y);
static const stage_function of_factor[] = {[2] = by_two, [3] = by_three, [4] = by_four, [5] = by_five};

/* Transforms f->one; returns the result, in f->one or f->other. */
static struct bead_complex *transform(struct bead_fourier *f)
{
    struct bead_complex *x = f->one, *y = f->other;
    struct stage stage = {.m = f->length, .stride = 1, .turn = f->turn, .unit = f->points / f->length};
    for (const size_t *p = f->factor; *p; p++) {
        stage.p = *p;
        stage.m /= *p;
        (*p < sizeof of_factor / sizeof *of_factor ? of_factor[*p] : by_any)(&stage, x, y);
        struct bead_complex *const done = y;
        y = x;
        x = done;
        stage.stride *= *p;
        stage.unit *= *p;
    }
    return x;
}

void bead_fourier_forward(struct bead_fourier *f, const double *grid, struct bead_complex *bins)
{
    const size_t n = f->length;
    const bool paired = n < f->points;
    for (size_t j = 0; j < n; j++)
        f->one[j] = paired ? (struct bead_complex){grid[2 * j], grid[2 * j + 1]} : (struct bead_complex){grid[j], 0};
    const struct bead_complex *z = transform(f);
    for (size_t k = 0; k <= f->points / 2; k++) {
        const struct bead_complex a = z[k % n], b = conjugate(z[(n - k) % n]), even = plus(a, b), odd = minus(a, b);
        const struct bead_complex turned = bead_complex_times((struct bead_complex){odd.im, -odd.re}, f->turn[k]);
        bins[k] = paired ? (struct bead_complex){0.5 * (even.re + turned.re), 0.5 * (even.im + turned.im)} : a;
    }
}

/* The conjugate of the forward transform of the conjugates. */
void bead_fourier_backward(struct bead_fourier *f, const struct bead_complex *bins, double *grid)
{
    const size_t n = f->length, half = f->points / 2;
    const bool paired = n < f->points;
    for (size_t k = 0; k < n; k++) {
        const struct bead_complex a = k <= half ? bins[k] : conjugate(bins[n - k]), b = conjugate(bins[paired ? half - k : 0]);
        const struct bead_complex turned = bead_complex_times(minus(a, b), conjugate(f->turn[k]));
        f->one[k] = conjugate(paired ? plus(plus(a, b), (struct bead_complex){-turned.im, turned.re}) : a);
    }
    const struct bead_complex *z = transform(f);
    for (size_t j = 0; j < n; j++) {
        grid[paired ? 2 * j : j] = z[j].re;
        if (paired)
            grid[2 * j + 1] = -z[j].im;
    }
}
