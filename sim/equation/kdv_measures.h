/* What a run of the Korteweg-de Vries equation measures: its integrals, the return of the wave it began with, its solitons. */
#ifndef BEADREEL_SIM_EQUATION_KDV_MEASURES_H
#define BEADREEL_SIM_EQUATION_KDV_MEASURES_H

#include "sim/equation/kdv_solver.h"

/* Conserved: the integrals of u, u^2 and drift u^2 / 2 + a u^3 / 6 - b u_x^2 / 2. */
struct bead_kdv_integrals {
    double mass, momentum, hamiltonian;
};

/* |mode|^2 over time: its largest value after it was below a quarter of the start's. */
struct bead_kdv_watch {
    struct bead_kdv_integrals start;
    size_t mode; /* 0: none to watch */
    double first, before, rate_before, high, high_time;
    bool away;
};

void bead_kdv_integrals(const struct bead_kdv *kdv, struct bead_kdv_integrals *integrals);
void bead_kdv_watch_begin(struct bead_kdv_watch *watch, const struct bead_kdv *kdv);
void bead_kdv_watch_step(struct bead_kdv_watch *watch, const struct bead_kdv *kdv);
size_t bead_kdv_measures(const struct bead_kdv_watch *watch, const struct bead_kdv *kdv, struct bead_measure *measures,
                         size_t room);

#endif
