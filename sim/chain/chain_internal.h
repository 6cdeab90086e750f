/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains and laws, for the project's own code only. */
#pragma once

#include "beadreel/chain.h"
#include "beadreel/law.h"
#include "sim/base/internal.h"

/* `file:line:column: ` of the chain in its scene, or `--set:number:column: `, into `text`; "" without a scene. Returns text. */
BEAD_INTERNAL const char *bead_chain_place(const struct bead_chain *chain, const char *path, char *text, size_t size);
unsigned bead_chain_fields(const struct bead_chain *chain); /* BEAD_FIELD_BITs of those it has */
/* May its values have either sign, so that they need a colour map for both? */
BEAD_INTERNAL bool bead_chain_signed(const struct bead_chain *chain, enum bead_field field);
/* Colour of a bead, sRGB 0..1 [3]. */
BEAD_INTERNAL const double *bead_chain_colour(const struct bead_chain *chain, size_t bead);
/* "sensors": names and beads, within an open object. */
struct bead_json;
BEAD_INTERNAL void bead_chain_write_sensors(struct bead_json *json, const struct bead_chain *chain);
/* A few words about the system: the formula of an equation; "" for beads. */
BEAD_INTERNAL void bead_chain_describe(const struct bead_chain *chain, char *text, size_t size);
/* Linear modes of an equation: which fields of a sample their energies follow from (0: it has no modes), what these are called, and
 * the energies of modes 1..count; field arrays as those of a sample. */
BEAD_INTERNAL unsigned bead_chain_mode_fields(const struct bead_chain *chain);
BEAD_INTERNAL const char *bead_chain_mode_title(const struct bead_chain *chain);
BEAD_INTERNAL void bead_chain_mode_energies(const struct bead_chain *chain, const double *const field[BEAD_FIELD_COUNT],
                                            size_t count, double *energy);
/* Upper bound of the frequency of small vibrations about any state that energy allows, rad/s:
 * every compression d_k is bounded by A_k d^{5/2} 2/5 <= E, every stiffness by that, omega by
 * Gershgorin's circles. `energy` in J above the static state; pass bead_chain_energy(). */
double bead_chain_omega(const struct bead_chain *chain, double energy);
/* About how long a wave of this energy takes from end to end, s: the sum of sqrt(m/K) over the contacts, m the mass of the heavier
 * bead, K the largest stiffness that the energy allows. Within a factor of a few. */
BEAD_INTERNAL double bead_chain_passage(const struct bead_chain *chain, double energy);
/* The part of it in which beads cross gaps, at the largest velocity of the start, s. */
BEAD_INTERNAL double bead_chain_flight(const struct bead_chain *chain);
/* The largest velocity at the start, m/s, or that which the energy of displaced beads can give one of them, if that is larger: the
 * unit of velocities. */
BEAD_INTERNAL double bead_chain_speed(const struct bead_chain *chain);

/* How far the springs and pendulums that hold beads let one move, m, if it gets all of the energy; 0 unless all beads are held. */
BEAD_INTERNAL double bead_chain_swing(const struct bead_chain *chain);

/* The axis along a chain: value i of a field is at first + i * spacing. */
struct bead_chain_axis {
    const char *title; /* "bead", "contact", or "x" */
    const char *unit;  /* as graphs and axes take it: "1" of numbers of beads, "" of coordinates */
    double first, spacing;
};
BEAD_INTERNAL struct bead_chain_axis bead_chain_axis(const struct bead_chain *chain, bool of_contacts);

/* Law `index`; NULL after the last. */
const struct bead_law *bead_law_info(size_t index);
/* Is the row complete? Errors: USAGE, with the name of what is missing. */
BEAD_CHECK enum bead_error bead_law_check(const struct bead_law *law, struct bead_message *msg);
