/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the ends of a step: Hermite interpolation. */
#ifndef BEADREEL_SIM_INTEGRATE_DENSE_H
#define BEADREEL_SIM_INTEGRATE_DENSE_H

#include <stddef.h>

#include "sim/integrate/branch_points.h"
#include "sim/integrate/polynomial.h"
#include "sim/integrate/stepper.h"

/* Third derivatives of the displacements at both ends of a step, and its branch points, found when a state between them is first
 * asked for, and kept. */
struct bead_dense {
    double *memory, *jerk[2];         /* [beads] m/s^3, at start and end of step `step` */
    double *rate;                     /* work */
    uint64_t step;                    /* 0: none */
    struct bead_branch_points points; /* of step `points_step` */
    uint64_t points_step;
    bool septic; /* forces follow from displacements alone */
};
/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_dense_create(const struct bead_stepper *stepper, struct bead_dense *dense,
                                             struct bead_message *msg);
void bead_dense_destroy(struct bead_dense *dense);
/* u and v of beads 0..active-1 at time t in [t0, t1] by septic Hermite from u and its three derivatives at both ends, put right
 * where contacts open or close (quintic, without the third derivative, where there is damping: steps end at contact events then);
 * exactly the state itself at the ends. Arrays like those of struct bead_state. */
void bead_dense_state(struct bead_dense *dense, const struct bead_stepper *stepper, double t, double *u, double *v);

/* The septic alone, for the displacements of a part of these beads, at time t0 + x h; only where there is no damping. */
void bead_dense_displacement(struct bead_dense *dense, const struct bead_stepper *stepper, double x, struct bead_part part,
                             double *u);

/* Compression of contact k over the step by septic Hermite from d, d', d'', d''' at both ends; with damping quintic, without d'''.
 */
struct bead_polynomial bead_dense_compression(const struct bead_stepper *stepper, size_t k);

/* d/dt of the force of contact k in a state, N/s. */
double bead_dense_force_rate(const struct bead_stepper *stepper, const struct bead_state *state, size_t k);

#endif
