/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What adjoints need of a chain at the nodes of a step, going back: stiffnesses, and what the forces owe to their coefficients.
 *
 * States between the ends of a step are those of dense output, put right where a contact opens or closes. At the nodes the
 * stiffness of such a contact is the value of a polynomial that has, over the step, the moments of the stiffness itself, so that
 * quadratures of smooth functions do not see the branch point. */
#ifndef BEADREEL_SIM_ADJOINT_ADJOINT_NODES_H
#define BEADREEL_SIM_ADJOINT_ADJOINT_NODES_H

#include "sim/adjoint/record.h"
#include "sim/integrate/branch_points.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/tableau.h"

enum { BEAD_NODES = 8 }; /* evaluations of the method in a step that does not end with one */

/* All arrays are those of contacts or beads with room for whole vectors, before them too. */
struct bead_adjoint_nodes {
    const struct bead_tableau *method;
    const struct bead_record *record;
    struct bead_stepper *stepper; /* set to the step at hand */
    struct bead_dense dense;
    struct bead_branch_points branches; /* in order of contacts */
    bool has_static;
    double *inverse_mass, *static_stiffness; /* 1/kg; N/m of the contacts at rest */
    double *u;                               /* work */
    /* At the nodes: */
    double *force[BEAD_NODES], *acceleration[BEAD_NODES]; /* N, less the static part; m/s^2 */
    double *stiffness[BEAD_NODES];                        /* N/m */
    double *by_stiffness[BEAD_NODES]; /* N: A df/dA, the static force kept; the forces themselves where there are no static ones */
    double *by_static[BEAD_NODES];    /* df/dF; only where there are static forces */
    void *memory;
};

/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_adjoint_nodes_create(const struct bead_chain *chain, const struct bead_record *record,
                                                     const struct bead_kernels *kernels, struct bead_adjoint_nodes *nodes,
                                                     struct bead_message *msg);
void bead_adjoint_nodes_destroy(struct bead_adjoint_nodes *nodes);
/* Set to a step of the record, and find what opens or closes in a part of the chain. */
void bead_adjoint_nodes_load(struct bead_adjoint_nodes *nodes, size_t step, struct bead_part part);
/* Fill the arrays of the nodes from x = `from` of the step down to `back`, for a part of the beads, whole vectors. The
 * acceleration of its first bead is without the force before it. */
void bead_adjoint_nodes_fill(struct bead_adjoint_nodes *nodes, double from, double back, struct bead_part part);
/* Where to go back to from x = `from`: the start of the step, 0, or a place before it such that the branch point of a contact of
 * more weight than `heavy` lies in a short part of its own. */
double bead_adjoint_nodes_part(const struct bead_adjoint_nodes *nodes, double from, double heavy, struct bead_part part);
/* The compression of a contact over the step. */
struct bead_adjoint_curve {
    size_t contact;
    struct bead_polynomial compression; /* as interpolated */
    struct bead_branch_range near;      /* its own branch points and those of its neighbours */
};
struct bead_adjoint_curve bead_adjoint_curve(const struct bead_adjoint_nodes *nodes, size_t contact);
/* Compression d[0], m, and its derivative d[1] by x. */
void bead_adjoint_compression(const struct bead_adjoint_nodes *nodes, const struct bead_adjoint_curve *curve, double x,
                              double d[2]);
/* Doubles of an array, and where its element 0 is. */
size_t bead_adjoint_padded(const struct bead_chain *chain);
enum { BEAD_ADJOINT_MARGIN = 16 };

#endif
