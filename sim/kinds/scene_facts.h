/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Facts about the chains of a scene before they are made, for checks of its other keys. */
#pragma once

#include "beadreel/scene.h"
#include "sim/chain/system.h"

enum { BEAD_SCENE_BEADS = 100000000 }; /* the most in all chains */

/* The system of the scene's chains, which all have contacts or all have none; beads if they could not be read. */
static inline const struct bead_system *bead_scene_system(const struct bead_scene *scene)
{
    return scene->chain_count > 0 ? scene->chains[0].system : &bead_system_beads;
}

/* The unit after times of the motion in messages. */
static inline const char *bead_scene_seconds(const struct bead_scene *scene)
{
    return *bead_scene_system(scene)->time_unit ? " s" : "";
}

/* Beads of a chain without its striker. */
size_t bead_scene_count_beads(const struct bead_chain_spec *chain);
/* Number of the last bead, or point, of a chain; `simulate` must have been read. */
size_t bead_scene_last_bead(const struct bead_scene *scene, size_t chain);
/* BEAD_FIELD_BITs of the fields that all chains of the scene have. */
unsigned bead_scene_fields(const struct bead_scene *scene);
/* Does the chain have a sensor with this name (NULL: any)? Does a chain of the scene (SIZE_MAX: any) have one? */
bool bead_chain_spec_has_sensor(const struct bead_chain_spec *chain, const char *name);
bool bead_scene_has_sensors(const struct bead_scene *scene, size_t chain);
/* Do all chains have masses at all points, which the view of beads can show? Do all have modes? */
bool bead_scene_has_beads(const struct bead_scene *scene);
bool bead_scene_has_modes(const struct bead_scene *scene);
/* Does a material have tolerances: do its beads differ? */
bool bead_scene_tolerances(const struct bead_scene *scene);
/* Has a bead behind the striker a value above 0 at this offset in its material? */
bool bead_scene_has_any(const struct bead_scene *scene, const struct bead_chain_spec *chain, size_t offset);
/* Are beads held in place? */
bool bead_scene_has_springs(const struct bead_scene *scene, const struct bead_chain_spec *chain);
