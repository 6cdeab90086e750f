/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_<set>.c, which defines KERNELS_NAME and KERNELS_TABLE. Paints like assets/shaders, with the same order
 * of operations, and with 8-bit blending like that of Mesa's llvmpipe. */

#include "render/paint/pixel_kernels.h"
#include "render/paint/pixel_kernels_vector.h"

static inline words_anywhere *pixels_at(const struct bead_ground *g, int x, int y)
{
    return (words_anywhere *)(g->pixels + (size_t)(g->origin[1] + y) * g->stride + 4 * (ptrdiff_t)(g->origin[0] + x));
}

/* The last pixel of a row at which a vector may begin. No row is shorter than a vector. */
static inline int last_start(const struct bead_ground *g)
{
    return (int)(g->stride / 4) - g->origin[0] - LANES;
}

/* x of the centres of the pixels. */
static inline reals middles(int x)
{
    return (float)x + ((reals){COUNT} + 0.5f);
}

/* Pixels first..end - 1. */
struct run {
    int first, end;
};

/* Inline, as the library's functions cost a call. If `a` is NaN, the result is `b`. */
static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

/* The first pixel whose centre is at `x` or after it, within low..high, which are not negative. */
static inline int pixel_from(float x, int low, int high)
{
    const float at = least(most(x - 0.5f, (float)low), (float)high);
    return (int)at + ((float)(int)at < at);
}

/* The pixels with centres at or after `from` and before `to`, within first..first + length - 1. */
static inline struct run run_of(float from, float to, int first, int length)
{
    return (struct run){pixel_from(from, first, first + length), pixel_from(to, first, first + length)};
}

/* `cover` for pixels in the run, 0 for others. */
static inline reals keep_run(reals cover, reals x, struct run run)
{
    return (reals)((ints)cover & (x > (float)run.first) & (x < (float)run.end));
}

/* premultiplied + (1 - cover) * ground, for two colours of each pixel at once: a product p of two levels is divided by 255 as
 * (p + p / 256 + 128) / 256. */
static inline pairs blend_pairs(pairs paint, pairs ground, pairs rest, bool saturate)
{
    pairs p = ground * rest;
    p = ((p + (p >> 8) + 128) >> 8) + paint;
    if (saturate) {
        pairs too_much = (pairs)((signed_pairs)p > 255);
        p = (p & ~too_much) | (too_much & 255);
    }
    return p;
}

/* Premultiplied levels over pixels. */
static inline void blend(words_anywhere *pixels, const words bgr[3], words cover, bool saturate)
{
    const words ground = *pixels;
    const pairs even = (pairs)(ground & 0xff00ff), odd = (pairs)ground >> 8, rest = 255 - pair_of(cover, cover);
    pairs blue_red = blend_pairs(pair_of(bgr[0], bgr[2]), even, rest, saturate);
    pairs green_cover = blend_pairs(pair_of(bgr[1], cover), odd, rest, saturate);
    *pixels = (words)(blue_red | green_cover << 8);
}

#include "render/paint/pixel_kernels_balls.h"
#include "render/paint/pixel_kernels_curve.h"
#include "render/paint/pixel_kernels_marks.h"
#include "render/paint/pixel_kernels_stage.h"
#include "render/paint/pixel_kernels_yuv.h"

extern const struct bead_pixel_kernels KERNELS_TABLE;
const struct bead_pixel_kernels KERNELS_TABLE = {KERNELS_NAME, paint_balls, paint_marks,   paint_way,
                                                 stage_floor,  stage_rows,  curve_columns, two_rows_to_yuv420};
