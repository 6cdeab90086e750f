/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of chains and materials in pictures: never the identifiers of the scene. */
#pragma once

#include "beadreel/chain.h"

/* "" for an unnamed chain. */
static inline const char *bead_chain_title(const struct bead_chain *chain)
{
    const char *title = bead_chain_spec(chain)->title;
    return title ? title : "";
}

/* Fewest decimals, at most three, that write a magnetism: 0 for 1, 2 for 0.25, 3 for 1/3. */
int bead_magnetism_digits(double magnetism);
/* The number that the chain with the most needs, for all of a picture. */
int bead_magnetism_decimals(const struct bead_chain *const *chains, size_t count);

/* Plain text: "brass wall", "rigid wall". */
void bead_wall_name(const struct bead_chain *chain, char *out, size_t size);
