/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Korteweg-de Vries equation u_t + drift u_x + a u u_x + b u_xxx = 0 on a ring, by Fourier series and exponential time
 * differencing.
 *
 * The mean of u is stored apart: it only carries waves along, so it belongs to the linear part. Steps of the method ETDRK4 are as
 * long as the accuracy allows; from time to time one step is compared with two of half the length. A step with absurd results
 * fails. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "sim/equation/equation.h"
#include "sim/equation/etd.h"
#include "sim/equation/spectral.h"

enum { BEAD_KDV_POINTS_MAX = 1 << 20 };

/* Speed (less the drift) -> amplitude of a soliton: the thesis's Eq. 4. */
double bead_kdv_soliton_amplitude(const struct bead_equation_spec *spec, double speed);
/* 1 / width of the narrowest possible sech^2, and the largest possible |u|. */
double bead_kdv_sharpest(const struct bead_equation_spec *spec);
double bead_kdv_highest(const struct bead_equation_spec *spec);
/* Grid points for the accuracy. */
size_t bead_kdv_points(const struct bead_equation_spec *spec, double accuracy);

/* u without its mean, and its N, at one time. */
struct bead_kdv_state {
    double t;
    struct bead_complex *u, *slope;
};

struct bead_kdv {
    const struct bead_equation_spec *spec;
    struct bead_spectral spectral;
    double mean;
    struct bead_pair *omega; /* of the modes */
    double *wave_number;     /* of the modes */
    struct bead_kdv_state start, end;
    struct bead_etd_work work;
    struct bead_etd_row *rows, *half_rows, *other_rows; /* for steps of h, of h / 2, and of any other length */
    struct bead_complex *one, *two;                     /* results of the comparison of steps */
    double h, longest, tolerance;                       /* tolerance: relative error allowed per unit of time */
    double end_of_run;
    bool fixed;      /* the scene gives the step */
    double momentum; /* sum of |u_j|^2 at the start */
    double tail;     /* largest so far: ratio of the highest modes to the largest mode */
    double tail_limit;
    uint64_t steps, evaluations;
    void *memory;
};

/* Errors: MEMORY, NUMBERS. To be destroyed even after one. */
BEAD_CHECK enum bead_error bead_kdv_create(const struct bead_motion_settings *settings, struct bead_kdv *kdv,
                                           struct bead_message *msg);
void bead_kdv_destroy(struct bead_kdv *kdv);
/* Make one step. Errors: NUMBERS. */
BEAD_CHECK enum bead_error bead_kdv_step(struct bead_kdv *kdv, struct bead_message *msg);
/* u, with its mean, from its modes; in spectral.grid. */
const double *bead_kdv_grid(const struct bead_kdv *kdv, const struct bead_complex *modes);
/* Write u at a time within the last step into spectral.grid, by a step that ends there. */
void bead_kdv_values(struct bead_kdv *kdv, double t);
