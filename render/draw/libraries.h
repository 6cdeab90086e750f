/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The libraries that are opened at run time, when a canvas or a movie first needs them: nothing links them. */
#ifndef BEADREEL_RENDER_DRAW_LIBRARIES_H
#define BEADREEL_RENDER_DRAW_LIBRARIES_H

#include <stddef.h>

#include "beadreel/library.h"

enum bead_opened_library {
    BEAD_LIBRARY_OSMESA,
    BEAD_LIBRARY_EGL,
    BEAD_LIBRARY_AVUTIL,
    BEAD_LIBRARY_AVCODEC,
    BEAD_LIBRARY_AVFORMAT,
    BEAD_LIBRARIES
};

/* NULL where `index` is not below BEAD_LIBRARIES. */
const struct bead_library_info *bead_library_info(size_t index);

#endif
