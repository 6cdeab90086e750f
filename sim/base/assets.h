/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Assets: materials, colour maps, shaders and ready scenes beside the program.
 * Looked for in $BEADREEL_ASSETS, in assets/ beside the program, in ../share/beadreel from it, and
 * where `make install` put them. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

/* Full path of asset `name` ("materials.yaml") into `path`. Errors: IO (says where it looked). */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_asset_path(const char *name, char *path, size_t size, struct bead_message *msg);
/* Its contents, NUL-terminated, to be freed by the caller with free(). Errors: IO, SCENE (longer than 16 MiB), MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_asset_read(const char *name, char **text, size_t *length, struct bead_message *msg);
