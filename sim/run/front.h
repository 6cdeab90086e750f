/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Front: the time when the wave reaches the end of the chain. */
#pragma once

#include "sim/integrate/stepper.h"

/* The front has arrived when the last contact's force first exceeds 1e-4 of the largest contact force so far, both without their
 * static part. If beads other than the striker move at first, there is no front. */
struct bead_front {
    double arrival;       /* s; NaN before */
    double largest_force; /* N, of all contacts so far, including maxima within steps */
    size_t strongest;     /* contact with the largest force at the end of the last step */
};

/* Is it too late for the front to arrive? True if the last contact would get too little even from all the energy of the beads that
 * have not parted for good from those before them. With damping, which spreads a pulse, also if no contact has that much any more.
 * Never true with springs, precompression or a tilt. */
bool bead_front_is_lost(const struct bead_front *front, const struct bead_stepper *stepper);
/* Follows the last step. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_front_watch(struct bead_front *front, const struct bead_stepper *stepper, struct bead_message *msg);

/* Passing: the time when the first pulse is over at the end of the chain, so that plots show the whole pulse. Ends runs without
 * `until`. */

/* Two places count: the last contact, and the bead of the last sensor with its two contacts. The pulse is over when their force,
 * without its static part, falls below 5 % of its maximum so far, or has a minimum below 50 % of it; at the latest, after the
 * front's arrival, in the time that a wave needs for 40 contacts. */
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
