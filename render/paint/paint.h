/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paints balls and marks into a rectangle of a frame. Lengths in pixels, y downwards; positions need not be whole pixels.
 * Each time:  bead_paint_begin (backdrop) -> bead_paint_balls, bead_paint_marks, ... -> bead_paint_end.
 * The formulas for pixels are in assets/shaders; all back ends follow them. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "render/paint/canvas.h"

/* A sphere seen from the front, cut off at x = left and x = right (flattened by its neighbours). */
struct bead_ball {
    float x, y, r, left, right;
    uint8_t rgba[4];
};

enum bead_mark_kind {
    BEAD_MARK_BOX,     /* filled */
    BEAD_MARK_HATCHED, /* stripes at the distance shape[0] */
    BEAD_MARK_RING,    /* in the middle of the box: radius shape[0], width of line shape[1] */
    BEAD_MARK_ARROW,   /* a triangle that points right and fills the box */
    BEAD_MARK_GLOW,    /* an ellipse that fills the box, bright in the middle */
};

struct bead_mark {
    float box[4]; /* x0, y0, x1, y1; parts more than a pixel outside are not shown */
    float shape[4];
    float kind; /* enum bead_mark_kind */
    uint8_t rgba[4];
};

/* The background: a copy of a rectangle of a frame. */
struct bead_backdrop;

/* Keep rectangle `place` of `frame`. Painting uses this rectangle of a frame; its corner is (0, 0). Errors: GRAPHICS (it is
 * outside), IO, MEMORY. On failure *backdrop is NULL. */
BEAD_CHECK enum bead_error bead_backdrop_create(struct bead_canvas *canvas, const struct bead_frame *frame, struct bead_rect place,
                                                struct bead_backdrop **backdrop, struct bead_message *msg);
/* Destroy it before its canvas; NULL is allowed. */
void bead_backdrop_destroy(struct bead_canvas *canvas, struct bead_backdrop *backdrop);

/* Begin with the backdrop in `rect`, relative to the backdrop's corner; until the end only pixels in it change, and `frame` must
 * stay valid. Errors: GRAPHICS (also if `rect` is outside backdrop, canvas or frame), MEMORY; then do not call bead_paint_end. */
BEAD_CHECK enum bead_error bead_paint_begin(struct bead_canvas *canvas, const struct bead_backdrop *backdrop,
                                            struct bead_frame *frame, struct bead_rect rect, struct bead_message *msg);
/* Paint these in order, later ones over earlier ones. */
void bead_paint_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count);
void bead_paint_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count);
/* Finish: the frame now shows all. Errors: GRAPHICS, MEMORY. */
BEAD_CHECK enum bead_error bead_paint_end(struct bead_canvas *canvas, struct bead_message *msg);

struct bead_stage; /* stage.h */
/* Paint a prepared stage, except its first `skip` rows, at `place` of a frame. Not between begin and end: it has no background.
 * Fine stages are painted by the plain painter on any canvas. Errors: GRAPHICS, MEMORY. */
BEAD_CHECK enum bead_error bead_paint_stage(struct bead_canvas *canvas, const struct bead_stage *stage, struct bead_rect place,
                                            int skip, struct bead_frame *frame, struct bead_message *msg);
