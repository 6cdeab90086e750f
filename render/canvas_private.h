/* Inside of a canvas. */
#ifndef BEAD_RENDER_CANVAS_PRIVATE_H
#define BEAD_RENDER_CANVAS_PRIVATE_H

#include "beadreel/canvas.h"
#include "render/canvas_driver.h"
#include "render/gl.h"

struct bead_painter; /* paint.h */

struct bead_canvas {
    const struct bead_canvas_driver *driver;
    struct bead_context *context;
    struct bead_gl gl;
    GLuint texture, framebuffer; /* row 0 of the framebuffer is the top row of the picture */
    int width, height;
    struct bead_painter *painter; /* shared by the views on this canvas; made when first asked for */
    char description[160];
};

/* The canvas's functions, its context current and its framebuffer bound. NULL where that fails. */
const struct bead_gl *bead_canvas_gl(struct bead_canvas *canvas);

#endif
