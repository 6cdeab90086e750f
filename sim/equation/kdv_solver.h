/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Korteweg-de Vries equation u_t + drift u_x + a u u_x + b u_xxx = 0 on a ring, by Fourier series and exponential time
 * differencing.
 *
 * The mean of u is kept apart: it only moves waves along, so it belongs to the linear part. Steps of the method ETDRK4 are as
 * long as the accuracy allows, by comparing one step with two halves every so often; a step whose numbers make no sense fails. */
#ifndef BEADREEL_SIM_EQUATION_KDV_SOLVER_H
#define BEADREEL_SIM_EQUATION_KDV_SOLVER_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/equation/equation.h"
#include "sim/equation/etd.h"
#include "sim/equation/spectral.h"

enum { BEAD_KDV_POINTS_MAX = 1 << 20 };

/* u at time 0 and place x of the domain; pulses and solitons with their images in the neighbouring periods. */
double bead_kdv_start(const struct bead_equation_spec *spec, double x);
/* Speed (less the drift) -> amplitude of a soliton: the thesis's Eq. 4. */
double bead_kdv_soliton_amplitude(const struct bead_equation_spec *spec, double speed);
/* 1 / width of the narrowest sech^2 that can appear, and the largest |u|. */
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
    bead_wide *omega;    /* of the modes */
    double *wave_number; /* of the modes */
    struct bead_kdv_state start, end;
    struct bead_etd_work work;
    struct bead_etd_row *rows, *half_rows, *other_rows; /* for steps of h, of h / 2, and of any other length */
    struct bead_complex *one, *two;                     /* results of the comparison of steps */
    double h, longest, tolerance;                       /* tolerance: of the error, relative, by the time it is made in */
    double end_of_run;
    bool fixed;      /* steps have the length that the scene gives */
    double momentum; /* sum of |u_j|^2 at the start */
    double tail;     /* largest so far: of the highest modes by the largest mode */
    double tail_limit;
    uint64_t steps, evaluations;
    void *memory;
};

/* Errors: MEMORY, NUMBERS. On failure there is nothing to destroy. */
BEAD_CHECK enum bead_error bead_kdv_create(const struct bead_motion_settings *settings, struct bead_kdv *kdv,
                                           struct bead_message *msg);
void bead_kdv_destroy(struct bead_kdv *kdv);
/* One step from end on. Errors: NUMBERS. */
BEAD_CHECK enum bead_error bead_kdv_step(struct bead_kdv *kdv, struct bead_message *msg);
/* u at a time of the last step into spectral.grid, by a step that ends there. */
void bead_kdv_values(struct bead_kdv *kdv, double t);

#endif
