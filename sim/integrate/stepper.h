/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stepper: the state of one chain at both ends of a step, advanced by a method.
 *
 *   bead_stepper_create(chain, method, kernels, full, &stepper, &msg);
 *   while (...) bead_stepper_advance(stepper, t);     states at both ends of the step: stepper->start, ->end
 *   bead_stepper_destroy(stepper);
 *
 * Only beads first..active-1 are touched: nothing moves ahead of the front, and beads out of reach of a step stay exactly at rest,
 * so the window does not change a bit of the results. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "sim/chain/chain_data.h"
#include "sim/chain/drive.h"
#include "sim/integrate/kernels.h"
#include "sim/integrate/methods.h"

enum { BEAD_STAGES_MAX = 17 };

/* State at one time. Arrays have an element after the last bead, always 0 (the wall); f has one before the first. */
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
    bool fused;                 /* Hertz's law without static forces: kernels find forces and accelerations in one loop */
    const double *inverse_mass; /* for accelerate: inverse masses, or masses for the printed arithmetic */
    const double *pull;         /* [beads] 1/s^2: stiffness of the springs that hold beads in place, over mass; NULL: none */
    struct bead_contact_table table;
    size_t beads;
    size_t active;    /* beads that the last step may have moved */
    size_t span;      /* `active` rounded up to whole vectors: the beads in between are at rest */
    size_t first;     /* beads before this one have been dropped; whole vectors */
    bool damped;      /* forces depend on velocities */
    bool full;        /* no window */
    size_t driven;    /* bead with a drive; SIZE_MAX: none */
    double now;       /* s: time of the stage that is being evaluated, for drives */
    double t0, t1, h; /* s: times of start and end, and the length of the step: t1 - t0 except for the rounding of times */
    struct bead_state start, end;
    /* Accelerations just before the end of the step. If a damped contact closes or opens there, forces and accelerations jump, and
     * those of `end` begin the next step. */
    const double *last_a;
    /* Stages of the last step: accelerations and contact forces; [0] is unused: start's. Valid up to `stages` for Nystrom methods.
     */
    double *stage_a[BEAD_STAGES_MAX + 1], *stage_f[BEAD_STAGES_MAX + 1];
    double *y, *w[3];            /* work */
    double *before_a;            /* memory of last_a if that is not end.a */
    uint64_t steps, evaluations; /* evaluations: contact forces computed */
    /* With damping, else NULL: contacts [beads] that are closed for the whole of the next step, and of the last one. */
    unsigned char *closed, *was_closed;
    struct bead_events *events; /* contact-event correction; NULL if the method has none */
    double event_tolerance;     /* m/s: events that cannot change a velocity by more are left alone; the owner may set it */
    double event_change;        /* largest change of a velocity in the last Picard sweep of this step, m/s: an error estimate */
    void *memory;
};

/* The quadrature on 0..1 with which a step integrates a force known over it; exact for polynomials of lower degree than its
 * order. */
struct bead_quadrature {
    size_t nodes;
    int order;
    const double *node, *weight;
};

struct bead_method {
    struct bead_method_info info;
    /* Steps from start to end over h; end.a and end.f follow from end.u (and end.v). */
    void (*step)(struct bead_stepper *stepper, double h);
    const struct bead_tableau *tableau;         /* of Nystrom methods */
    const struct bead_composition *composition; /* of symplectic methods */
    struct bead_quadrature quadrature;          /* of methods for damping */
    bool events;                                /* with the contact-event correction */
};

const struct bead_method *bead_method_row(const char *name);

/* True if forces depend on velocities. */
static inline bool bead_stepper_damped(const struct bead_stepper *stepper)
{
    return stepper->damped;
}

/* Contacts in the active window. */
static inline size_t bead_stepper_contacts(const struct bead_stepper *stepper)
{
    return stepper->active < stepper->chain->contacts ? stepper->active : stepper->chain->contacts;
}

