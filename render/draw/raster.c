/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wraps a frame's pixels in a cairo context, and reports what cairo could not draw; divides premultiplied colours by their alpha.
 */
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

enum bead_error bead_raster_status(cairo_t *cr, const char *what, struct bead_message *msg)
{
    const cairo_status_t status = cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "%s: %s", what, cairo_status_to_string(status)) : BEAD_OK;
}

enum bead_error bead_raster_end(cairo_t *cr, const char *what, struct bead_message *msg)
{
    const enum bead_error err = bead_raster_status(cr, what, msg);
    cairo_surface_flush(cairo_get_target(cr));
    cairo_destroy(cr);
    return err;
}

enum bead_error bead_raster_draw(const struct bead_frame *frame, bead_draw draw, void *context, struct bead_message *msg)
{
    cairo_t *cr = bead_raster_begin(frame);
    enum bead_error err = draw(context, cr, msg);
    enum bead_error drawn = bead_raster_end(cr, "picture", err ? NULL : msg);
    return err ? err : drawn;
}

static unsigned larger(unsigned a, unsigned b)
{
    return a > b ? a : b;
}

void bead_straight_rgba(const uint8_t *bgra, size_t count, uint8_t *rgba)
{
    for (size_t i = 0; i < count; i++, bgra += 4, rgba += 4) {
        unsigned alpha = larger(larger(bgra[0], bgra[1]), larger(bgra[2], bgra[3]));
        for (int c = 0; c < 3; c++)
            rgba[c] = (uint8_t)(alpha > 0 ? (255 * bgra[2 - c] + alpha / 2) / alpha : 0);
        rgba[3] = (uint8_t)alpha;
    }
}

enum bead_error bead_raster_indices(cairo_t *cr, struct bead_rect rect, const uint8_t *indices, const struct bead_colormap *map,
                                    struct bead_message *msg)
{
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, rect.width, rect.height);
    unsigned char *data = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image), width = (size_t)rect.width;
    for (size_t i = 0; data && i < width * (size_t)rect.height; i++) {
        const uint8_t *rgb = map->rgb[indices[i]];
        unsigned char *pixel = data + i / width * stride + 4 * (i % width);
        pixel[0] = rgb[2];
        pixel[1] = rgb[1];
        pixel[2] = rgb[0];
    }
    cairo_surface_mark_dirty(image);
    cairo_set_source_surface(cr, image, rect.x, rect.y);
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
    cairo_paint(cr);
    cairo_status_t status = cairo_surface_status(image);
    cairo_surface_destroy(image);
    status = status ? status : cairo_status(cr);
    return status ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "image: %s", cairo_status_to_string(status)) : BEAD_OK;
}
