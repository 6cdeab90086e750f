/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes PNG through libpng, with fast settings for flat colours (no filter, because rows repeat), exact colours, notes. */
#include <errno.h>
#include <glib.h>
#include <png.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "render/draw/picture.h"
#include "render/draw/raster.h"
#include "sim/base/file.h"
#include "sim/base/memory.h"

struct writer {
    png_structp png;
    png_infop info;
    uint8_t *row;
    char error[160];
    jmp_buf jump;
};

/* The picture to write: indices with a palette, or a frame. */
struct image {
    int width, height;
    const uint8_t *indices; /* NULL: RGB, or RGBA, from the frame */
    const struct bead_frame *frame;
    png_color palette[256];
    int colours;
    const struct bead_picture_notes *notes;
};

static void on_error(png_structp png, png_const_charp text)
{
    struct writer *w = png_get_error_ptr(png);
    snprintf(w->error, sizeof w->error, "%s", text);
    longjmp(w->jump, 1);
}

static void on_warning(png_structp, png_const_charp) {}

static void on_write(png_structp png, png_bytep data, size_t length)
{
    FILE *file = png_get_io_ptr(png);
    if (fwrite(data, 1, length, file) != length)
        png_error(png, strerror(errno));
}

static void put_notes(struct writer *w, const struct bead_picture_notes *notes)
{
    const struct {
        const char *key, *text;
    } all[] = {
        {"Title", notes->title}, {"Description", notes->description}, {"Software", notes->software}, {"Source", notes->source}};
    enum { LONG = 1000 };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (!all[i].text || !*all[i].text)
            continue;
        png_text chunk = {.key = (png_charp)all[i].key, .text = (png_charp)all[i].text};
        bool is_long = strlen(chunk.text) > LONG, ascii = g_str_is_ascii(chunk.text);
        chunk.compression = ascii ? (is_long ? PNG_TEXT_COMPRESSION_zTXt : PNG_TEXT_COMPRESSION_NONE)
                                  : (is_long ? PNG_ITXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_NONE);
        if (ascii)
            chunk.text_length = strlen(chunk.text);
        else
            chunk.itxt_length = strlen(chunk.text);
        png_set_text(w->png, w->info, &chunk, 1);
    }
    if (notes->dpi > 0 && notes->dpi < 1e6) {
        png_uint_32 per_metre = (png_uint_32)(notes->dpi / 0.0254 + 0.5);
        png_set_pHYs(w->png, w->info, per_metre, per_metre, PNG_RESOLUTION_METER);
    }
}

