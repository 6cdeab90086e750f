/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Canvas: paints beads, through a small table of back ends. `osmesa` and `egl` run shaders with Mesa's software OpenGL; `plain`
 * paints into frames itself by the same formulas, needs no library and is the fastest. A canvas belongs to the thread that created
 * it. Only views that paint have one. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/render.h"
#include "sim/base/internal.h"

struct bead_canvas;

struct bead_canvas_backend {
    const char *name, *description;
};
/* Row `index`, NULL after the last; if none is named, the first that works is used. */
BEAD_INTERNAL const struct bead_canvas_backend *bead_canvas_backend_info(size_t index);

/* For back ends that use OpenGL, sets LP_NUM_THREADS and LIBGL_ALWAYS_SOFTWARE=1 in the environment unless they are set: Mesa then
 * rasterises in the calling thread (with 4 cores or more in two others) and does not use graphics cards. Call it before other
 * threads start; creating a canvas does the same. NULL: the first back end. */
BEAD_INTERNAL void bead_canvas_prepare(const char *backend);
/* Rectangles of up to width x height pixels can be painted with it. backend NULL: the first that works on this machine. osmesa and
 * egl give the same pixels, and so does plain except for one level of 255 here and there; plain's are the same on every machine.
 * Errors: GRAPHICS (also if a named back end lacks its library, or free addresses for it), MEMORY, USAGE (no such back end). On
 * failure *canvas is NULL. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_canvas_create(const char *backend, int width, int height, struct bead_canvas **canvas,
                                                            struct bead_message *msg);
BEAD_INTERNAL const char *bead_canvas_describe(const struct bead_canvas *canvas); /* "osmesa, llvmpipe ..., OpenGL 4.5" */
BEAD_INTERNAL const char *bead_canvas_painter(const struct bead_canvas *canvas);  /* "OSMesa (llvmpipe)": for result lines */
/* Only in the thread that created it; NULL is allowed. */
BEAD_INTERNAL void bead_canvas_destroy(struct bead_canvas *canvas);
