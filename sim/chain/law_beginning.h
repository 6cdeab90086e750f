/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beginning of a contact's force, for contact events: c d^p, times a smooth function that is 1 at d = 0. Power laws state it;
 * for others it is found from their forces and stiffnesses at small d. */
#pragma once

#include "sim/chain/chain_data.h"

/* p; NAN if contacts pull as well as push, so that they never open, or if the force does not begin as a power. */
double bead_chain_exponent(const struct bead_chain *chain);
/* c of contact k, N/m^p, or more if the force outgrows c d^p at the largest compression that the energy allows. */
double bead_chain_coefficient(const struct bead_chain *chain, size_t k, double exponent);
