/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Passing: the time when the first pulse is over at the end of the chain, so that plots show all of it. Ends runs without `until`.
 */
#pragma once

#include "sim/run/front.h"

/* Two places count: the last contact, and the bead of the last sensor with its two contacts. The pulse is over when their force,
 * without its static part, falls below 5 % of its maximum so far, or has a minimum below 50 % of it; at the latest, after the front
 * has arrived, in the time that a wave needs for 40 contacts. */
enum { BEAD_PASSING_PLACES = 2 };
struct bead_passing {
    struct bead_passing_place {
        size_t contact[2], contacts;
        double most;   /* N, so far */
        double passed; /* s; NaN: not yet */
    } place[BEAD_PASSING_PLACES];
    size_t places;
    double patience; /* s, after the front's arrival */
    double time;     /* s: over at all places; NaN before */
};

void bead_passing_begin(struct bead_passing *passing, const struct bead_chain *chain);
/* Follows the last step, after bead_front_watch. */
void bead_passing_watch(struct bead_passing *passing, const struct bead_front *front, const struct bead_stepper *stepper);
