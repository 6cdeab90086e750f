/* Painter: balls and marks into a canvas. All lengths in pixels of the canvas, y downwards; positions need not be whole pixels.
 * Within one rectangle:  bead_paint_begin (backdrop) -> bead_paint_balls, bead_paint_marks, ... -> bead_canvas_read. */
#ifndef BEAD_RENDER_PAINT_H
#define BEAD_RENDER_PAINT_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/canvas.h"
#include "render/gl.h"

struct bead_painter;

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
    BEAD_MARK_ZOOM,    /* from shape[0]..shape[1] at the top of the box to shape[2]..shape[3] at its bottom */
};

struct bead_mark {
    float box[4]; /* x0, y0, x1, y1 */
    float shape[4];
    float kind; /* enum bead_mark_kind */
    uint8_t rgba[4];
};

/* What lies behind: a rectangle of a frame, kept in the canvas. Zeroed: none. */
struct bead_backdrop {
    GLuint texture, framebuffer;
};

/* Upload `rect` of `frame`; its corner becomes (0, 0). Frees what was there. Errors: GRAPHICS, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_backdrop_set(struct bead_canvas *canvas, struct bead_backdrop *backdrop,
                                             const struct bead_frame *frame, struct bead_rect rect, struct bead_message *msg);
void bead_backdrop_free(struct bead_canvas *canvas, struct bead_backdrop *backdrop);

/* Until the next begin only pixels inside `rect` are touched; they show the backdrop now. Errors: GRAPHICS, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_paint_begin(struct bead_canvas *canvas, const struct bead_backdrop *backdrop, struct bead_rect rect,
                                            struct bead_message *msg);
/* In order, later ones over earlier ones. */
void bead_paint_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count);
void bead_paint_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count);

void bead_painter_destroy(struct bead_painter *painter, const struct bead_gl *gl);

#endif
