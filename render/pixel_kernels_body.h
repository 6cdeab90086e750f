/* Included by pixel_kernels_<set>.c, which defines KERNELS_NAME and KERNELS_TABLE. The formulas are those of assets/shaders, in the
 * same order, with 8-bit blending as Mesa's llvmpipe has it. */
#include <math.h>

#include "render/pixel_kernels.h"
#include "render/pixel_kernels_vector.h"

/* A vector of neighbouring pixels, at a multiple of its size in the frame's row: so it never reaches into another row. */
static inline ints *vector_at(const struct bead_ground *g, int x, int y)
{
    return (ints *)(g->pixels + (size_t)(g->origin[1] + y) * g->stride + 4 * (ptrdiff_t)(g->origin[0] + x));
}

/* The first pixel of the vector that has pixel x in it. */
static inline int vector_start(const struct bead_ground *g, int x)
{
    return x - (g->origin[0] + x) % LANES;
}

/* x of the middles of the pixels. */
static inline reals middles(int x)
{
    return (float)x + ((reals){COUNT} + 0.5f);
}

/* Pixels first..end - 1. */
struct run {
    int first, end;
};

/* Those whose middles are from `from` on and before `to`, within first..first + length - 1. */
static inline struct run run_of(float from, float to, int first, int length)
{
    float low = fmaxf(ceilf(from - 0.5f), (float)first), high = fminf(ceilf(to - 0.5f), (float)first + (float)length);
    return low < high ? (struct run){(int)low, (int)high} : (struct run){0, 0};
}

/* 1 for pixels of the run, 0 for others. */
static inline reals within_run(reals x, struct run run)
{
    const reals one = all(1);
    return (reals)((ints)one & (x > (float)run.first) & (x < (float)run.end));
}

/* premultiplied + (1 - cover) * what is there, of two colours of each pixel in 16 bits: a product p of two levels is divided by 255
 * as (p + p / 256 + 128) / 256. */
static inline ints blend_pairs(ints paint, ints ground, ints rest, bool saturate)
{
    pairs p = (pairs)ground * (pairs)rest;
    p = (p + (p >> 8) + 128) >> 8;
    p += (pairs)paint;
    if (saturate) {
        signed_pairs too_much = (signed_pairs)p > 255;
        p = (p & ~(pairs)too_much) | ((pairs)too_much & 255);
    }
    return (ints)p;
}

/* Premultiplied levels over pixels. */
static inline void blend(ints *pixels, const ints bgr[3], ints cover, bool saturate)
{
    const int even = 0x00ff00ff;
    ints ground = *pixels, rest = 255 - cover;
    rest |= rest << 16;
    ints blue_red = blend_pairs(bgr[0] | bgr[2] << 16, ground & even, rest, saturate);
    ints green_cover = blend_pairs(bgr[1] | cover << 16, ground >> 8 & even, rest, saturate);
    *pixels = blue_red | green_cover << 8;
}

#include "render/pixel_kernels_balls.h"
#include "render/pixel_kernels_marks.h"

extern const struct bead_pixel_kernels KERNELS_TABLE;
const struct bead_pixel_kernels KERNELS_TABLE = {KERNELS_NAME, paint_balls, paint_marks};
