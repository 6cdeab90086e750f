/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: pixels in memory, copies of rectangles, their hash, and the list of rectangles that changed. */
#include "beadreel/render.h"

#include <stdlib.h>
#include <string.h>

#include "render/draw/picture.h"
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
