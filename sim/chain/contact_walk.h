/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Walks along the contacts of a chain, computed from its specification and spins: plans need no arrays.
 *
 *     struct bead_contact_walk walk;
 *     for (bead_contact_walk_start(&walk, chain, kinds); bead_contact_walk_next(&walk);) ...
 */
#pragma once

#include "sim/chain/chain_data.h"

/* A solved contact, known by its materials. */
struct bead_known_contact {
    size_t left, right; /* right SIZE_MAX: wall; left SIZE_MAX: none */
    double force, gap;  /* N, m: as asked for */
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
    double static_compression; /* m; below 0: a gap */

    /* The walk's own. */
    const struct bead_chain *chain;
    bool kinds;
    size_t next, segment, cell, place; /* of the contact to come, and of the bead to its right */
    const char *spin;
    double weight; /* N: of the beads from 1 to `left` */
    struct bead_known_contact known[BEAD_KNOWN_CONTACTS];
};

/* `kinds`: skip most of many equal cells in a row. All sequences of four neighbours in the chain are still visited, so this suits
 * results that depend on neighbouring contacts, but not on their number. Not for equations. */
void bead_contact_walk_start(struct bead_contact_walk *walk, const struct bead_chain *chain, bool kinds);
/* Energy of the contact at compression d above its static state, J. */
double bead_contact_walk_excess(const struct bead_contact_walk *walk, double d);
/* Go to the next contact, at first to the first; false after the last. */
bool bead_contact_walk_next(struct bead_contact_walk *walk);
/* Largest compression of this contact if it alone holds all of `energy`, J above the static state; m. */
double bead_contact_bound(const struct bead_contact_walk *walk, double energy);
