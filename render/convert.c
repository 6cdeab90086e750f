#include "render/convert.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A block is 16 pixels wide: one cache line of BGRX, and a fixed number for the compiler to make vectors of. */
enum { BLOCK = 16 };

/* BT.709, limited range, from full-range R'G'B' 0..255 (ITU-R BT.709-6, items 3.2-3.5 for 8 bits):
 *   Y  =  16 + 219/255 (0.2126 R + 0.7152 G + 0.0722 B)
 *   Cb = 128 + 224/255 (B - Y') / 1.8556,   Cr = 128 + 224/255 (R - Y') / 1.5748
 * times 2^16, rounded so that greys have no colour and white is exactly 235. */
enum {
    YR = 11966,
    YG = 40254,
    YB = 4064,
    UR = -6596,
    UG = -22189,
    UB = 28785,
    VR = 28785,
    VG = -26145,
    VB = -2640,
    FRACTION = 16,
    LUMA_BASE = (16 << FRACTION) + (1 << (FRACTION - 1)),
    /* Chroma is of the sum of four pixels. */
    CHROMA_FRACTION = FRACTION + 2,
    CHROMA_BASE = (128 << CHROMA_FRACTION) + (1 << (CHROMA_FRACTION - 1)),
};
_Static_assert(UR + UG + UB == 0 && VR + VG + VB == 0, "greys have no colour");
_Static_assert((LUMA_BASE + 255 * (YR + YG + YB)) >> FRACTION == 235, "white is 235");

#define INLINE static inline __attribute__((always_inline))

INLINE void load_block(const uint8_t *from, int32_t pixel[BLOCK])
{
    memcpy(pixel, from, BLOCK * sizeof *pixel);
}

INLINE void luma_block(const int32_t pixel[BLOCK], uint8_t *to)
{
    for (int i = 0; i < BLOCK; i++) {
        int32_t b = pixel[i] & 255, g = pixel[i] >> 8 & 255, r = pixel[i] >> 16 & 255;
        to[i] = (uint8_t)((LUMA_BASE + YR * r + YG * g + YB * b) >> FRACTION);
    }
}

/* The mean of each 2 x 2 pixels: the filter that neither shifts nor rings. */
INLINE void chroma_block(const int32_t above[BLOCK], const int32_t below[BLOCK], uint8_t *u, uint8_t *v)
{
    int32_t rb[BLOCK], g[BLOCK];
    for (int i = 0; i < BLOCK; i++) {
        rb[i] = (above[i] & 0xff00ff) + (below[i] & 0xff00ff);
        g[i] = (above[i] >> 8 & 255) + (below[i] >> 8 & 255);
    }
    for (int i = 0; i < BLOCK / 2; i++) {
        int32_t both = rb[2 * i] + rb[2 * i + 1], green = g[2 * i] + g[2 * i + 1];
        int32_t blue = both & 0xffff, red = both >> 16;
        u[i] = (uint8_t)((CHROMA_BASE + UR * red + UG * green + UB * blue) >> CHROMA_FRACTION);
        v[i] = (uint8_t)((CHROMA_BASE + VR * red + VG * green + VB * blue) >> CHROMA_FRACTION);
    }
}

INLINE void yuv420_rows(const uint8_t *above, const uint8_t *below, uint8_t *y0, uint8_t *y1, uint8_t *u, uint8_t *v, int width)
{
    for (int x = 0; x < width; x += BLOCK) {
        int32_t a[BLOCK], b[BLOCK];
        load_block(above + 4 * (size_t)x, a);
        load_block(below + 4 * (size_t)x, b);
        luma_block(a, y0 + x);
        luma_block(b, y1 + x);
        chroma_block(a, b, u + x / 2, v + x / 2);
    }
}

static uint8_t *line(const AVFrame *picture, int plane, int y)
{
    return picture->data[plane] + (ptrdiff_t)y * picture->linesize[plane];
}

static const uint8_t *row(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

/* The same function for each instruction set: integers, hence the same bits. */
#define YUV420(name, attribute)                                                                                                    \
    attribute static void name(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)                               \
    {                                                                                                                              \
        for (int y = r.y; y < r.y + r.height; y += 2) {                                                                            \
            yuv420_rows(row(frame, r.x, y), row(frame, r.x, y + 1), line(picture, 0, y) + r.x, line(picture, 0, y + 1) + r.x,      \
                        line(picture, 1, y / 2) + r.x / 2, line(picture, 2, y / 2) + r.x / 2, r.width);                            \
        }                                                                                                                          \
    }

YUV420(yuv420_sse2, )
YUV420(yuv420_avx2, __attribute__((target("avx2"))))

static void copy_bgr0(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++)
        memcpy(line(picture, 0, y) + 4 * (ptrdiff_t)r.x, row(frame, r.x, y), 4 * (size_t)r.width);
}

static void to_rgb24(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        const uint8_t *from = row(frame, r.x, y);
        uint8_t *to = line(picture, 0, y) + 3 * (ptrdiff_t)r.x;
        for (int x = 0; x < r.width; x++, from += 4, to += 3) {
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
        }
    }
}

static void to_gbrp(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        const uint8_t *from = row(frame, r.x, y);
        uint8_t *g = line(picture, 0, y) + r.x, *b = line(picture, 1, y) + r.x, *red = line(picture, 2, y) + r.x;
        for (int x = 0; x < r.width; x++, from += 4) {
            b[x] = from[0];
            g[x] = from[1];
            red[x] = from[2];
        }
    }
}

bead_convert bead_convert_find(enum AVPixelFormat format)
{
    static const struct {
        enum AVPixelFormat format;
        bead_convert plain, avx2;
    } converters[] = {
        {AV_PIX_FMT_YUV420P, yuv420_sse2, yuv420_avx2},
        {AV_PIX_FMT_BGR0, copy_bgr0, copy_bgr0},
        {AV_PIX_FMT_RGB24, to_rgb24, to_rgb24},
        {AV_PIX_FMT_GBRP, to_gbrp, to_gbrp},
    };
    for (size_t i = 0; i < sizeof converters / sizeof *converters; i++) {
        if (converters[i].format == format)
            return __builtin_cpu_supports("avx2") ? converters[i].avx2 : converters[i].plain;
    }
    return NULL;
}

static int clamp(int64_t value, int high)
{
    return value < 0 ? 0 : value > high ? high : (int)value;
}

struct bead_rect bead_convert_align(const struct bead_frame *frame, struct bead_rect rect)
{
    int x0 = clamp(rect.x, frame->width), x1 = clamp((int64_t)rect.x + rect.width, frame->width);
    int y0 = clamp(rect.y, frame->height), y1 = clamp((int64_t)rect.y + rect.height, frame->height);
    if (x1 <= x0 || y1 <= y0)
        return (struct bead_rect){0, 0, 0, 0};
    x0 -= x0 % BLOCK;
    x1 += (BLOCK - x1 % BLOCK) % BLOCK;
    y0 -= y0 % 2;
    y1 += y1 % 2 && y1 < frame->height;
    return (struct bead_rect){x0, y0, x1 - x0, y1 - y0};
}
