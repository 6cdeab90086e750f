/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a picture's file says of its scene. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"

/* The scene that a PNG file has (its text "Source"), to be freed by the caller; NULL: none. `version`: of the program that wrote
 * it,
 * "" where the file does not say. Errors: IO, FORMAT, MEMORY. */
BEAD_CHECK enum bead_error bead_png_source(const char *path, char **source, char *version, size_t size, struct bead_message *msg);
