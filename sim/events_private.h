/* What the files of the contact-event correction share, see events.h. */
#ifndef BEADREEL_SIM_EVENTS_PRIVATE_H
#define BEADREEL_SIM_EVENTS_PRIVATE_H

#include "sim/events.h"
#include "sim/events_kinks.h"
#include "sim/events_patch.h"
#include "sim/stepper.h"

/* Elements before and behind the constants of the contacts: vectors may begin one before the first and end behind the last. */
enum { BEAD_EVENTS_MARGIN = 16, BEAD_EVENTS_LANES = 8 };
/* A branch point further outside the step than this does no harm that doubles can hold. */
#define BEAD_EVENTS_REACH 2.0

struct bead_events {
    struct bead_patch_rule rule;
    /* Constants of the contacts, 0 in the margins but for "contact -1", the constant force on the striker. */
    double *constants, *stiffness, *static_compression, *static_force, *inverse_mass, *hardness;
    double *effect; /* m/s, of the flagged ones: what they do to a velocity, at most */
    size_t effect_room;
    unsigned char *mark; /* a byte a contact, whole words */
    size_t *flagged, flagged_room, flagged_count;
    bool kinks_known;       /* method and law are those that kinks are known for */
    struct bead_kink *kink; /* those of this step, in order of contacts */
    size_t kink_room;
    struct bead_patch patch;
    struct bead_patch_source source;
    struct bead_patch_branch *branch; /* in order of s */
    size_t branch_room, branch_count;
    /* Bounds over the chain: of A/m, and of the rate of a compression that the energy allows, m/s (0: not known). */
    double hardest, fastest;
    double reach, reach_h, reach_tolerance; /* how far outside a step of length reach_h a branch point may matter */
    bool failed;
};

/* Room for `count` elements of `size` bytes in an array that keeps what it has. */
bool bead_events_grow(void **array, size_t *room, size_t count, size_t size);
/* Bounds of the chain, before the first step. */
void bead_events_bound(struct bead_events *events, const struct bead_stepper *stepper);
/* The contacts that the step just made has to be corrected for. False: memory is short. */
bool bead_events_flag(struct bead_events *events, const struct bead_stepper *stepper);
/* Whether contact k opens or closes, with a rate at one end of the step at least that says so. */
bool bead_events_simple(const struct bead_events *events, const struct bead_stepper *stepper, size_t contact);

#endif
