/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trajectories: H5MD 1.1 files that explain themselves.
 *
 * Reading: bead_trajectory_open checks the file (it is not trusted), rebuilds the scene and its chains from
 * the stored text, and gives the samples in order. Writing is the sink for `trajectory:` outputs.
 * Several chains of a scene share one particles group, one after the other; /parameters/beadreel/chains
 * says where each begins.
 *
 * In the file, all in double and SI units, only the fields asked for:
 *   /particles/chain/displacement/value    [time][bead]     u
 *   /particles/chain/position/value        [time][bead][3]  x = rest position + u; y tells chains apart; z = 0
 *   /particles/chain/velocity/value        [time][bead][3]  y = z = 0
 *   /particles/chain/bead_force/value      [time][bead]     field `force`: mean of the forces in the bead's two contacts
 *   /particles/chain/force/value           [time][bead][3]  with it: net force, mass times acceleration
 *   /particles/chain/energy/value          [time][bead]
 *   /contacts/contact_force/value          [time][contact]
 *   /contacts/compression/value            [time][contact]
 * each with time, step (the sample's number) and the numbers of its beads or contacts beside it; mass, radius, id, species
 * (index of the material), chain and rest_position of every bead in /particles/chain; scene, materials, chains and
 * outcome in /parameters/beadreel. */
#ifndef BEADREEL_TRAJECTORY_H
#define BEADREEL_TRAJECTORY_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/sink.h"

BEAD_BEGIN

struct bead_trajectory;

/* HDF5 reads the file in a separate process, a child of the calling one, until the trajectory is closed. That process has no other
 * files, no network and little memory; if a file makes it crash, that is an error here. Overrides change the stored scene's outputs
 * (not its physics). On failure *trajectory is NULL; errors: IO, FORMAT, MEMORY, SCENE. */
BEAD_API BEAD_CHECK enum bead_error bead_trajectory_open(const char *path, const struct bead_overrides *overrides,
                                                         struct bead_trajectory **trajectory, struct bead_message *msg);
BEAD_API void bead_trajectory_close(struct bead_trajectory *trajectory);

BEAD_API const struct bead_scene *bead_trajectory_scene(const struct bead_trajectory *trajectory);
BEAD_API const struct bead_chain *const *bead_trajectory_chains(const struct bead_trajectory *trajectory, size_t *count);
BEAD_API const struct bead_grid *bead_trajectory_grid(const struct bead_trajectory *trajectory); /* of the samples really there */
BEAD_API unsigned bead_trajectory_fields(const struct bead_trajectory *trajectory); /* BEAD_FIELD_BITs stored or derivable */
BEAD_API struct bead_span bead_trajectory_beads(const struct bead_trajectory *trajectory);
BEAD_API bool bead_trajectory_complete(const struct bead_trajectory *trajectory); /* false: its run was stopped or killed */
/* Outcome of chain `chain` as stored (peaks NULL; NaN and method "" where the run was killed). */
BEAD_API BEAD_CHECK enum bead_error bead_trajectory_outcome(const struct bead_trajectory *trajectory, size_t chain,
                                                            struct bead_outcome *outcome, struct bead_message *msg);

/* Read sample `index` of chain `chain` into `sample` (borrowed until the next call); reads whole chunks ahead, so go in order. */
BEAD_API BEAD_CHECK enum bead_error bead_trajectory_read(struct bead_trajectory *trajectory, size_t index, size_t chain,
                                                         unsigned fields, struct bead_sample *sample, struct bead_message *msg);

BEAD_END

#endif
