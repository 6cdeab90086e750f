/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contacts of a chain one after the other, from its specification and spins: nothing has to be built for a plan.
 *
 *     struct bead_contact_walk walk;
 *     for (bead_contact_walk_start(&walk, chain, kinds); bead_contact_walk_next(&walk);) ...
 */
#ifndef BEADREEL_SIM_CHAIN_CONTACT_WALK_H
#define BEADREEL_SIM_CHAIN_CONTACT_WALK_H

#include "sim/chain/chain_data.h"

/* Contacts already solved, found by their materials. */
struct bead_known_contact {
    size_t left, right; /* right SIZE_MAX: wall; left SIZE_MAX: none */
    double force;       /* asked */
    double stiffness, static_force, static_compression;
};
enum { BEAD_KNOWN_CONTACTS = 8 };

struct bead_contact_walk {
    /* Contact k, between the beads k and k + 1, or the wall. */
    size_t k, left, right;     /* left, right: indices of materials; right SIZE_MAX: the wall */
    double left_mass;          /* kg */
    double right_mass;         /* kg; INFINITY: wall */
    double stiffness;          /* N/m^power */
    double static_force;       /* N: precompression and weight */
    double static_compression; /* m */

    /* The walk's own. */
    const struct bead_chain *chain;
    bool kinds;
    size_t next, segment, cell, place; /* the contact to come; where the bead to its right stands */
    const char *spin;
    double weight; /* N: of the beads from 1 to the left one */
    struct bead_known_contact known[BEAD_KNOWN_CONTACTS];
};

/* `kinds`: where many equal cells follow each other, most of them are left out, which is right for whatever depends on neighbouring
 * contacts, but not on their number: every four neighbours that the chain has are still there. Not of equations. */
void bead_contact_walk_start(struct bead_contact_walk *walk, const struct bead_chain *chain, bool kinds);
/* To the next contact, the first one at first; false: there is none. */
bool bead_contact_walk_next(struct bead_contact_walk *walk);

#endif
