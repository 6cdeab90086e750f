/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the contact-event correction share, see events.h. */
#ifndef BEADREEL_SIM_INTEGRATE_EVENTS_PRIVATE_H
#define BEADREEL_SIM_INTEGRATE_EVENTS_PRIVATE_H

#include "sim/integrate/events.h"
#include "sim/integrate/events_kinks.h"
#include "sim/integrate/events_patch.h"
#include "sim/integrate/stepper.h"

/* Elements before and behind the constants of the contacts: vectors may begin one before the first and end behind the last. */
enum { BEAD_EVENTS_MARGIN = 16, BEAD_EVENTS_LANES = 8 };
/* Contacts whose compressions are kept at a time: a multiple of 8, few enough for the cache. */
enum { BEAD_EVENTS_BLOCK = 1024 };
/* A branch point further outside the step than this does no harm that doubles can hold. */
#define BEAD_EVENTS_REACH 2.0

struct bead_events {
    struct bead_patch_rule rule;
    /* Constants of the contacts, 0 in the margins but for "contact -1", the constant force on the striker. */
    double *constants, *stiffness, *static_compression, *static_force, *inverse_mass, *hardness;
    struct bead_event_speeds speeds;
    struct bead_event_flags flags; /* d0 to r1: of one block of contacts only */
    double *block;
    size_t flagged_count, flag_room;
    bool kinks_known; /* method and law are those that kinks are known for */
    struct bead_kink_method method;
    struct bead_kinks kinks; /* those of the flagged contacts */
    struct bead_patch patch;
    struct bead_patch_source source;
    struct bead_patch_branch *branch; /* in order of s */
    size_t branch_room, branch_count;
    /* Bounds over the chain: of A/m times the weights, and of the rate of a compression that the energy allows, m/s (0: not known).
     */
    double hardest, fastest;
    double unit; /* m/s: the striker's velocity */
    struct bead_event_limits limits;
    double limits_h; /* s: length of the longest steps that they are for */
    bool failed;
};

/* Room for `count` elements of `size` bytes in an array that keeps what it has. */
bool bead_events_grow(void **array, size_t *room, size_t count, size_t size);
/* Bounds of the chain, before the first step. */
void bead_events_bound(struct bead_events *events, const struct bead_stepper *stepper);
/* The contacts that the step just made, which `source` describes, has to be corrected for, and their kinks. False: memory is short.
 */
bool bead_events_flag(struct bead_events *events, const struct bead_stepper *stepper);

#endif
