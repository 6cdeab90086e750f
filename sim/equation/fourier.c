/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete Fourier transforms for spectral.c. */
#include "sim/equation/fourier.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "sim/base/instruction_set.h"
#include "sim/base/wide.h"

enum { FACTORS_MAX = 64, WIDE = 4 };

/* Complex numbers: their real and their imaginary parts. */
struct split {
    double *re, *im;
};

struct bead_fourier {
    size_t points, length;      /* real numbers; complex ones transformed */
    size_t factor[FACTORS_MAX]; /* of `length`; 0 after the last */
    struct bead_complex *turn;  /* [points] exp(-2 pi i k / points) */
    struct split one, other;    /* [length] */
    double *first;              /* [6][length / 4] turns of the first stage, if it is by four: parts re and im of k, 2 k and 3 k */
    bool avx2;
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

static void fill_turns(struct bead_fourier *f)
{
    const struct bead_turn step = bead_turn_by(-2 * bead_wide_pi / f->points);
    const size_t quarter = f->length / 4, unit = f->points / f->length;
    struct bead_turn at = {1, 0};
    for (size_t k = 0; k < f->points; k++, at = bead_turn_on(at, step))
        f->turn[k] = (struct bead_complex){(double)at.re, (double)at.im};
    for (size_t r = 0; r < 3; r++) {
        for (size_t k = 0; k < quarter; k++) {
            f->first[2 * r * quarter + k] = f->turn[(r + 1) * k * unit].re;
            f->first[(2 * r + 1) * quarter + k] = f->turn[(r + 1) * k * unit].im;
        }
    }
}

enum bead_error bead_fourier_create(size_t points, const char *set, struct bead_fourier **fourier, struct bead_message *msg)
{
    struct bead_fourier *f = *fourier = calloc(1, sizeof *f);
    const size_t length = points % 2 ? points : points / 2;
    double *memory = f && points < SIZE_MAX / 128 ? malloc((2 * points + 4 * length + length / 4 * 6) * sizeof *memory) : NULL;
    if (!memory) {
        free(f);
        *fourier = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for Fourier transforms of %zu points", points);
    }
    double *parts = memory + 2 * points;
    *f = (struct bead_fourier){.points = points,
                               .length = length,
                               .turn = (struct bead_complex *)(void *)memory,
                               .one = {parts, parts + length},
                               .other = {parts + 2 * length, parts + 3 * length},
                               .first = parts + 4 * length,
                               .avx2 = bead_instruction_set_here("avx2") && (!set || strcmp(set, "portable") != 0)};
    find_factors(length, f->factor);
    fill_turns(f);
    return BEAD_OK;
}

void bead_fourier_destroy(struct bead_fourier *f)
{
    if (f)
        free(f->turn);
    free(f);
}

/* One stage: transforms the numbers x[q + stride (k + m r)], r < p, over r, and stores the results, turned by k r of p m, as
 * y[q + stride (p k + r)]. */
struct stage {
    size_t p, m, stride;
    const struct bead_complex *turn; /* of the first stage's p m */
    size_t unit;                     /* stride in `turn` between those of p m */
};

/* Inlined, so that one text is compiled with and without AVX2. */
#define INLINED static inline __attribute__((always_inline))

#define PACK    double
#define LOOSE   double
#define WIDTH   1
#define ZERO    0.0
#define NAME(x) single_##x
#include "sim/equation/fourier_stages.h"

typedef double wide __attribute__((vector_size(WIDE * sizeof(double))));
typedef double wide_loose __attribute__((vector_size(WIDE * sizeof(double)), aligned(sizeof(double)), may_alias));
#define PACK    wide
#define LOOSE   wide_loose
#define WIDTH   WIDE
#define ZERO    ((wide){})
#define NAME(x) wide_##x
#include "sim/equation/fourier_stages.h"

/* The results of four k, those of each k next to each other. */
INLINED void store_columns(const wide *out, double *to)
{
    const wide a = __builtin_shufflevector(out[0], out[2], 0, 4, 2, 6), b = __builtin_shufflevector(out[0], out[2], 1, 5, 3, 7);
    const wide c = __builtin_shufflevector(out[4], out[6], 0, 4, 2, 6), d = __builtin_shufflevector(out[4], out[6], 1, 5, 3, 7);
    *(wide_loose *)to = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    *(wide_loose *)(to + WIDE) = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    *(wide_loose *)(to + 2 * WIDE) = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    *(wide_loose *)(to + 3 * WIDE) = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/* The first stage by four has stride 1: four k at a time. */
INLINED void first_by_four(const double *first, size_t m, struct split x, struct split y)
{
    for (size_t k = 0; k < m; k += WIDE) {
        wide in[8], v[8], out[8];
        for (size_t r = 0; r < 4; r++) {
            in[2 * r] = *(const wide_loose *)(x.re + k + r * m);
            in[2 * r + 1] = *(const wide_loose *)(x.im + k + r * m);
        }
        wide_four(in, v);
        out[0] = v[0];
        out[1] = v[1];
        for (size_t r = 2; r < 8; r += 2) {
            const wide re = *(const wide_loose *)(first + (r - 2) * m + k), im = *(const wide_loose *)(first + (r - 1) * m + k);
            out[r] = v[r] * re - v[r + 1] * im;
            out[r + 1] = v[r] * im + v[r + 1] * re;
        }
        store_columns(out, y.re + 4 * k);
        store_columns(out + 1, y.im + 4 * k);
    }
}

/* Transforms f->one; returns the result, in f->one or f->other. */
INLINED struct split transform(const struct bead_fourier *f)
{
    struct split x = f->one, y = f->other;
    struct stage stage = {.m = f->length, .stride = 1, .turn = f->turn, .unit = f->points / f->length};
    for (const size_t *p = f->factor; *p; p++) {
        stage.p = *p;
        stage.m /= *p;
        if (stage.stride % WIDE == 0)
            wide_stage(&stage, x, y);
        else if (stage.stride == 1 && *p == 4 && stage.m % WIDE == 0)
            first_by_four(f->first, stage.m, x, y);
        else
            single_stage(&stage, x, y);
        const struct split done = y;
        y = x;
        x = done;
        stage.stride *= *p;
        stage.unit *= *p;
    }
    return x;
}

/* Bin k of pairs of real numbers, from the transform of the pairs at k and at -k. */
INLINED struct bead_complex of_pairs(struct split z, size_t k, size_t back, struct bead_complex turn)
{
    const double even_re = z.re[k] + z.re[back], even_im = z.im[k] - z.im[back];
    const double odd_re = z.re[k] - z.re[back], odd_im = z.im[k] + z.im[back];
    const struct bead_complex turned = bead_complex_times((struct bead_complex){odd_im, -odd_re}, turn);
    return (struct bead_complex){0.5 * (even_re + turned.re), 0.5 * (even_im + turned.im)};
}

INLINED void forward(const struct bead_fourier *f, const double *grid, struct bead_complex *bins)
{
    const size_t n = f->length;
    const bool paired = n < f->points;
    for (size_t j = 0; j < n; j++) {
        f->one.re[j] = paired ? grid[2 * j] : grid[j];
        f->one.im[j] = paired ? grid[2 * j + 1] : 0;
    }
    const struct split z = transform(f);
    if (!paired) {
        for (size_t k = 0; k <= f->points / 2; k++)
            bins[k] = (struct bead_complex){z.re[k], z.im[k]};
        return;
    }
    bins[0] = of_pairs(z, 0, 0, f->turn[0]);
    for (size_t k = 1; k < n; k++)
        bins[k] = of_pairs(z, k, n - k, f->turn[k]);
    bins[n] = of_pairs(z, 0, 0, f->turn[n]);
}

/* The conjugate of the forward transform of the conjugates. */
INLINED void backward(const struct bead_fourier *f, const struct bead_complex *bins, double *grid)
{
    const size_t n = f->length, half = f->points / 2;
    const bool paired = n < f->points;
    for (size_t k = 0; k < n && !paired; k++) {
        f->one.re[k] = bins[k <= half ? k : n - k].re;
        f->one.im[k] = k <= half ? -bins[k].im : bins[n - k].im;
    }
    for (size_t k = 0; k < n && paired; k++) {
        const struct bead_complex a = bins[k], b = bins[half - k], turn = {f->turn[k].re, -f->turn[k].im};
        const struct bead_complex turned = bead_complex_times((struct bead_complex){a.re - b.re, a.im + b.im}, turn);
        f->one.re[k] = a.re + b.re - turned.im;
        f->one.im[k] = -(a.im - b.im + turned.re);
    }
    const struct split z = transform(f);
    for (size_t j = 0; j < n; j++) {
        grid[paired ? 2 * j : j] = z.re[j];
        if (paired)
            grid[2 * j + 1] = -z.im[j];
    }
}

/* AVX2 without fused multiply-adds: the same bits. */
#ifdef __x86_64__
#define WITH_AVX2 __attribute__((target("avx2")))
#else
#define WITH_AVX2
#endif

WITH_AVX2 static void forward_avx2(const struct bead_fourier *f, const double *grid, struct bead_complex *bins)
{
    forward(f, grid, bins);
}

WITH_AVX2 static void backward_avx2(const struct bead_fourier *f, const struct bead_complex *bins, double *grid)
{
    backward(f, bins, grid);
}

void bead_fourier_forward(struct bead_fourier *f, const double *grid, struct bead_complex *bins)
{
    if (f->avx2)
        forward_avx2(f, grid, bins);
    else
        forward(f, grid, bins);
}

void bead_fourier_backward(struct bead_fourier *f, const struct bead_complex *bins, double *grid)
{
    if (f->avx2)
        backward_avx2(f, bins, grid);
    else
        backward(f, bins, grid);
}
