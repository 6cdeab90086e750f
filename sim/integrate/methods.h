/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrators: one const row each; coefficients are data. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "sim/base/internal.h"

struct bead_method_info {
    const char *name;        /* as in scenes: "rkn8" */
    const char *description; /* one line with its source */
    int order;               /* for smooth forces */
    int evaluations;         /* of the force, per step */
    bool damping;            /* forces may depend on velocities */
    bool variable;           /* the step follows the state; else it is fixed */
    double theta;            /* step in units of 1/omega for peaks to 1e-6 */
    double theta_order;      /* theta ~ accuracy^(1/theta_order) */
    double theta_cap;        /* never more, whatever the accuracy */
    double theta_max;        /* largest stable step in units of 1/omega */
};

/* Row `index`, NULL after the last. */
BEAD_INTERNAL const struct bead_method_info *bead_method_info(size_t index);
BEAD_INTERNAL const struct bead_method_info *bead_method_find(const char *name);

/* Coefficients of the methods: data with their sources. */

/* Runge-Kutta-Nystrom for y'' = f(y): Y_i = y + c_i h y' + h^2 sum_j a_ij f_j,
 * y1 = y + h y' + h^2 sum b_i f_i, y1' = y' + h sum bp_i f_i; bpe: bp minus the embedded method's, NULL: there is none. For
 * y'' = f(y, y'), av is set: Y'_i = y' + h sum_j av_ij f_j. */
struct bead_tableau {
    size_t stages;
    bool fsal;                               /* the last stage is the end of the step */
    const double *c, *a, *b, *bp, *bpe, *av; /* a, av: stages x stages, row by row */
};

extern const struct bead_tableau bead_tableau_rkn6, bead_tableau_rkn8, bead_tableau_rkn12, bead_tableau_rk8;

/* Symplectic compositions: alternating drifts u += d h v and kicks v += k h a(u). */
struct bead_composition {
    bool kick_first;
    size_t count; /* of coefficients, kicks and drifts together */
    const double *coefficient;
};

extern const struct bead_composition bead_composition_verlet;
