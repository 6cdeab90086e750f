/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A user's own settings and files, on their way into a scene. */
#ifndef BEADREEL_SIM_SCENE_SCENE_CONFIG_H
#define BEADREEL_SIM_SCENE_SCENE_CONFIG_H

#include "sim/scene/scene_private.h"

/* The whole of a file, but no more than a scene may have: it could be a device. To be freed. Errors: IO, SCENE (too long), MEMORY.
 */
BEAD_CHECK enum bead_error bead_text_read(const char *path, char **text, size_t *length, struct bead_message *msg);

/* Is a value of `colormap` the name of a file of colours? */
bool bead_colours_are_file(const char *value);
/* Before the document is read, and with the ready materials in the reader's scene: adds what the user's settings (the file
 * `config`; NULL: none) have and the scene lacks, and writes the colours of files in place of their names. *changed: there was
 * something. Errors: SCENE, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_take_own(struct bead_reader *reader, const char *config, bool *changed);

#endif
