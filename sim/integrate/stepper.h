/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stepper: the state of one chain between two times, moved on by a method.
 *
 *   bead_stepper_create(chain, method, kernels, full, &stepper, &msg);
 *   while (...) bead_stepper_advance(stepper, h);     state at both ends of the step: stepper->start, ->end
 *   bead_stepper_destroy(stepper);
 *
 * Only beads 0..active-1 are touched: ahead of the front nothing moves, and beads out of reach of a step stay exactly at rest,
 * so the window changes no bit. */
#ifndef BEADREEL_SIM_INTEGRATE_STEPPER_H
#define BEADREEL_SIM_INTEGRATE_STEPPER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/methods.h"
#include "sim/chain/chain_data.h"
#include "sim/integrate/kernels.h"

enum { BEAD_STAGES_MAX = 17 };

/* State at one time. Arrays have an element behind the last bead, always 0 (the wall); f one before the first. */
struct bead_state {
    double *u; /* m */
    double *v; /* m/s */
    double *a; /* m/s^2 */
    double *f; /* N: contact forces less their static part; f[-1] is the constant force on the striker */
};

struct bead_method;
struct bead_events;

struct bead_stepper {
    const struct bead_chain *chain;
    const struct bead_method *method;
    const struct bead_kernels *kernels;
    bead_force_kernel force;
    bead_acceleration_kernel accelerate;
    const double *inverse_mass; /* what accelerate wants: inverse masses, or masses for the printed arithmetic */
    struct bead_contact_table table;
    size_t beads;
    size_t active;    /* beads that the step just made may have moved */
    size_t span;      /* the same in whole vectors: behind `active` all is 0, and stays so */
    bool full;        /* no window */
    double t0, t1, h; /* s: times of start and end, and the length of the step: t1 - t0 but for the rounding of times */
    struct bead_state start, end;
    /* Accelerations as the step comes to its end. Where a damped contact changes just there, forces and accelerations jump: end's
     * are those that the next step begins with. */
    const double *last_a;
    /* Stages of the step just made: accelerations and contact forces; [0] is start's. Valid up to `stages` for Nystrom methods. */
    double *stage_a[BEAD_STAGES_MAX + 1], *stage_f[BEAD_STAGES_MAX + 1];
    double *y, *w[3];            /* work */
    double *before_a;            /* what last_a points to where it is not end.a */
    uint64_t steps, evaluations; /* evaluations: contact forces computed */
    /* With damping, NULL without: contacts [beads] that are closed for the whole of the next step, and of the step just made. */
    unsigned char *closed, *was_closed;
    struct bead_events *events; /* the contact-event correction's own, NULL where the method has none */
    double event_tolerance;     /* m/s: events that cannot change a velocity by more are left alone; the owner may set it */
    double event_change;        /* largest change of a velocity in the last Picard sweep of this step, m/s: an error estimate */
    void *memory;
};

/* A method: what scenes may ask for, and how to step. */
struct bead_method {
    struct bead_method_info info;
    const struct bead_tableau *tableau;         /* Nystrom methods */
    const struct bead_composition *composition; /* symplectic methods */
    bool events;                                /* with the contact-event correction */
    /* From start to end over h; end.a and end.f are those of end.u (and end.v). */
    void (*step)(struct bead_stepper *stepper, double h);
};

const struct bead_method *bead_method_row(const char *name);

/* Whether forces depend on velocities. */
static inline bool bead_stepper_damped(const struct bead_stepper *stepper)
{
    return stepper->table.damping > 0;
}

/* Chain at rest, striker moving, at time 0. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stepper_create(const struct bead_chain *chain, const struct bead_method *method,
                                               const struct bead_kernels *kernels, bool full, struct bead_stepper **stepper,
                                               struct bead_message *msg);
void bead_stepper_destroy(struct bead_stepper *stepper);
/* Another stepper, whose end is the start of the last step of `stepper`: to repeat that step with shorter ones. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stepper_branch(const struct bead_stepper *stepper, struct bead_stepper **branch,
                                               struct bead_message *msg);
/* The old end becomes the start; one step to `t1` (> stepper->t1). */
void bead_stepper_advance(struct bead_stepper *stepper, double t1);
/* The same with the length given, so that equal steps are equal to the bit. */
void bead_stepper_advance_by(struct bead_stepper *stepper, double h, double t1);
/* The last step is undone: its start is the end again. Not twice in a row. */
void bead_stepper_take_back(struct bead_stepper *stepper);
/* Forces and accelerations of displacements u (and velocities v) in the active window. */
void bead_stepper_evaluate(struct bead_stepper *stepper, const double *u, const double *v, double *f, double *a);
/* The same for beads from..to - 1 (whole vectors, within the span); forces before them are there. Evaluations are not counted. */
struct bead_part {
    size_t from, to;
};
void bead_stepper_evaluate_part(const struct bead_stepper *stepper, const double *u, const double *v, double *f, double *a,
                                struct bead_part part);
/* Energy above the static state, J, and momentum, kg m/s, of a state. */
double bead_stepper_energy(const struct bead_stepper *stepper, const struct bead_state *state);
double bead_stepper_momentum(const struct bead_stepper *stepper, const struct bead_state *state);

/* step functions of the methods */
void bead_step_rk4(struct bead_stepper *stepper, double h);
void bead_step_nystrom(struct bead_stepper *stepper, double h);
void bead_step_composition(struct bead_stepper *stepper, double h);

#endif
