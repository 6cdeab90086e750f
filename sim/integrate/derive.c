/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the forces of stored displacements with the laws of the chain, when a trajectory is replayed. */
#include "sim/integrate/derive.h"

#include "sim/chain/chain_data.h"

void bead_derive_forces(const struct bead_chain *chain, const double *u, double *contact_force, double *bead_force)
{
    const struct bead_law_spec *spec = &chain->spec->law;
    double before = 0;
    for (size_t k = 0; k < chain->beads; k++) {
        double next = k + 1 < chain->beads ? u[k + 1] : 0, d = chain->static_compression[k] + (u[k] - next);
        double force = k < chain->contacts ? chain->law->force(chain->stiffness[k], spec, d) : 0;
        /* The integrator subtracts the static part and sampling adds it again; do the same here, for equal last bits. */
        contact_force[k] = (force - chain->static_force[k]) + chain->static_force[k];
        bead_force[k] = 0.5 * (before + contact_force[k]);
        before = contact_force[k];
    }
}
