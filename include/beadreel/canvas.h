/* Canvas: an off-screen OpenGL 3.3+ context with an own framebuffer object, behind a small back-end table.
 * A canvas belongs to the thread that created it. Created only for views that draw with GL. */
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
/* Row `index`, NULL behind the last. */
BEAD_API const struct bead_canvas_backend *bead_canvas_backend_info(size_t index);

/* Sets LP_NUM_THREADS=0 and LIBGL_ALWAYS_SOFTWARE=1 in the environment unless they are set (Mesa then rasterises in the calling
 * thread, and leaves graphics cards alone). Call it before other threads start; creating a canvas does it too. */
BEAD_API void bead_canvas_prepare(void);
/* backend NULL: the first that works; the pixels are the same from all. Errors: GRAPHICS, MEMORY, USAGE (no such back end). On
 * failure *canvas is NULL. */
BEAD_API BEAD_CHECK enum bead_error bead_canvas_create(const char *backend, int width, int height, struct bead_canvas **canvas,
                                                       struct bead_message *msg);
BEAD_API const char *bead_canvas_describe(const struct bead_canvas *canvas);             /* "osmesa, llvmpipe ..., OpenGL 4.5" */
BEAD_API void *bead_canvas_function(const struct bead_canvas *canvas, const char *name); /* a GL function or NULL */
/* Read `source` of the canvas into `frame` with its corner at (x, y); both must lie inside. Errors: GRAPHICS. */
BEAD_API BEAD_CHECK enum bead_error bead_canvas_read(struct bead_canvas *canvas, struct bead_rect source, struct bead_frame *frame,
                                                     int x, int y, struct bead_message *msg);
/* In the thread that created it; NULL is allowed. */
BEAD_API void bead_canvas_destroy(struct bead_canvas *canvas);

#endif
