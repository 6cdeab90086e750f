/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run of the breaking wave watches: when it breaks, and that it neither gains energy nor oscillates. */
#ifndef BEADREEL_SIM_EQUATION_SHOCK_WATCH_H
#define BEADREEL_SIM_EQUATION_SHOCK_WATCH_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/equation/equation.h"

/* One state: means over the cells. */
struct bead_shock_state {
    double t;
    double *r, *v, *r_rate, *v_rate; /* [cells] */
};

struct bead_shock_totals {
    double mass, momentum, energy; /* integrals of r, v and the energy */
};

struct bead_shock_watch {
    const struct bead_equation_spec *spec;
    size_t cells;
    double dx;
    struct bead_shock_totals start;
    double energy, energy_gained;           /* the last; the sum of all growth from step to step */
    double variation_start, variation_most; /* sum of those of both invariants */
    double breaking;                        /* time, as last extrapolated; INFINITY: nothing steepens */
    uint64_t steps;
    double front;         /* cells of the steepest at the start */
    bool broken;          /* a front has become too steep for the grid to tell more */
    double *right, *left; /* [cells + 4] invariants with two ghosts on both sides: borrowed scratch */
};

void bead_shock_watch_begin(struct bead_shock_watch *watch, const struct bead_equation_spec *spec, size_t cells, double *scratch,
                            const struct bead_shock_state *state);
void bead_shock_watch_step(struct bead_shock_watch *watch, const struct bead_shock_state *state);
/* Part of the energy that the grid has lost by time t, while the wave is smooth; 0 later, when shocks take some. */
double bead_shock_lost(const struct bead_shock_watch *watch, double t);
size_t bead_shock_measures(const struct bead_shock_watch *watch, const struct bead_shock_state *state, struct bead_measure *to,
                           size_t room);

#endif
