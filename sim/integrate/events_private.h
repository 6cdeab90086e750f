/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Declarations shared by the files of the contact-event correction: see events.h. */
#pragma once

#include "sim/integrate/events.h"
#include "sim/integrate/events_kinks.h"
#include "sim/integrate/events_patch.h"
#include "sim/integrate/stepper.h"

/* Elements before and after the constants of the contacts: vectors may begin one before the first and end after the last. */
enum { BEAD_EVENTS_MARGIN = 16, BEAD_EVENTS_LANES = 8 };
/* Maxima for a patch: flagged contacts (the cost grows with their square; longer patches are cut and lose a little accuracy);
 * contacts integrated again on each side of a flagged one; all contacts. */
enum { BEAD_PATCH_FLAGGED = 64, BEAD_PATCH_WIDTH = 1, BEAD_PATCH_MOST = BEAD_PATCH_FLAGGED * (2 * BEAD_PATCH_WIDTH + 1) };
/* Steps outside the step, beyond which the effect of a branch point is below the precision of a double. */
#define BEAD_EVENTS_REACH 2.0

/* Takes an integrated piece of a patch. */
typedef void bead_patch_keeper(void *keeper, struct bead_events *events, const struct bead_patch_piece *piece);

struct bead_events {
    struct bead_patch_rule rule;
    /* Constants of the contacts; 0 in the margins, except "contact -1", the constant force on the striker. */
    double *stiffness, *static_compression, *static_force, *inverse_mass, *hardness, *pull;
    struct bead_event_speeds speeds;
    struct bead_event_flags flags;
    size_t flagged_count;
    bool kinks_known; /* for this method and law */
    struct bead_kink_method method;
    struct bead_kinks kinks; /* of the flagged contacts */
    struct bead_patch patch;
    size_t patch_first; /* first contact of the patch */
    struct bead_patch_source source;
    struct bead_patch_branch branch[BEAD_PATCH_FLAGGED * BEAD_BRANCHES_MAX]; /* in order of s */
    size_t branch_count;
    /* Bounds over the chain: of A/m times the weights, and of the rate of a compression at this energy, m/s (0: unknown). */
    double hardest, fastest;
    double unit; /* m/s: the striker's velocity */
    struct bead_event_limits limits;
    double limits_h;         /* s: the longest steps for which they hold */
    bead_patch_keeper *keep; /* called for every piece; NULL: none */
    void *keeper;
    double *memory;
};

/* Finds the bounds of the chain, before the first step. */
void bead_events_bound(struct bead_events *events, const struct bead_stepper *stepper);
/* Flags the contacts of the last step, described by `source`, that need a correction, and finds their kinks. */
void bead_events_flag(struct bead_events *events, const struct bead_stepper *stepper, double tolerance);

/* Allocates a patch for a chain of this many beads. False: out of memory. */
bool bead_patch_make(struct bead_patch *patch, size_t beads);
/* The largest weight of some contacts. */
double bead_patch_weight(const struct bead_events *events, const size_t *flagged, size_t count);
/* Contacts first..last of the chain, of which some are flagged. */
struct bead_patch_contacts {
    size_t first, last;
    const size_t *flagged;
    size_t count;
};
/* Integrates them over the step described by `source`, from 0 to `until`, with the frozen contacts on either side. False: no branch
 * point. */
bool bead_patch_integrate(struct bead_events *events, const struct bead_stepper *stepper,
                          const struct bead_patch_contacts *contacts, double until);
/* Integrates all patches of the last step that touch a part of the beads, and hands their pieces to `keep`; corrects nothing. */
void bead_events_walk(struct bead_events *events, const struct bead_stepper *stepper, struct bead_part part, double tolerance,
                      bead_patch_keeper *keep, void *keeper);
