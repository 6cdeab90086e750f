/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watches a run of the breaking wave: the time at which it breaks, gains of energy, and oscillations. */
#pragma once

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
    double energy, energy_gained;           /* at the last step; the sum of all gains from step to step */
    double variation_start, variation_most; /* total variation of both invariants together */
    double breaking;                        /* time, last extrapolation; INFINITY: nothing steepens */
    uint64_t steps;
    double front;         /* cells of the steepest front at the start */
    bool broken;          /* a front is too steep for the grid */
    double *right, *left; /* [cells + 6] invariants, with three ghosts on both sides; borrowed */
};

void bead_shock_watch_begin(struct bead_shock_watch *watch, const struct bead_equation_spec *spec, size_t cells, double *scratch,
                            const struct bead_shock_state *state);
void bead_shock_watch_step(struct bead_shock_watch *watch, const struct bead_shock_state *state);
/* Part of the energy lost by the grid until time t, while the wave is smooth; 0 later, when shocks lose some, too. */
double bead_shock_lost(const struct bead_shock_watch *watch, double t);
size_t bead_shock_measures(const struct bead_shock_watch *watch, const struct bead_shock_state *state, struct bead_measure *to,
                           size_t room);
