/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passing: when the first pulse is over at the end of the chain, so that plots show it whole. The end of runs without `until`. */
#ifndef BEADREEL_SIM_RUN_PASSING_H
#define BEADREEL_SIM_RUN_PASSING_H

#include "sim/run/front.h"

/* The last contact, and the bead of the last sensor with its two contacts: there the pulse is over when the force, less its static
 * part, falls below 5 % of its maximum so far, or has a minimum below half of that. A force that does neither does not keep a run
 * going: the time in which a wave passes 40 contacts, after the front's arrival, is all that it gets. */
enum { BEAD_PASSING_PLACES = 2 };
struct bead_passing {
    struct bead_passing_place {
        size_t contact[2], contacts;
        double most;   /* N, so far */
        double passed; /* s; NaN: not yet */
    } place[BEAD_PASSING_PLACES];
    size_t places;
    double patience; /* s, after the front's arrival */
    double time;     /* s: it is over everywhere; NaN before */
};

void bead_passing_begin(struct bead_passing *passing, const struct bead_chain *chain);
/* Look at the step just made, after bead_front_watch. */
void bead_passing_watch(struct bead_passing *passing, const struct bead_front *front, const struct bead_stepper *stepper);

#endif
