/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loops over pixels, compiled for each vector instruction set and chosen at run time. All give the same pixels. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "beadreel/render.h"
#include "render/paint/paint.h"
#include "render/paint/stage.h"

/* The part of a frame to paint on. Rows begin at multiples of 64 bytes. Places of balls and marks are relative to `origin`. */
struct bead_ground {
    uint8_t *pixels; /* of the frame */
    size_t stride;
    int origin[2];         /* px of the frame */
    struct bead_rect clip; /* pixels that may change; relative to the origin, within the frame */
};

/* A curve with the area below it, in 64 columns of pixels that begin at a multiple of 64 bytes. A pixel shows the mean of the
 * slices of its column, which reach from y = low (above) to high (below), px; low = INFINITY, high = -INFINITY: nothing. */
enum { BEAD_COLUMNS = 64, BEAD_SLICES = 4, BEAD_COLUMN_GROUP = 16 };
struct bead_extents {
    float low[BEAD_SLICES][BEAD_COLUMNS], high[BEAD_SLICES][BEAD_COLUMNS];
};
struct bead_columns {
    struct bead_extents line, area;
    int from[BEAD_COLUMNS / BEAD_COLUMN_GROUP], to[BEAD_COLUMNS / BEAD_COLUMN_GROUP]; /* rows that a group of columns needs */
    float over[4], under[4], area_alpha;                                              /* colours of both: B G R A, 0..255 */
    int channels; /* of the colours; 3: the fourth byte of pixels stays */
};

struct bead_pixel_kernels {
    const char *name;
    /* In order, later ones over earlier ones. Those that are not finite or have no area are skipped. */
    void (*balls)(const struct bead_ground *ground, const struct bead_ball *balls, size_t count);
    void (*marks)(const struct bead_ground *ground, const struct bead_mark *marks, size_t count);
    /* The strip between a magnified part and its lens, from shape[0]..shape[1] at the top of the box to shape[2]..shape[3] at its
     * bottom; any kind. */
    void (*zoom)(const struct bead_ground *ground, const struct bead_mark *way);
    /* A prepared stage (stage.h): its floor's grid; then its picture, whose corner is the ground's origin. */
    void (*stage_floor)(const struct bead_stage *stage);
    void (*stage)(const struct bead_ground *ground, const struct bead_stage *stage);
    /* `pixels`: the row y = 0. Groups without rows do not change. */
    void (*curve)(const struct bead_columns *columns, uint8_t *pixels, size_t stride);
    /* Two rows of a frame (B G R X), one of chroma; `width` a multiple of 16, `y` and `bgrx` at multiples of 16 bytes. */
    void (*yuv420)(const uint8_t *const bgrx[2], uint8_t *const y[2], uint8_t *u, uint8_t *v, int width);
};

/* portable, sse2, avx2 or avx512, or the best (NULL). Returns NULL if the name is unknown, or not available on this machine. */
const struct bead_pixel_kernels *bead_pixel_kernels_find(const char *name);
