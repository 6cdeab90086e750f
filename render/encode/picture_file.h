/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stills of pixels in files: PNG with its notes, or, by the name's ending, a picture of libav's encoders, with none of the notes
 * except dpi. */
#pragma once

#include <stdbool.h>

#include "render/draw/picture.h"

/* Can a picture with this name be made? Errors: those of bead_movie_check. */
BEAD_CHECK enum bead_error bead_picture_check(const char *path, int width, int height, bool alpha, struct bead_message *msg);
/* Errors: IO, MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_picture_write(const char *path, const struct bead_frame *frame,
                                              const struct bead_picture_notes *notes, uint64_t *bytes, struct bead_message *msg);
