/* Back ends of the canvas: one const table each. No GL headers here: back ends bring their own. */
#ifndef BEAD_RENDER_CANVAS_DRIVER_H
#define BEAD_RENDER_CANVAS_DRIVER_H

#include <stdbool.h>

#include "beadreel/canvas.h"

struct bead_context; /* each back end's own */

/* A way to get an OpenGL 3.3 core context without a display. */
struct bead_canvas_driver {
    struct bead_canvas_backend info;
    /* Create a context and make it current in this thread. Errors: GRAPHICS, MEMORY. On failure *context is NULL. */
    enum bead_error (*open)(struct bead_context **context, struct bead_message *msg);
    /* Make it current in this thread, if it is not. */
    bool (*use)(struct bead_context *context);
    void *(*function)(struct bead_context *context, const char *name);
    void (*close)(struct bead_context *context);
};

extern const struct bead_canvas_driver bead_canvas_osmesa, bead_canvas_egl;

#endif
