/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: pixels in memory, copies of rectangles, their hash, the list of rectangles that changed; and cairo on their pixels. */
#include "beadreel/render.h"

#include <glib.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/picture.h"
#include "render/draw/raster.h"
#include "sim/base/memory.h"

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int most(int a, int b)
{
    return a > b ? a : b;
}

/* Cairo allows at most 32767 pixels a side. */
enum { LARGEST_SIDE = 32767, ALIGNMENT = 64, SMALL = 1 << 20 };

enum bead_error bead_frame_create(int width, int height, struct bead_frame *frame, struct bead_message *msg)
{
    *frame = (struct bead_frame){0};
    if (width < 1 || height < 1 || width > LARGEST_SIDE || height > LARGEST_SIDE)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a picture of %d x %d pixels: its sides can be 1 to %d pixels", width, height,
                         LARGEST_SIDE);
    size_t stride = ((size_t)width * 4 + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    size_t bytes = stride * (size_t)height;
    uint8_t *pixels = bytes < SMALL ? aligned_alloc(ALIGNMENT, bytes) : bead_large_take(bytes); /* whole pages */
    if (!pixels)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a picture of %d x %d pixels", width, height);
    memset(pixels, 0, bytes);
    frame->width = width;
    frame->height = height;
    frame->stride = stride;
    frame->pixels = pixels;
    return BEAD_OK;
}

void bead_frame_free(struct bead_frame *frame)
{
    free(frame->pixels);
    *frame = (struct bead_frame){0};
}

void bead_frame_copy(struct bead_frame *to, const struct bead_frame *from, struct bead_rect rect)
{
    int left = most(rect.x, 0), top = most(rect.y, 0);
    int right = least(rect.x + rect.width, least(to->width, from->width));
    int bottom = least(rect.y + rect.height, least(to->height, from->height));
    if (right <= left)
        return;
    for (int y = top; y < bottom; y++)
        memcpy(to->pixels + (size_t)y * to->stride + 4 * (size_t)left, from->pixels + (size_t)y * from->stride + 4 * (size_t)left,
               4 * (size_t)(right - left));
}

uint64_t bead_frame_hash(const struct bead_frame *frame)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *row = frame->pixels + (size_t)y * frame->stride;
        for (int x = 0; x < frame->width; x++) {
            for (int c = 0; c < (frame->alpha ? 4 : 3); c++)
                hash = (hash ^ row[4 * x + c]) * 0x100000001b3u;
        }
    }
    return hash;
}

static struct bead_rect bounding_box(struct bead_rect a, struct bead_rect b)
{
    int x = least(a.x, b.x), y = least(a.y, b.y);
    return (struct bead_rect){x, y, most(a.x + a.width, b.x + b.width) - x, most(a.y + a.height, b.y + b.height) - y};
}

static int64_t area(struct bead_rect r)
{
    return (int64_t)r.width * r.height;
}

/* A rectangle is merged with the one whose area grows least, if it does not grow at all or the list is full: distant movements keep
 * separate rectangles. */
void bead_changes_add(struct bead_changes *changes, struct bead_rect rect)
{
    const size_t room = sizeof changes->rect / sizeof changes->rect[0];
    if (rect.width <= 0 || rect.height <= 0)
        return;
    size_t best = 0;
    int64_t added = INT64_MAX;
    for (size_t i = 0; i < changes->count; i++) {
        int64_t more = area(bounding_box(changes->rect[i], rect)) - area(changes->rect[i]) - area(rect);
        best = more < added ? i : best;
        added = more < added ? more : added;
    }
    if (changes->count == 0 || (added > 0 && changes->count < room))
        changes->rect[changes->count++] = rect;
    else
        changes->rect[best] = bounding_box(changes->rect[best], rect);
}

/* Wraps a frame's pixels in a cairo context, and reports what cairo could not draw; divides premultiplied colours by their alpha.
 */

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

/* Warnings of the libraries that draw become errors of the picture being drawn. */

/* Per thread: the handler has no other way to reach the thread that draws. */
static _Thread_local char first[200];
static GLogFunc others;

static void keep(const gchar *domain, GLogLevelFlags level, const gchar *text, gpointer data)
{
    /* After a fatal one GLib aborts. */
    if (level & G_LOG_FLAG_FATAL || !(level & (G_LOG_LEVEL_ERROR | G_LOG_LEVEL_CRITICAL | G_LOG_LEVEL_WARNING)))
        others(domain, level, text, data);
    else if (!*first)
        snprintf(first, sizeof first, "%s%s%s", domain ? domain : "", domain ? ": " : "", text);
}

static void replace_handler(void)
{
    others = g_log_set_default_handler(keep, NULL);
}

void bead_warnings_watch(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, replace_handler);
    first[0] = '\0';
}

enum bead_error bead_warnings_check(struct bead_message *msg)
{
    return *first ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "a picture was not drawn correctly: %s", first) : BEAD_OK;
}
