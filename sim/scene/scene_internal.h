/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes, for the project's own code only: changes, help, the user's own settings. */
#pragma once

#include <stdio.h>

#include "beadreel/scene.h"
#include "sim/yaml/yaml.h"

/* A user's own settings, for all scenes: how pictures look, colour maps, and materials that are not ready ones. The scene's own
 * values go first; settings that a scene uses are copied into its text, so that its files are complete. */
struct bead_config_colormap {
    char *name, *file;
};
struct bead_config {
    char *path;
    char *style, *font, *canvas; /* NULL: not given */
    char *materials;             /* a file of materials; NULL: none */
    struct bead_place style_place, font_place, canvas_place, materials_place;
    struct bead_config_colormap *colormaps;
    size_t colormap_count;
};
/* Makes a changed copy of a loaded scene. */
BEAD_CHECK enum bead_error bead_scene_change(const struct bead_scene *before, const struct bead_overrides *overrides,
                                             struct bead_scene **scene, struct bead_message *msg);
/* The ready materials: a scene with nothing else in it, to be freed with bead_scene_free. Errors: IO, SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_materials(struct bead_scene **scene, struct bead_message *msg);
/* Write all keys of scenes with units, ranges and defaults, from the tables that the parser uses: as text, or as sections
 * of a man page. */
void bead_scene_help(FILE *out);
/* Help on one section and its parts only: "movie", "chain", "sweep", ... Errors: USAGE, with the nearest name. */
BEAD_CHECK enum bead_error bead_scene_help_of(const char *section, FILE *out, struct bead_message *msg);
void bead_scene_help_man(FILE *out);
/* The file: config.yaml in the folder `beadreel` of $XDG_CONFIG_HOME (else ~/.config), then of $XDG_CONFIG_DIRS (else /etc/xdg).
 * False: there is none. */
bool bead_config_find(char *path, size_t size);
/* Names of files in it are relative to its folder. On success *config is the caller's. Errors: SCENE, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_config_load(const char *path, struct bead_config **config, struct bead_message *msg);
void bead_config_free(struct bead_config *config);
BEAD_LEAVES(bead_config_left, struct bead_config, bead_config_free)
BEAD_LEAVES(bead_scene_left, struct bead_scene, bead_scene_free)

/* The chains of sweeps, as in scenes. */

/* Cells after the random ones, unless `fixed` is given. */
#define BEAD_SWEEP_FIXED "15"

/* The value of `chain` for one configuration of the sweep at `sweep`, in the scene at `root`: with `digits` for the random cells;
 * NULL: `spins: random`. Parts are shared with the document. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_chain_node(struct bead_yaml *yaml, const struct bead_node *root,
                                                 const struct bead_node *sweep, const char *digits, struct bead_node **chain,
                                                 struct bead_message *msg);

/* The sweep number `index` of a scene, NULL after the last. */
const struct bead_node *bead_sweep_node(const struct bead_node *root, size_t index);

/* A scene like that of `yaml`, but with one chain instead of the sweep number `index`, and without outputs. Errors: SCENE, MEMORY.
 */
BEAD_CHECK enum bead_error bead_sweep_single_node(struct bead_yaml *yaml, size_t index, const char *digits,
                                                  struct bead_node **scene, struct bead_message *msg);

/* A hash of all keys of the scene except title and outputs. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_sweep_hash_scene(struct bead_yaml *yaml, uint64_t *hash, struct bead_message *msg);
