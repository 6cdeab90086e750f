/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of a canvas: its back end, a const table, and the current painting. No GL headers here. */
#pragma once

#include "render/paint/canvas.h"
#include "render/paint/paint.h"
#include "render/paint/pixel_kernels.h"

struct bead_painter;      /* of OpenGL */
struct bead_context_type; /* gl_context.h */

/* A copy of a rectangle of a frame. */
struct bead_backdrop {
    struct bead_rect place;        /* in the frame; its corner is the painter's (0, 0) */
    struct bead_frame copy;        /* plain */
    unsigned texture, framebuffer; /* OpenGL */
};

/* The functions behind those of paint.h, which check the arguments. Errors: GRAPHICS, IO, MEMORY. */
struct bead_painting {
    /* Prepare and describe the canvas. A failure leaves nothing to close. */
    enum bead_error (*open)(struct bead_canvas *canvas, struct bead_message *msg);
    void (*close)(struct bead_canvas *canvas);
    /* Keep backdrop->place of `frame`. `forget` undoes this, also after a failure. */
    enum bead_error (*keep)(struct bead_canvas *canvas, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                            struct bead_message *msg);
    void (*forget)(struct bead_canvas *canvas, struct bead_backdrop *backdrop);
    enum bead_error (*begin)(struct bead_canvas *canvas, struct bead_message *msg);
    void (*balls)(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count);
    void (*marks)(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count);
    enum bead_error (*end)(struct bead_canvas *canvas, struct bead_message *msg);
    enum bead_error (*stage)(struct bead_canvas *canvas, const struct bead_stage *stage, const struct bead_ground *ground,
                             struct bead_message *msg);
};

struct bead_canvas_driver {
    struct bead_canvas_backend info;
    const char *title;
    const struct bead_painting *painting;
    const struct bead_context_type *context; /* of OpenGL; NULL: none */
};

extern const struct bead_painting bead_painting_plain, bead_painting_gl;

struct bead_canvas {
    const struct bead_canvas_driver *driver;
    int width, height;
    struct bead_painter *painter; /* NULL: none */
    char description[160], credit[64];

    /* Between begin and end; frame NULL: not painting. */
    const struct bead_backdrop *backdrop;
    struct bead_frame *frame;
    struct bead_rect rect; /* of the backdrop */
};
