/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense output: Hermite interpolation between the ends of a step. */
#pragma once

#include <stddef.h>

#include "sim/integrate/between.h"
#include "sim/integrate/polynomial.h"
#include "sim/integrate/stepper.h"

/* Third derivatives of the displacements at both ends of a step, and its branch points, found with the first interpolated state and
 * kept. */
struct bead_dense {
    double *memory, *jerk[2];     /* [beads] m/s^3, at start and end of step `step` */
    double *rate;                 /* work */
    uint64_t step;                /* 0: none */
    struct bead_between *between; /* of step `between_step` */
    uint64_t between_step;
    bool septic; /* forces depend on displacements only */
};
/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_dense_create(const struct bead_stepper *stepper, struct bead_dense *dense,
                                             struct bead_message *msg);
void bead_dense_destroy(struct bead_dense *dense);
/* Interpolates u and v of beads 0..active-1 at time t in [t0, t1]: septic Hermite from u and its three derivatives at both ends,
 * corrected where contacts open or close; with damping quintic, without the third derivative, because steps end at contact events.
 * At the ends exactly the state itself. Arrays like those of struct bead_state. */
void bead_dense_state(struct bead_dense *dense, const struct bead_stepper *stepper, double t, double *u, double *v);

/* Displacements of a part of these beads at time t0 + x h from the septic alone; not with damping. */
void bead_dense_displacement(struct bead_dense *dense, const struct bead_stepper *stepper, double x, struct bead_part part,
                             double *u);

/* Finds the contact events of the last step, once, for corrections by dense->between. */
void bead_dense_find_events(struct bead_dense *dense, const struct bead_stepper *stepper);
/* Compression of contact k over the step: septic Hermite from d, d', d'', d''' at both ends; with damping quintic, without d'''. */
struct bead_polynomial bead_dense_compression(const struct bead_stepper *stepper, size_t k);
/* Displacement of bead j over the step in the same way. */
struct bead_polynomial bead_dense_bead(const struct bead_stepper *stepper, size_t j);

/* Rate of the force of contact k in a state, N/s. */
double bead_dense_force_rate(const struct bead_stepper *stepper, const struct bead_state *state, size_t k);
