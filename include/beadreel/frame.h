/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: pixels in memory, and which of them changed. */
#ifndef BEADREEL_FRAME_H
#define BEADREEL_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"

BEAD_BEGIN

/* Device pixels, y downwards. */
struct bead_rect {
    int x, y, width, height;
};

/* 32 bits a pixel, B G R X in memory (CAIRO_FORMAT_RGB24 on little-endian machines), rows from the top. With `alpha` the fourth
 * byte says how much of what is behind the pixel hides, and colours are premultiplied with it (CAIRO_FORMAT_ARGB32); light that is
 * added may be more than that. */
struct bead_frame {
    int width, height;
    size_t stride; /* bytes a row, a multiple of 64 */
    uint8_t *pixels;
    bool alpha; /* as created: false */
};

/* Rectangles changed since the frame before; those that overlap much, and more than fit, are merged into bounding boxes. */
struct bead_changes {
    size_t count;
    struct bead_rect rect[32];
};

/* Pixels are zeroed and belong to the frame. */
BEAD_API BEAD_CHECK enum bead_error bead_frame_create(int width, int height, struct bead_frame *frame, struct bead_message *msg);
BEAD_API void bead_frame_free(struct bead_frame *frame);
/* Copy a rectangle (clipped) between frames of the same size. */
BEAD_API void bead_frame_copy(struct bead_frame *to, const struct bead_frame *from, struct bead_rect rect);
/* FNV-1a over the visible bytes (B, G, R of every pixel, and alpha). */
BEAD_API uint64_t bead_frame_hash(const struct bead_frame *frame);
BEAD_API void bead_changes_add(struct bead_changes *changes, struct bead_rect rect);

BEAD_END

#endif
