/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains of sweeps as scenes have them. */
#pragma once

#include "beadreel/scene.h"
#include "sim/base/yaml.h"

/* Cells behind the random ones, where `fixed` is not given. */
#define BEAD_SWEEP_FIXED "15"

/* The value of `chain` for one configuration of the sweep at `sweep`, in the scene at `root`: with `digits` for the
 * random cells, or with `spins: random` (NULL). Parts are shared with the document. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_chain_node(struct bead_yaml *yaml, const struct bead_node *root,
                                                 const struct bead_node *sweep, const char *digits, struct bead_node **chain,
                                                 struct bead_message *msg);

/* The sweep number `index` of a scene, NULL behind the last; is `sweeps` a list of some? */
const struct bead_node *bead_sweep_node(const struct bead_node *root, size_t index);

/* A scene like that of `yaml`, but with one chain instead of the sweep number `index`, and without outputs. Errors: SCENE, MEMORY.
 */
BEAD_CHECK enum bead_error bead_sweep_single_node(struct bead_yaml *yaml, size_t index, const char *digits,
                                                  struct bead_node **scene, struct bead_message *msg);

/* A number that all keys of the scene but title and outputs go into. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_hash_scene(struct bead_yaml *yaml, uint64_t *hash, struct bead_message *msg);
