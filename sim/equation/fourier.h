/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete Fourier transforms of any length, with sums and products in the same order on every machine, so that results have the
 * same bits. Those of a library may use fused multiply-adds on one processor but not on another.
 *
 * Self-sorting (Stockham), with radices 4, 2 and the other prime factors p of the length, at a cost of p each: T. G. Stockham,
 * AFIPS Conf. Proc. 28, 229 (1966). Pairs of real numbers are transformed as complex ones. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"

struct bead_complex {
    double re, im;
};

static inline struct bead_complex bead_complex_times(struct bead_complex a, struct bead_complex b)
{
    return (struct bead_complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

struct bead_fourier;

/* For `points` >= 2 real numbers. `set`: NULL, or "portable" for a computation without AVX2, to the same bits. On failure *fourier
 * is NULL. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_fourier_create(size_t points, const char *set, struct bead_fourier **fourier,
                                               struct bead_message *msg);
void bead_fourier_destroy(struct bead_fourier *fourier); /* NULL is allowed */
/* bins[k] = sum over j of grid[j] exp(-2 pi i j k / points), k = 0 .. points / 2. */
void bead_fourier_forward(struct bead_fourier *fourier, const double *grid, struct bead_complex *bins);
/* grid[j] = sum over all k of bins[k] exp(2 pi i j k / points); bins above points / 2 are the conjugates of the others. */
void bead_fourier_backward(struct bead_fourier *fourier, const struct bead_complex *bins, double *grid);