static void put_header(struct writer *w, const struct image *image)
{
    png_set_IHDR(w->png, w->info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 image->indices        ? PNG_COLOR_TYPE_PALETTE
                 : image->frame->alpha ? PNG_COLOR_TYPE_RGBA
                                       : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (image->indices)
        png_set_PLTE(w->png, w->info, image->palette, image->colours);
    png_set_sRGB_gAMA_and_cHRM(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    put_notes(w, image->notes);
    png_set_compression_level(w->png, 1);
    png_set_compression_strategy(w->png, Z_DEFAULT_STRATEGY);
    png_set_filter(w->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_write_info(w->png, w->info);
}

static void png_put_rows(struct writer *w, const struct image *image)
{
    if (!image->indices && !image->frame->alpha) {
        png_set_filler(w->png, 0, PNG_FILLER_AFTER);
        png_set_bgr(w->png);
    }
    for (size_t y = 0; y < (size_t)image->height; y++) {
        const uint8_t *row =
            image->indices ? image->indices + y * (size_t)image->width : image->frame->pixels + y * image->frame->stride;
        if (!image->indices && image->frame->alpha) {
            bead_straight_rgba(row, (size_t)image->width, w->row);
            row = w->row;
        }
        png_write_row(w->png, row);
    }
    png_write_end(w->png, w->info);
}

/* All calls of libpng that may longjmp. */
static enum bead_error png_encode(struct writer *w, const struct image *image, FILE *file, const char *part,
                                  struct bead_message *msg)
{
    if (setjmp(w->jump))
        return bead_fail(msg, BEAD_ERROR_IO, "%s: %s", part, w->error);
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    w->info = w->png ? png_create_info_struct(w->png) : NULL;
    w->row = malloc(4 * (size_t)image->width);
    if (!w->info || !w->row)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for a PNG encoder", part);
    png_set_write_fn(w->png, file, on_write, NULL);
    put_header(w, image);
    png_put_rows(w, image);
    return BEAD_OK;
}

static enum bead_error png_fill(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    struct writer *w = calloc(1, sizeof *w);
    if (!w)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for a PNG encoder", part);
    enum bead_error err = png_encode(w, context, file, part, msg);
    png_destroy_write_struct(&w->png, &w->info);
    free(w->row);
    free(w);
    return err;
}

/* Colours found so far, in an open hash table. */
struct colours {
    uint32_t colour[1024]; /* with the top bit set if taken */
    uint8_t index[1024];
    uint32_t last;
    uint8_t last_index;
    struct image *image;
};

/* Index of a colour; -1 if it would be the 257th. */
static int colour_index(struct colours *c, uint32_t colour)
{
    const uint32_t taken = 0x80000000u;
    if (c->last == (colour | taken))
        return c->last_index;
    uint32_t at = colour * 2654435761u >> 22;
    while (c->colour[at] && c->colour[at] != (colour | taken))
        at = (at + 1) % 1024;
    if (!c->colour[at]) {
        if (c->image->colours == 256)
            return -1;
        c->colour[at] = colour | taken;
        c->index[at] = (uint8_t)c->image->colours;
        c->image->palette[c->image->colours++] =
            (png_color){(png_byte)(colour >> 16), (png_byte)(colour >> 8 & 255), (png_byte)(colour & 255)};
    }
    c->last = colour | taken;
    return c->last_index = c->index[at];
}

/* False if the frame has more than 256 colours. */
static bool find_palette(const struct bead_frame *frame, uint8_t *indices, struct image *image)
{
    struct colours colours = {.image = image};
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *row = frame->pixels + (size_t)y * frame->stride;
        for (int x = 0; x < frame->width; x++) {
            int index =
                colour_index(&colours, (uint32_t)row[4 * x] | (uint32_t)row[4 * x + 1] << 8 | (uint32_t)row[4 * x + 2] << 16);
            if (index < 0)
                return false;
            *indices++ = (uint8_t)index;
        }
    }
    return true;
}

enum bead_error bead_png_write(const char *path, const struct bead_frame *frame, const struct bead_picture_notes *notes,
                               uint64_t *bytes, struct bead_message *msg)
{
    struct bead_picture_notes own;
    BEAD_TRY(bead_notes_take(&own, notes, msg));
    struct image image = {.width = frame->width, .height = frame->height, .frame = frame, .notes = &own};
    if (frame->alpha)
        return bead_file_write(path, png_fill, &image, bytes, msg);
    BEAD_FREED uint8_t *indices = bead_large_take((size_t)frame->width * (size_t)frame->height);
    if (!indices)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for %d x %d pixels", path, frame->width, frame->height);
    if (find_palette(frame, indices, &image))
        image.indices = indices;
    return bead_file_write(path, png_fill, &image, bytes, msg);
}

enum bead_error bead_png_write_indexed(const char *path, int width, int height, const uint8_t *indices,
                                       const uint8_t palette[256][3], const struct bead_picture_notes *notes, uint64_t *bytes,
                                       struct bead_message *msg)
{
    struct bead_picture_notes own;
    BEAD_TRY(bead_notes_take(&own, notes, msg));
    struct image image = {.width = width, .height = height, .indices = indices, .colours = 256, .notes = &own};
    for (int i = 0; i < 256; i++)
        image.palette[i] = (png_color){palette[i][0], palette[i][1], palette[i][2]};
    return bead_file_write(path, png_fill, &image, bytes, msg);
}
