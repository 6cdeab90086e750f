/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains: beads, contacts and forces, made from a scene or from arrays; not changed afterwards, so threads may share one.
 *
 * Bead 0 is the striker, beads 1..N the chain. Contact k is between beads k and k+1; the contact with
 * the wall, where there is one, is the last. Displacement u_j is from the rest position, positive
 * towards the wall. Compression of contact k: d_k = d0_k + u_k - u_{k+1} (the wall's u is 0); for beads with a gap g between them,
 * d0_k = -g.
 */
#ifndef BEADREEL_CHAIN_H
#define BEADREEL_CHAIN_H

#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"

BEAD_BEGIN

struct bead_chain;

struct bead_sensor {
    const char *name;
    size_t bead;
};

/* Chain `index` of the scene. The scene must outlive the chain. Errors: SCENE (with the place), MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_chain_create(const struct bead_scene *scene, size_t index, struct bead_chain **chain,
                                                      struct bead_message *msg);

/* Properties of a bead, or of a wall, which needs only modulus and Poisson's ratio. */
struct bead_properties {
    double radius;  /* m */
    double density; /* kg/m3; 0: given by the mass */
    double mass;    /* kg; 0: follows from density and radius */
    double modulus; /* Pa, Young's */
    double poisson; /* -1 .. 0.5 */
};

/* A chain without a scene. Arrays may go once the chain is made; a law of the caller's own must outlive it. */
struct bead_chain_settings {
    size_t size;                         /* of this structure: BEAD_DEFAULT */
    const struct bead_properties *beads; /* [count], left to right, without the striker */
    size_t count;
    size_t repeat;                        /* how many times the row of `beads`; 0: once */
    double velocity;                      /* m/s, of the striker as it touches the first bead, at time 0 */
    struct bead_properties striker;       /* zeros: as the first of `beads` */
    enum bead_wall wall;                  /* behind the last bead */
    struct bead_properties wall_material; /* BEAD_WALL_MATERIAL */
    struct bead_law_spec law;             /* row NULL: Hertz's */
    double precompression;                /* N, static force in every contact */
    double tilt;                          /* rad; needs a wall, which holds the lower end */
    double damping_coefficient;           /* N (s/m)^exponent: force against the speed of compression */
    double damping_exponent;              /* 0: 1.8 */
    const char *name;                     /* in messages; NULL: "chain" */
};
/* On failure *chain is NULL. Errors: USAGE (names the member that is wrong), MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_chain_make(const struct bead_chain_settings *settings, struct bead_chain **chain,
                                                    struct bead_message *msg);
BEAD_API void bead_chain_destroy(struct bead_chain *chain);

BEAD_API const char *bead_chain_name(const struct bead_chain *chain); /* "" where it has none */
BEAD_API const struct bead_chain_spec *bead_chain_spec(const struct bead_chain *chain);
BEAD_API const struct bead_scene *bead_chain_scene(const struct bead_chain *chain);
BEAD_API size_t bead_chain_beads(const struct bead_chain *chain);    /* with the striker: N + 1 */
BEAD_API size_t bead_chain_contacts(const struct bead_chain *chain); /* N, and one more with a wall */

/* Arrays of length beads. */
BEAD_API const double *bead_chain_mass(const struct bead_chain *chain);     /* kg */
BEAD_API const double *bead_chain_radius(const struct bead_chain *chain);   /* m */
BEAD_API const double *bead_chain_position(const struct bead_chain *chain); /* m: centre, from bead 1's, unloaded */
BEAD_API const size_t *bead_chain_material(const struct bead_chain *chain); /* index into scene->materials */
/* Arrays of length contacts. */
BEAD_API const double *bead_chain_stiffness(const struct bead_chain *chain); /* A_k, N/m^power, for Hertz's law 4/3 E* sqrt(R*) */
BEAD_API const double *bead_chain_static_force(const struct bead_chain *chain);       /* N: precompression and weight */
BEAD_API const double *bead_chain_static_compression(const struct bead_chain *chain); /* m; below 0: a gap */

/* Spins of all segments with cells of two or more beads, left to right, as '0' and '1'; "" where there are none. */
BEAD_API const char *bead_chain_spins(const struct bead_chain *chain);
/* M = |N_up - N_down| / (N_up + N_down) of the cells whose spins the scene gives, or of all cells if it gives none (1 if there are
 * no cells): then cells that mirror the first ones are down. */
BEAD_API double bead_chain_magnetism(const struct bead_chain *chain);

BEAD_API const struct bead_sensor *bead_chain_sensors(const struct bead_chain *chain, size_t *count);

/* Title and unit of a field in this chain's samples; NULL: the chain has no such field. */
BEAD_API const struct bead_field_info *bead_chain_field(const struct bead_chain *chain, enum bead_field field);
BEAD_API const char *bead_chain_time_unit(const struct bead_chain *chain); /* "s"; "" where times have no unit */

/* Energy put in by the striker and by other beads that do not start at rest, J. */
BEAD_API double bead_chain_energy(const struct bead_chain *chain);

BEAD_END

#endif
