/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Painter: balls and marks into a rectangle of a frame. Lengths in pixels, y downwards; positions need not be whole pixels.
 * Each time:  bead_paint_begin (backdrop) -> bead_paint_balls, bead_paint_marks, ... -> bead_paint_end.
 * assets/shaders has the formulas of what a pixel looks like; every way of painting follows them. */
#ifndef BEADREEL_RENDER_PAINT_PAINT_H
#define BEADREEL_RENDER_PAINT_PAINT_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/canvas.h"

/* A sphere seen from the front, shown between x = left and x = right (flattened where it touches its neighbours). */
struct bead_ball {
    float x, y, r, left, right;
    uint8_t rgba[4];
};

enum bead_mark_kind {
    BEAD_MARK_BOX,     /* filled */
    BEAD_MARK_HATCHED, /* stripes, shape[0] their distance */
    BEAD_MARK_RING,    /* in the middle of the box: radius shape[0], width of line shape[1] */
    BEAD_MARK_ARROW,   /* a triangle that points right and fills the box */
    BEAD_MARK_GLOW,    /* an ellipse that fills the box, bright in the middle */
};

struct bead_mark {
    float box[4]; /* x0, y0, x1, y1; what reaches out of it by more than a pixel is not shown */
    float shape[4];
    float kind; /* enum bead_mark_kind */
    uint8_t rgba[4];
};

/* What lies behind: a rectangle of a frame as it was. */
struct bead_backdrop;

/* Keep rectangle `place` of `frame`; painting goes to that place of a frame, and its corner is (0, 0). Errors: GRAPHICS (it lies
 * outside), IO, MEMORY. On failure *backdrop is NULL. */
BEAD_CHECK enum bead_error bead_backdrop_create(struct bead_canvas *canvas, const struct bead_frame *frame, struct bead_rect place,
                                                struct bead_backdrop **backdrop, struct bead_message *msg);
/* Before its canvas; NULL is allowed. */
void bead_backdrop_destroy(struct bead_canvas *canvas, struct bead_backdrop *backdrop);

/* Until the end only pixels inside `rect` of the backdrop are touched, and `frame` must stay; they show the backdrop now. Errors:
 * GRAPHICS (also where `rect` lies outside of backdrop, canvas or frame), MEMORY; after these there is nothing to end. */
BEAD_CHECK enum bead_error bead_paint_begin(struct bead_canvas *canvas, const struct bead_backdrop *backdrop,
                                            struct bead_frame *frame, struct bead_rect rect, struct bead_message *msg);
/* In order, later ones over earlier ones. */
void bead_paint_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count);
void bead_paint_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count);
/* The frame has it all. Errors: GRAPHICS, MEMORY. */
BEAD_CHECK enum bead_error bead_paint_end(struct bead_canvas *canvas, struct bead_message *msg);

#endif
