/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nesterenko's solitary wave of equal Hertzian beads that nothing presses together, in the limit of long waves: forces of contacts
 * are F cos^6(sqrt(10)/5 n) over five beads, and the speed is sqrt(4/5) A^(1/3) F^(1/6) / sqrt(m) beads a second, 1.2 % less than
 * that of beads. V. F. Nesterenko, J. Appl. Mech. Tech. Phys. 24, 733 (1983). */
#pragma once

#include "beadreel/chain.h"
#include "sim/base/internal.h"

struct bead_compacton {
    double centre, height; /* contacts; N */
    double speed;          /* beads/s */
};

/* Is the chain one of such beads? After it has been made. */
BEAD_INTERNAL bool bead_compacton_is_of(const struct bead_chain *chain);
/* That of the highest pulse in the forces of the contacts 0 to count - 1. False: there is none. */
BEAD_INTERNAL bool bead_compacton_find(const struct bead_chain *chain, const double *forces, size_t count,
                                       struct bead_compacton *found);
/* The force at contact n. */
BEAD_INTERNAL double bead_compacton_at(const struct bead_compacton *compacton, double n);
