/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain's insides, for the computing half only. */
#ifndef BEADREEL_SIM_CHAIN_CHAIN_DATA_H
#define BEADREEL_SIM_CHAIN_CHAIN_DATA_H

#include <stdint.h>

#include "beadreel/chain.h"
#include "beadreel/law.h"

struct bead_system;

struct bead_chain {
    const struct bead_scene *scene;
    const struct bead_chain_spec *spec;
    const struct bead_law *law;       /* NULL: an equation */
    const struct bead_system *system; /* NULL: beads; else only beads (points), position, mass and radius mean anything */
    size_t beads, contacts;
    double slope;         /* m/s^2: gravity along the chain */
    double striker_mass;  /* kg */
    double striker_force; /* N: constant force on the striker beyond balance (its weight on a tilt) */
    double energy, omega; /* those that bead_chain_energy and, with it, bead_chain_omega return */
    char *spins;
    double magnetism;
    struct bead_sensor *sensors;
    size_t sensor_count;
    /* NULL in an outline: */
    size_t *material;           /* [beads] */
    double *mass;               /* [beads] kg */
    double *inverse_mass;       /* [beads] 1/kg */
    double *radius;             /* [beads] m */
    double *position;           /* [beads] m */
    double *stiffness;          /* [contacts] */
    double *static_force;       /* [contacts] N */
    double *static_compression; /* [contacts] m */
};

/* Part of a contact's energy that counts as that of a bead beside it: half, or all of the wall's, which has no bead behind. */
static inline double bead_chain_share(const struct bead_chain *chain, size_t contact)
{
    return contact + 1 < chain->beads ? 0.5 : 1;
}

/* What is known of a chain from its specification: all but the arrays of its beads and contacts, so that 1e8 beads can be planned.
 * Until bead_chain_lay, only functions that return no such array may be called. Scene and specification must outlive it. Errors:
 * SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_chain_outline(const struct bead_scene *scene, const struct bead_chain_spec *spec,
                                              struct bead_chain **chain, struct bead_message *msg);
/* Bytes of the arrays that it lacks. */
uint64_t bead_chain_bytes(const struct bead_chain *chain);
/* Makes the arrays, unless they are there. Errors: MEMORY; the chain is still to be destroyed. */
BEAD_CHECK enum bead_error bead_chain_lay(struct bead_chain *chain, struct bead_message *msg);
/* The chain of a specification that need not be one of the scene's, made of the scene's materials. Both must outlive it. Errors:
 * those of bead_chain_create. */
BEAD_CHECK enum bead_error bead_chain_create_of(const struct bead_scene *scene, const struct bead_chain_spec *spec,
                                                struct bead_chain **chain, struct bead_message *msg);

/* The derivatives of a quantity by what a chain is made of. */
struct bead_chain_raw_rates {
    const double *stiffness, *static_force; /* [contacts] by A_k at given static forces, and by those */
    const double *mass;                     /* [beads] by m_j at given forces */
    double striker_force;                   /* by the constant force on the striker */
};
/* Of these: by the mass, radius and modulus of each bead [beads], the two others kept; and by the modulus of the wall. */
struct bead_chain_rates {
    double *mass, *radius, *modulus; /* /kg, /m, /Pa */
    double wall_modulus;
};
void bead_chain_find_rates(const struct bead_chain *chain, const struct bead_chain_raw_rates *raw, struct bead_chain_rates *rates);

#endif
