/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequencies of small vibrations of masses in a row, between springs: eigenvalues w^2 of the symmetric matrix with
 * (K_{j-1} + K_j) / m_j on the diagonal (and the stiffness of what holds a mass at its place) and -K_j / sqrt(m_j m_{j+1}) beside
 * it, of an open row, or of a cell that repeats itself for ever with a phase q from one to the next.
 *
 * Bisection by the number of negative pivots: W. Barth, R. S. Martin, J. H. Wilkinson, Numer. Math. 9, 386 (1967); vectors by a
 * factorisation from both ends that meet where the residual is least: K. V. Fernando, SIAM J. Matrix Anal. Appl. 18, 1013 (1997).
 * LAPACK has no such matrix with a phase, and other bits with each BLAS that it is linked to. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

struct bead_jacobi {
    size_t count;
    double *diagonal, *beside; /* [count], 1/s^2; beside[count - 1]: from the last to the first of the next cell, 0: an open row */
    double bound;              /* no eigenvalue is larger */
};

/* `springs` [count] in N/m: spring j is behind mass j; the last one leads to the next cell, or, if `open`, to a wall. `held`
 * [count], N/m: springs that hold masses at their places; NULL: none. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_jacobi_create(const double *masses, const double *springs, const double *held, size_t count,
                                              bool open, struct bead_jacobi *matrix, struct bead_message *msg);
void bead_jacobi_free(struct bead_jacobi *matrix);
/* Frequency `index` (from 0, rising), Hz, at the phase whose cosine is given; an open row has none (1). To a few rounding errors of
 * the highest frequency's square: what is 0 within that is 0. In a cell of three or more, where its first beads alone, between
 * fixed neighbours, have the same frequency, to 1e-8 of itself. */
BEAD_INTERNAL double bead_jacobi_frequency(const struct bead_jacobi *matrix, size_t index, double cosine);
/* For an open row: the vector [count] of that frequency, of length 1, in sqrt(m) u. `work`: [2 count]. */
void bead_jacobi_vector(const struct bead_jacobi *matrix, double frequency, double *vector, double *work);
