/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The size of a movie's frames, from its output. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_SIZE_H
#define BEADREEL_RENDER_MOVIE_MOVIE_SIZE_H

#include "beadreel/scene.h"

/* In pixels. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_movie_size(const struct bead_output *output, const struct bead_scene *scene, int *width,
                                           int *height, struct bead_message *msg);

#endif