/* Compression of contact k in a state, m. */
static inline double bead_stepper_compression(const struct bead_stepper *stepper, const struct bead_state *state, size_t k)
{
    return stepper->table.static_compression[k] + (state->u[k] - state->u[k + 1]);
}

/* Force of bead j in a state, N: the mean of its two contact forces, with their static part. */
static inline double bead_stepper_bead_force(const struct bead_stepper *stepper, const struct bead_state *state, size_t j)
{
    const double *still = stepper->chain->static_force;
    return 0.5 * ((j > 0 ? state->f[j - 1] + still[j - 1] : 0) + (j < stepper->chain->contacts ? state->f[j] + still[j] : 0));
}

/* The chain at the start: at rest except for the striker and whatever else the scene moves. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stepper_create(const struct bead_chain *chain, const struct bead_method *method,
                                               const struct bead_kernels *kernels, bool full, struct bead_stepper **stepper,
                                               struct bead_message *msg);
void bead_stepper_destroy(struct bead_stepper *stepper);
/* Drops the beads before `first`, rounded down to whole vectors: they no longer move, and push no more. Only for `fused` forces. */
void bead_stepper_drop(struct bead_stepper *stepper, size_t first);
/* Creates another stepper, whose end is the start of the last step of `stepper`, to repeat that step with shorter ones. Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error bead_stepper_branch(const struct bead_stepper *stepper, struct bead_stepper **branch,
                                               struct bead_message *msg);
/* Makes one step to `t1` (> stepper->t1). */
void bead_stepper_advance(struct bead_stepper *stepper, double t1);
/* As above with a given length, so that equal steps are equal to the bit. */
void bead_stepper_advance_by(struct bead_stepper *stepper, double h, double t1);
/* Undoes the last step; not twice in a row. */
void bead_stepper_take_back(struct bead_stepper *stepper);
/* Finds forces and accelerations at displacements u (and velocities v) in the active window. */
void bead_stepper_evaluate(struct bead_stepper *stepper, const double *u, const double *v, double *f, double *a);
/* As above for beads from..to - 1 (whole vectors within the span), if the force before them is known. Counts no evaluations. */
struct bead_part {
    size_t from, to;
};
void bead_stepper_evaluate_part(const struct bead_stepper *stepper, const double *u, const double *v, double *f, double *a,
                                struct bead_part part);
/* Adds the accelerations of beads from..to - 1 from springs that hold them in place, an absorbing end, and the drive at time `now`.
 * v may be NULL where nothing depends on velocities. */
static inline void bead_stepper_pull(const struct bead_stepper *stepper, const double *u, const double *v, double *a,
                                     struct bead_part part)
{
    const size_t last = stepper->beads - 1;
    if (stepper->chain->end.coefficient > 0 && last >= part.from && last < part.to)
        a[last] -= bead_dashpot_force(&stepper->chain->end, v[last]) * stepper->chain->inverse_mass[last];
    for (size_t j = part.from; stepper->pull && j < part.to; j++)
        a[j] -= stepper->pull[j] * u[j];
    if (stepper->driven >= part.from && stepper->driven < part.to)
        bead_drive_apply(stepper->chain, stepper->now, 0, a);
}
/* State at stage i of the last step of a Runge-Kutta method, with an element after the last bead. Returns the weight of the stage
 * in integrals over the step; if that is 0, there is no state. */
double bead_stage_state(const struct bead_stepper *stepper, size_t i, double *u, double *v);
/* Energy relative to the static state, J, and momentum, kg m/s. */
double bead_stepper_energy(const struct bead_stepper *stepper, const struct bead_state *state);
double bead_stepper_momentum(const struct bead_stepper *stepper, const struct bead_state *state);

/* Error estimate from the embedded method: largest |h sum bpe_i a_i| of the last step, m/s: the difference from the method of lower
 * order, and so an upper bound of the step's error if forces are smooth. Excludes beads at contacts that open or close, whose
 * quadrature is replaced (events.h). 0 for methods without an embedded one. */
double bead_nystrom_error(const struct bead_stepper *stepper);
