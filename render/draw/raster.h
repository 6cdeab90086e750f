/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing into the pixels of frames with cairo.
 *
 *   cairo_t *cr = bead_raster_begin(&frame);
 *   ...
 *   err = bead_raster_end(cr, "curves", &msg); */
#ifndef BEADREEL_RENDER_DRAW_RASTER_H
#define BEADREEL_RENDER_DRAW_RASTER_H

#include "beadreel/picture.h"

/* A surface of the frame's pixels, which must outlive it. */
cairo_surface_t *bead_raster_surface(const struct bead_frame *frame);
/* The frame's pixels must outlive the context. */
cairo_t *bead_raster_begin(const struct bead_frame *frame);
/* Destroys the context; everything drawn is in the frame. Errors: GRAPHICS if something was not drawn; `what` names it. */
BEAD_CHECK enum bead_error bead_raster_end(cairo_t *cr, const char *what, struct bead_message *msg);
/* Errors: those of `draw`, GRAPHICS. */
BEAD_CHECK enum bead_error bead_raster_draw(const struct bead_frame *frame, bead_draw draw, void *context,
                                            struct bead_message *msg);

#endif
