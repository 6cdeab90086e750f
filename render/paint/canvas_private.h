/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside of a canvas: its back end, a const table, and what is painted on right now. No GL headers here. */
#ifndef BEADREEL_RENDER_PAINT_CANVAS_PRIVATE_H
#define BEADREEL_RENDER_PAINT_CANVAS_PRIVATE_H

#include "beadreel/canvas.h"
#include "render/paint/paint.h"

struct bead_painter;      /* each way of painting has its own */
struct bead_context_type; /* gl_context.h */

/* A rectangle of a frame, as it was. */
struct bead_backdrop {
    struct bead_rect place;        /* in the frame; its corner is the painter's (0, 0) */
    struct bead_frame copy;        /* plain */
    unsigned texture, framebuffer; /* OpenGL */
};

/* The functions of paint.h, whose arguments are checked there. Errors: GRAPHICS, IO, MEMORY. */
struct bead_painting {
    /* Make canvas->painter and describe it. On failure there is none. */
    enum bead_error (*open)(struct bead_canvas *canvas, struct bead_message *msg);
    void (*close)(struct bead_canvas *canvas);
    /* Keep backdrop->place of `frame`. What was begun is undone by `forget`, also on failure. */
    enum bead_error (*keep)(struct bead_canvas *canvas, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                            struct bead_message *msg);
    void (*forget)(struct bead_canvas *canvas, struct bead_backdrop *backdrop);
    enum bead_error (*begin)(struct bead_canvas *canvas, struct bead_message *msg);
    void (*balls)(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count);
    void (*marks)(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count);
    enum bead_error (*end)(struct bead_canvas *canvas, struct bead_message *msg);
};

struct bead_canvas_driver {
    struct bead_canvas_backend info;
    const char *title;
    const struct bead_painting *painting;
    const struct bead_context_type *context; /* OpenGL's; NULL: needs none */
};

extern const struct bead_painting bead_painting_plain, bead_painting_gl;

struct bead_canvas {
    const struct bead_canvas_driver *driver;
    int width, height;
    struct bead_painter *painter;
    char description[160], credit[64];

    /* From begin to end; frame NULL: nothing is painted. */
    const struct bead_backdrop *backdrop;
    struct bead_frame *frame;
    struct bead_rect rect; /* of the backdrop */
};

#endif
