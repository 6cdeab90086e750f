/* Canvas: what beads are painted with, behind a small table of back ends. `plain` paints into frames itself and needs nothing;
 * `osmesa` and `egl` have Mesa's software OpenGL run the same formulas as shaders: a reference to check it against.
 * A canvas belongs to the thread that created it. Created only for views that paint. */
#ifndef BEADREEL_CANVAS_H
#define BEADREEL_CANVAS_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/frame.h"

struct bead_canvas;

struct bead_canvas_backend {
    const char *name, *description;
};
/* Row `index`, NULL behind the last; the first is what is taken where none is named. */
BEAD_API const struct bead_canvas_backend *bead_canvas_backend_info(size_t index);

/* For back ends that use OpenGL, sets LP_NUM_THREADS=0 and LIBGL_ALWAYS_SOFTWARE=1 in the environment unless they are set (Mesa
 * then rasterises in the calling thread, and leaves graphics cards alone). Call it before other threads start; creating a canvas
 * does it too. NULL: of the first back end, which is nothing to do. */
BEAD_API void bead_canvas_prepare(const char *backend);
/* Rectangles of up to width x height pixels can be painted with it. backend NULL: the first. All pixels are the same from osmesa
 * and egl, and from plain but for one level of 255 here and there; those of plain are the same on every machine. Errors: GRAPHICS,
 * MEMORY, USAGE (no such back end). On failure *canvas is NULL. */
BEAD_API BEAD_CHECK enum bead_error bead_canvas_create(const char *backend, int width, int height, struct bead_canvas **canvas,
                                                       struct bead_message *msg);
BEAD_API const char *bead_canvas_describe(const struct bead_canvas *canvas); /* "osmesa, llvmpipe ..., OpenGL 4.5" */
/* In the thread that created it; NULL is allowed. */
BEAD_API void bead_canvas_destroy(struct bead_canvas *canvas);

#endif
