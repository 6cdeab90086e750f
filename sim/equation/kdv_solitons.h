/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solitons of the Korteweg-de Vries equation: which crest is which, followed from the start through their collisions. */
#ifndef BEADREEL_SIM_EQUATION_KDV_SOLITONS_H
#define BEADREEL_SIM_EQUATION_KDV_SOLITONS_H

#include "sim/equation/kdv_solver.h"

struct bead_kdv_crest {
    double at, height; /* at: place, the ring unrolled */
};

/* Each soliton as it was last seen, at time t. */
struct bead_kdv_solitons {
    struct {
        struct bead_kdv_crest crest;
        double t;
    } seen[BEAD_SOLITONS];
    double next; /* time to look again */
};

/* As the scene places them; at a time 0. */
void bead_kdv_solitons_begin(struct bead_kdv_solitons *solitons, const struct bead_equation_spec *spec);
/* Look where they are at the end of the step just made, if it is time to. */
void bead_kdv_solitons_watch(struct bead_kdv_solitons *solitons, const struct bead_kdv *kdv);
/* Their places, amplitudes and shifts behind the `count` measures that are there, of those that can be told at this moment; returns
 * how many measures there are then. */
size_t bead_kdv_soliton_measures(const struct bead_kdv_solitons *solitons, const struct bead_kdv *kdv, struct bead_measure *to,
                                 size_t count, size_t room);

/* Values of u on the grid, in the solver's scratch memory. */
const double *bead_kdv_grid(const struct bead_kdv *kdv);
/* Is point i of u a crest? */
bool bead_kdv_is_crest(const double *u, size_t points, size_t i);

#endif
