/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coefficients of the methods: data with their sources. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Runge-Kutta-Nystrom for y'' = f(y): Y_i = y + c_i h y' + h^2 sum_j a_ij f_j,
 * y1 = y + h y' + h^2 sum b_i f_i, y1' = y' + h sum bp_i f_i; bpe: bp minus the embedded method's. */
struct bead_tableau {
    size_t stages;
    bool fsal;                          /* the last stage is the end of the step */
    const double *c, *a, *b, *bp, *bpe; /* a: stages x stages, row by row */
};

extern const struct bead_tableau bead_tableau_rkn6, bead_tableau_rkn8, bead_tableau_rkn12;

/* Symplectic compositions: alternating drifts u += d h v and kicks v += k h a(u). */
struct bead_composition {
    bool kick_first;
    size_t count; /* of coefficients, kicks and drifts together */
    const double *coefficient;
};

extern const struct bead_composition bead_composition_verlet;
