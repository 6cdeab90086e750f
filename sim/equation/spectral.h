/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Real functions on a ring as their Fourier series: u(x_i) = sum over |j| <= modes of c_j exp(2 pi i j m / points), where only
 * c_0 .. c_modes are stored, as c_-j is the conjugate of c_j.
 *
 * 3 modes < points (Orszag's two-thirds rule, J. Atmos. Sci. 28, 1074 (1971)): squares computed on the grid have no aliases among
 * the modes kept, and integrals of cubes are exact. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"
#include "sim/equation/fourier.h"

struct bead_spectral {
    size_t points, modes;
    double *grid; /* [points]: values, scratch of both directions */
    struct bead_complex *bins;
    struct bead_fourier *fourier;
};

/* Errors: MEMORY. To be destroyed even after one. */
BEAD_CHECK enum bead_error bead_spectral_create(size_t points, struct bead_spectral *spectral, struct bead_message *msg);
void bead_spectral_destroy(struct bead_spectral *spectral);
/* c[0..modes] -> grid. */
void bead_spectral_to_grid(struct bead_spectral *spectral, const struct bead_complex *c);
/* grid -> c[0..modes]; overwrites the grid. */
void bead_spectral_to_modes(struct bead_spectral *spectral, struct bead_complex *c);
/* Value, and first and second derivative by the phase 2 pi x / length, of the series at a phase between grid points. */
void bead_spectral_at(const struct bead_complex *c, size_t modes, double phase, double value[3]);
/* The smallest even number >= n without prime factors above 5, for which transforms are fast. */
size_t bead_spectral_length(size_t n);
