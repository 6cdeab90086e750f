/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing into the pixels of frames with cairo.
 *
 *   cairo_t *cr = bead_raster_begin(&frame);
 *   ...
 *   err = bead_raster_end(cr, "curves", &msg); */
#pragma once

#include "beadreel/error.h"
#include "beadreel/view.h"
#include "render/draw/picture.h"

/* A surface of the frame's pixels, which must outlive it. */
cairo_surface_t *bead_raster_surface(const struct bead_frame *frame);
/* The frame's pixels must outlive the context. */
cairo_t *bead_raster_begin(const struct bead_frame *frame);
/* Was everything drawn? `what` names it. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_raster_status(cairo_t *cr, const char *what, struct bead_message *msg);
/* The same, and destroys the context; everything drawn is in the frame. */
BEAD_CHECK enum bead_error bead_raster_end(cairo_t *cr, const char *what, struct bead_message *msg);
/* Errors: those of `draw`, GRAPHICS. */
BEAD_CHECK enum bead_error bead_raster_draw(const struct bead_frame *frame, bead_draw draw, void *context,
                                            struct bead_message *msg);

/* Draws colour map indices, [height][width], as pixels; vector files keep them sharp. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_raster_indices(cairo_t *cr, struct bead_rect rect, const uint8_t *indices,
                                               const struct bead_colormap *map, struct bead_message *msg);

/* Straight from premultiplied colours, as files of pictures and movies need them: converts `count` pixels B G R A of a frame with
 * alpha (render.h) to straight R G B A. Added light covers as much as its brightest channel. Fully transparent pixels are black. */
void bead_straight_rgba(const uint8_t *bgra, size_t count, uint8_t *rgba);

/* Warnings of GLib, Pango and cairo become errors: they would only warn if, say, a font cannot be opened, and draw boxes for
 * letters.
 *
 *   bead_warnings_watch();   ... draw, in this thread ...   err = bead_warnings_check(msg);
 *
 * GLib has one default handler of messages per process; it is replaced once, for good, by one that passes on all but warnings. */

/* Forgets earlier warnings in this thread and watches for new ones. */
void bead_warnings_watch(void);
/* Errors: GRAPHICS (with the first warning since). */
BEAD_CHECK enum bead_error bead_warnings_check(struct bead_message *msg);
