/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wraps a frame's pixels in a cairo context, and reports what cairo could not draw. */
#include "render/draw/raster.h"

cairo_surface_t *bead_raster_surface(const struct bead_frame *frame)
{
    return cairo_image_surface_create_for_data(frame->pixels, frame->alpha ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, frame->width,
                                               frame->height, (int)frame->stride);
}

cairo_t *bead_raster_begin(const struct bead_frame *frame)
{
    cairo_surface_t *surface = bead_raster_surface(frame);
    cairo_t *cr = cairo_create(surface);
    cairo_surface_destroy(surface); /* the context keeps it */
    return cr;
}

enum bead_error bead_raster_end(cairo_t *cr, const char *what, struct bead_message *msg)
{
    cairo_status_t status = cairo_status(cr);
    cairo_surface_flush(cairo_get_target(cr));
    cairo_destroy(cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s: %s", what, cairo_status_to_string(status)) : BEAD_OK;
}

enum bead_error bead_raster_draw(const struct bead_frame *frame, bead_draw draw, void *context, struct bead_message *msg)
{
    cairo_t *cr = bead_raster_begin(frame);
    enum bead_error err = draw(context, cr, msg);
    enum bead_error drawn = bead_raster_end(cr, "picture", err ? NULL : msg);
    return err ? err : drawn;
}
