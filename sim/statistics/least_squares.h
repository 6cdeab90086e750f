/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares: the parameters that make the sum of the squares of residuals smallest, after Levenberg and Marquardt (J. J. More,
 * Lecture Notes in Mathematics 630, 105 (1978)), with their standard errors. Derivatives are central differences, whose steps
 * change the residuals by a thousandth of `size`: their own error is then a millionth, and rounding in a run to 1e-6 a thousandth,
 * of a standard error. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

struct bead_least_squares {
    size_t parameters, points;
    /* Residuals r [points] of parameters x. Several threads ask for different x at once. Errors: SCENE, NUMBERS (there are none for
     * this x), others end the search. */
    enum bead_error (*residuals)(const void *context, const double *x, double *r, struct bead_message *msg);
    const void *context;
    const char *const *names; /* [parameters], for messages */
    double size;              /* norm of what is fitted, > 0 */
    int threads;
    /* Results: */
    double *x;     /* [parameters]; before, the first guess */
    double *error; /* [parameters] standard errors, where the points' own errors are equal and independent */
    double rms;    /* square root of the sum of squares by (points - parameters) */
    size_t rounds;
};

/* Errors: MEMORY, NUMBERS (a parameter changes nothing, or does what others do; no minimum), those of `residuals`. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_least_squares(struct bead_least_squares *fit, struct bead_message *msg);
