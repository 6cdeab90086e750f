/* Loops over pixels, compiled for each vector instruction set and chosen at run time; the pixels are the same from all. */
#ifndef BEAD_RENDER_PIXEL_KERNELS_H
#define BEAD_RENDER_PIXEL_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/frame.h"
#include "render/paint.h"

/* What is painted on: a part of a frame whose rows begin at multiples of 64 bytes. Places of balls and marks count from `origin`.
 */
struct bead_ground {
    uint8_t *pixels; /* of the frame */
    size_t stride;
    int origin[2];         /* px of the frame */
    struct bead_rect clip; /* nothing else is touched; from the origin, within the frame */
};

struct bead_pixel_kernels {
    const char *name;
    /* In order, later ones over earlier ones. What is not finite, or no larger than nothing, is not shown. */
    void (*balls)(const struct bead_ground *ground, const struct bead_ball *balls, size_t count);
    void (*marks)(const struct bead_ground *ground, const struct bead_mark *marks, size_t count);
    /* Two rows of a frame (B G R X), one of chroma; `width` a multiple of 16, `y` and `bgrx` at multiples of 16 bytes. */
    void (*yuv420)(const uint8_t *const bgrx[2], uint8_t *const y[2], uint8_t *u, uint8_t *v, int width);
};

/* sse2, avx2 or avx512, or the best (NULL). NULL: there is none of that name, or not on this machine. */
const struct bead_pixel_kernels *bead_pixel_kernels_find(const char *name);

#endif
