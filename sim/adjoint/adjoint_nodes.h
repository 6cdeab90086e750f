/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adjoint nodes: stiffnesses of a chain at the nodes of a backward step, and derivatives of forces by their coefficients.
 *
 * States within a step are those of dense output, corrected where a contact opens or closes. At the nodes, the stiffness of such a
 * contact is the value of a polynomial with the moments of the stiffness over the step, so that quadratures of smooth functions do
 * not see the branch point. */
#pragma once

#include "sim/adjoint/record.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/methods.h"

enum { BEAD_NODES = 8 }; /* evaluations of the method, without the one at the end of a step */

/* A branch point: a contact opens or closes, or nearly does. */
struct bead_adjoint_point {
    size_t contact;
    double at;     /* in steps from the start */
    double weight; /* h^2 K/m of the stiffness at the distance of one step */
};

/* Arrays of contacts or beads have room for whole vectors, also before them. */
struct bead_adjoint_nodes {
    const struct bead_tableau *method;
    const struct bead_record *record;
    struct bead_stepper *stepper; /* set to the current step */
    struct bead_dense dense;
    struct bead_adjoint_point *point; /* of the current step, in order of contacts */
    size_t points, point_room;
    bool has_static;
    double *inverse_mass, *static_stiffness; /* 1/kg; N/m of the contacts at rest */
    double *u;                               /* work */
    /* At the nodes: */
    double *force[BEAD_NODES], *acceleration[BEAD_NODES]; /* N, less the static part; m/s^2 */
    double *stiffness[BEAD_NODES];                        /* N/m */
    double *by_stiffness[BEAD_NODES]; /* N: A df/dA at constant static force; without static forces the forces themselves */
    double *by_static[BEAD_NODES];    /* df/dF; only with static forces */
    void *memory;
};

/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_adjoint_nodes_create(const struct bead_chain *chain, const struct bead_record *record,
                                                     const struct bead_kernels *kernels, struct bead_adjoint_nodes *nodes,
                                                     struct bead_message *msg);
void bead_adjoint_nodes_destroy(struct bead_adjoint_nodes *nodes);
/* Moves to a step of the record, and finds the contacts that open or close in a part of the chain. */
BEAD_CHECK enum bead_error bead_adjoint_nodes_load(struct bead_adjoint_nodes *nodes, size_t step, struct bead_part part,
                                                   struct bead_message *msg);
/* Fills the arrays of the nodes from x = `from` of the step down to `back`, for a part of the beads in whole vectors. The
 * acceleration of the first one lacks the force before it. */
void bead_adjoint_nodes_fill(struct bead_adjoint_nodes *nodes, double from, double back, struct bead_part part);
/* The x to go back to from x = `from`: the start of the step, 0, or earlier, so that the branch point of a contact heavier than
 * `heavy` has a separate short part. */
double bead_adjoint_nodes_part(const struct bead_adjoint_nodes *nodes, double from, double heavy, struct bead_part part);
/* The compression of a contact over the step. */
struct bead_adjoint_curve {
    size_t contact;
    struct bead_polynomial compression; /* as interpolated */
};
struct bead_adjoint_curve bead_adjoint_curve(const struct bead_adjoint_nodes *nodes, size_t contact);
/* Compression d[0], m, and its derivative d[1] by x. */
void bead_adjoint_compression(const struct bead_adjoint_nodes *nodes, const struct bead_adjoint_curve *curve, double x,
                              double d[2]);
/* Length of an array, in doubles, and offset of its element 0. */
size_t bead_adjoint_padded(const struct bead_chain *chain);
enum { BEAD_ADJOINT_MARGIN = 16 };
