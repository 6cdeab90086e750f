/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nesterenko's solitary wave of Hertzian beads that nothing presses together or holds, in the limit of long waves: forces of
 * contacts are F cos^6(sqrt(10)/5 n) over five equal beads, and the speed is sqrt(4/5) A^(1/3) F^(1/6) / sqrt(m) beads a second,
 * 1.2 % less than that of beads. V. F. Nesterenko, J. Appl. Mech. Tech. Phys. 24, 733 (1983).
 *
 * In dimers (two masses in turn) m is their mean, and the wave is longer by sqrt(1 + 3 r^2), r = (m1 - m2) / (m1 + m2): the strain
 * e of the displacement of the cells' centre of mass satisfies m V^2 e = f + c (f' e'' + f'' e'^2 / 2), f = A e^(3/2), c = (1 + 3
 * r^2) / 12, by the expansion of M. A. Porter et al., Phys. Rev. E 77, 015601 (2008), whose field is the displacement of one kind
 * of beads. For r = 0 this is Nesterenko's equation. Forces of neighbouring contacts differ too much there to be compared with a
 * curve. */
#pragma once

#include "beadreel/chain.h"
#include "sim/base/internal.h"

struct bead_compacton {
    double centre, height; /* contacts; N */
    double speed;          /* beads/s */
};

/* Has the chain such beads? Call it once the chain is made. The striker and the wall may differ. */
BEAD_INTERNAL bool bead_compacton_is_of(const struct bead_chain *chain);
/* The same for dimers. */
BEAD_INTERNAL bool bead_compacton_of_dimers(const struct bead_chain *chain);
/* For both: the number of contacts that the wave covers; its speed, beads/s, from its largest force, N. */
BEAD_INTERNAL double bead_compacton_width(const struct bead_chain *chain);
BEAD_INTERNAL double bead_compacton_speed(const struct bead_chain *chain, double force);
/* Finds the wave of the highest pulse in the forces of contacts 0 to count - 1. False: there is none. */
BEAD_INTERNAL bool bead_compacton_find(const struct bead_chain *chain, const double *forces, size_t count,
                                       struct bead_compacton *found);
/* The force at contact n. */
BEAD_INTERNAL double bead_compacton_at(const struct bead_compacton *compacton, double n);
