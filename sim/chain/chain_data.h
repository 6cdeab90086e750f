/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a chain, for the computing half only. */
#pragma once

#include <stdint.h>

#include "beadreel/chain.h"
#include "beadreel/law.h"
#include "sim/chain/chain_internal.h"

/* Holds a bead with the force coefficient |v|^exponent against its velocity v. */
struct bead_dashpot {
    double coefficient, exponent; /* N (s/m)^exponent; 0: there is none */
};

struct bead_chain {
    void *own; /* scene and specification of a chain made without a scene; NULL: they are the caller's */
    const struct bead_scene *scene;
    const struct bead_chain_spec *spec;
    const struct bead_law *law; /* NULL: no contacts; then only beads, position, mass and radius mean anything */
    size_t beads, contacts;
    double slope;            /* m/s^2: gravity along the chain */
    double striker_mass;     /* kg */
    double striker_force;    /* N: constant force on the striker: its weight, on a tilt */
    double spring_rate;      /* 1/s^2: the largest stiffness over mass of the springs that hold beads in place */
    struct bead_dashpot end; /* of the last bead */
    double started;          /* J: energy of the beads that do not start at rest, without the striker's velocity */
    double speed;            /* m/s: bead_chain_speed */
    double energy, omega;    /* bead_chain_energy, and bead_chain_omega at this energy */
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
    double *static_compression; /* [contacts] m; below 0: a gap */
    double *spring;             /* [beads] N/m: of the springs that hold beads in place; NULL: none */
};

/* Part of a contact's energy that counts as the energy of the bead beside it: half of it, or all at the wall. */
static inline double bead_chain_share(const struct bead_chain *chain, size_t contact)
{
    return contact + 1 < chain->beads ? 0.5 : 1;
}

/* Stiffness that holds a bead of a material in place, N/m: its spring, and gravity if it is a pendulum. */
double bead_chain_spring_of(const struct bead_chain *chain, size_t material);
/* The part of that due to gravity. */
double bead_chain_pendulum_of(const struct bead_chain *chain, size_t material);

/* Energy of a bead displaced by u from its place, J. */
static inline double bead_chain_spring_energy(const struct bead_chain *chain, size_t bead, double u)
{
    return chain->spring ? 0.5 * chain->spring[bead] * (u * u) : 0;
}

/* Make a chain without the arrays of its beads and contacts, so that 1e8 beads can be planned. Before bead_chain_lay, call only
 * functions that do not return such an array. Scene and specification must outlive it. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_chain_outline(const struct bead_scene *scene, const struct bead_chain_spec *spec,
                                              struct bead_chain **chain, struct bead_message *msg);
/* Bytes of these arrays. */
uint64_t bead_chain_bytes(const struct bead_chain *chain);
/* Make the arrays, unless they exist. Errors: MEMORY; the chain must still be destroyed. */
BEAD_CHECK enum bead_error bead_chain_lay(struct bead_chain *chain, struct bead_message *msg);
/* A chain of the scene's materials for a specification that need not be one of the scene's. Both must outlive it. Errors: as
 * bead_chain_create. */
BEAD_CHECK enum bead_error bead_chain_create_of(const struct bead_scene *scene, const struct bead_chain_spec *spec,
                                                struct bead_chain **chain, struct bead_message *msg);

/* The dashpot of an absorbing end, from the scene or as the chain's own waves need it. Call this when contacts can be walked.
 * False: nothing presses the beads together, and the law has no exponent. */
bool bead_chain_find_end(struct bead_chain *chain);
/* Force of a dashpot on a bead of velocity v, N. */
double bead_dashpot_force(const struct bead_dashpot *dashpot, double v);

/* Does any force depend on velocities: damping, or an absorbing end? */
static inline bool bead_chain_is_damped(const struct bead_chain *chain)
{
    return chain->spec->damping_coefficient > 0 || chain->end.coefficient > 0;
}

/* Fields (BEAD_FIELD_BITs) that follow from the displacements of all beads. */
unsigned bead_chains_derivable(const struct bead_chain *const *chains, size_t count);

/* The derivatives of a quantity with respect to the numbers of a chain. */
struct bead_chain_raw_rates {
    const double *stiffness, *static_force; /* [contacts] by A_k at constant static forces, and by the static forces */
    const double *mass;                     /* [beads] by m_j at constant forces */
    double striker_force;                   /* by the constant force on the striker */
};
/* Its derivatives by the mass, radius or modulus of each bead [beads], with the other two constant, and by the modulus of the wall.
 */
struct bead_chain_rates {
    double *mass, *radius, *modulus; /* /kg, /m, /Pa */
    double wall_modulus;
};
void bead_chain_find_rates(const struct bead_chain *chain, const struct bead_chain_raw_rates *raw, struct bead_chain_rates *rates);

/* Contact forces (N, [beads]; 0 for a last bead without wall) and bead forces (N, [beads]) of displacements u (m, [beads]), for
 * trajectories that store only these; equal to the samples of a run without damping, bit for bit. */
void bead_derive_forces(const struct bead_chain *chain, const double *u, double *contact_force, double *bead_force);
/* Compressions (m) of contacts first..last, by how much their beads overlap, static ones included; never negative where contacts
 * can open. */
void bead_derive_compressions(const struct bead_chain *chain, const double *u, size_t first, size_t last, double *compression);
