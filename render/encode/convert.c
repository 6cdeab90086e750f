/* Changed rectangles of a frame into the pixel format of an encoder: YUV 4:2:0 or kinds of RGB. */
#include "render/encode/convert.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "render/paint/pixel_kernels.h"

/* A block is 16 pixels wide: a cache line of BGRX. */
enum { BLOCK = 16 };

static uint8_t *line(const AVFrame *picture, int plane, int y)
{
    return picture->data[plane] + (ptrdiff_t)y * picture->linesize[plane];
}

static const uint8_t *row(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

static void to_yuv420(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(NULL);
    for (int y = r.y; y < r.y + r.height; y += 2) {
        const uint8_t *const from[2] = {row(frame, r.x, y), row(frame, r.x, y + 1)};
        uint8_t *const to[2] = {line(picture, 0, y) + r.x, line(picture, 0, y + 1) + r.x};
        kernels->yuv420(from, to, line(picture, 1, y / 2) + r.x / 2, line(picture, 2, y / 2) + r.x / 2, r.width);
    }
}

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
        bead_convert convert;
    } converters[] = {
        {AV_PIX_FMT_YUV420P, to_yuv420},
        {AV_PIX_FMT_BGR0, copy_bgr0},
        {AV_PIX_FMT_RGB24, to_rgb24},
        {AV_PIX_FMT_GBRP, to_gbrp},
    };
    for (size_t i = 0; i < sizeof converters / sizeof *converters; i++) {
        if (converters[i].format == format)
            return converters[i].convert;
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
