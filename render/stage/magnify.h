/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The factor by which drawings magnify the displacements of beads. */
#pragma once

#include "beadreel/chain.h"

/* Largest compression as the striker hits bead 1, as if the two were alone, m: the unit of the wave's compressions. The contact
 * then stores (1/2) m v^2 with the reduced mass m. 0 if nothing is struck. */
double bead_compression_scale(const struct bead_chain *chain);
/* The round factor (1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten; at least 1) that shows this compression as a quarter of a
 * radius, or less if softer contacts would show more than half of one; the smallest factor of all chains. */
double bead_magnify_auto(const struct bead_chain *const *chains, size_t count);
