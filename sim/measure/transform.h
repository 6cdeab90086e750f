/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transforms of windowed segments, for spectra. */
#pragma once

#include "beadreel/scene.h"
#include "sim/equation/fourier.h"

struct bead_transform {
    struct bead_fourier *fourier;
    size_t points, bins;
    double *window, *grid, sum; /* sum: of the window */
    struct bead_complex *found; /* [bins] */
};

/* The largest 2^a 3^b 5^c up to n: other lengths would take their largest prime factor times as long. */
size_t bead_transform_length(size_t n);
/* Errors: MEMORY; the transform is to be freed all the same. */
BEAD_CHECK enum bead_error bead_transform_make(struct bead_transform *transform, size_t points, enum bead_taper window,
                                               struct bead_message *msg);
void bead_transform_free(struct bead_transform *transform);
/* Fills `found`. Subtracts the mean of the values, weighted by the window. */
void bead_transform_segment(struct bead_transform *transform, const double *values);
/* The highest frequency at which a curve has BEAD_TRANSFORM_LEAST of its largest amplitude, Hz. Errors: MEMORY. */
#define BEAD_TRANSFORM_LEAST 1e-3
BEAD_CHECK enum bead_error bead_transform_reach(const double *values, size_t count, double every, double *reach,
                                                struct bead_message *msg);

static inline double bead_complex_square(struct bead_complex z)
{
    return z.re * z.re + z.im * z.im;
}

/* 2 if another bin has an equal part of the signal, else 1, for 0 and Nyquist's. */
static inline double bead_transform_twice(const struct bead_transform *transform, size_t bin)
{
    return bin == 0 || 2 * bin == transform->points ? 1 : 2;
}
