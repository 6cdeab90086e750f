/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exponential time differencing for u' = i w u + N(u), mode by mode: exact for the linear part, of order four for N (Runge-Kutta).
 *
 * S. M. Cox, P. C. Matthews, J. Comput. Phys. 176, 430 (2002), Eq. 26-29; coefficients by their power series for small w h, where
 * the formulas cancel (A.-K. Kassam, L. N. Trefethen, SIAM J. Sci. Comput. 26, 1214 (2005)). */
#pragma once

#include "sim/base/elementary.h"
#include "sim/equation/spectral.h"

struct bead_etd_row {
    struct bead_complex whole, half; /* exp(i w h), exp(i w h / 2) */
    struct bead_complex q;           /* of the stages */
    struct bead_complex f1, f2, f3;  /* of the first, the two middle and the last evaluation */
};

/* N(u) of all modes. */
typedef void (*bead_etd_slope)(void *context, const struct bead_complex *u, struct bead_complex *slope);

struct bead_etd_work {
    struct bead_complex *a, *b, *slope[4]; /* [modes + 1] */
};

/* Rows for steps of h and the frequencies omega[0..modes], to a few units in the last place. */
void bead_etd_rows(const struct bead_pair *omega, size_t modes, double h, struct bead_etd_row *rows);
/* from -> to (may be the same) over one step; work->slope[0] must be N(from). */
void bead_etd_step(const struct bead_etd_row *rows, size_t modes, bead_etd_slope slope, void *context, struct bead_etd_work *work,
                   const struct bead_complex *from, struct bead_complex *to);
