/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces from displacements, for trajectories that store only these. */
#ifndef BEADREEL_SIM_INTEGRATE_DERIVE_H
#define BEADREEL_SIM_INTEGRATE_DERIVE_H

#include "beadreel/chain.h"

/* Contact forces (N, [beads]; 0 for a last bead without wall) and bead forces (N, [beads]) of displacements u (m, [beads]); bit for
 * bit what a run without damping samples. */
void bead_derive_forces(const struct bead_chain *chain, const double *u, double *contact_force, double *bead_force);

#endif
