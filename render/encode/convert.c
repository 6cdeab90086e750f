/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Converts changed rectangles of a frame to the pixel formats of encoders: YUV and RGB, with and without alpha. */
#include "render/encode/pictures.h"

#include <math.h>

#include "render/draw/raster.h"
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

static void to_rgba(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++)
        bead_straight_rgba(row(frame, r.x, y), (size_t)r.width, line(picture, 0, y) + 4 * (ptrdiff_t)r.x);
}

static void to_bgra(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        const uint8_t *from = row(frame, r.x, y);
        uint8_t *to = line(picture, 0, y) + 4 * (ptrdiff_t)r.x;
        if (frame->alpha)
            bead_straight_rgba(from, (size_t)r.width, to);
        for (int x = 0; x < r.width; x++, from += 4, to += 4) {
            const uint8_t rgba[] = {to[0], to[1], to[2], to[3]}, opaque[] = {from[2], from[1], from[0], 255};
            const uint8_t *straight = frame->alpha ? rgba : opaque;
            memcpy(to, (const uint8_t[]){straight[2], straight[1], straight[0], straight[3]}, 4);
        }
    }
}

/* Two rows of a block as B G R A with straight colours. Transparent pixels take the colour of their neighbours: chroma is the mean
 * of four pixels, so a dark one would be visible at edges. */
static void straighten(const struct bead_frame *frame, int x, int y, uint8_t out[2][4 * BLOCK])
{
    for (int k = 0; k < 2; k++) {
        uint8_t rgba[4 * BLOCK];
        bead_straight_rgba(row(frame, x, y + k < frame->height ? y + k : y), BLOCK, rgba);
        for (int i = 0; i < 4 * BLOCK; i++)
            out[k][i] = rgba[i % 4 < 3 ? i - i % 4 + 2 - i % 4 : i];
    }
    for (int i = 0; i < 4 * BLOCK; i += 8) {
        uint8_t *four[4] = {out[0] + i, out[0] + i + 4, out[1] + i, out[1] + i + 4};
        int alpha = four[0][3] + four[1][3] + four[2][3] + four[3][3];
        for (int p = 0; p < 4 && alpha > 0; p++) {
            for (int c = 0; four[p][3] == 0 && c < 3; c++)
                four[p][c] = (uint8_t)((four[0][c] * four[0][3] + four[1][c] * four[1][3] + four[2][c] * four[2][3] +
                                        four[3][c] * four[3][3] + alpha / 2) /
                                       alpha);
        }
    }
}

static void to_yuva420(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(NULL);
    for (int y = r.y; y < r.y + r.height; y += 2) {
        for (int x = r.x; x < r.x + r.width; x += BLOCK) {
            _Alignas(64) uint8_t straight[2][4 * BLOCK];
            straighten(frame, x, y, straight);
            const uint8_t *const from[2] = {straight[0], straight[1]};
            uint8_t *const to[2] = {line(picture, 0, y) + x, line(picture, 0, y + 1) + x};
            kernels->yuv420(from, to, line(picture, 1, y / 2) + x / 2, line(picture, 2, y / 2) + x / 2, BLOCK);
            for (int i = 0; i < 2 * BLOCK; i++)
                line(picture, 3, y + i / BLOCK)[x + i % BLOCK] = straight[i / BLOCK][4 * (i % BLOCK) + 3];
        }
    }
}

/* BT.709 with 10 bits, limited range. */
static void to_yuv444(const uint8_t rgb[3], uint16_t yuv[3])
{
    const float r = rgb[0] / 255.0f, g = rgb[1] / 255.0f, b = rgb[2] / 255.0f;
    const float luma = 0.2126f * r + 0.7152f * g + 0.0722f * b;
    yuv[0] = (uint16_t)(64.5f + 876 * luma);
    yuv[1] = (uint16_t)(512.5f + 896 * (b - luma) / 1.8556f);
    yuv[2] = (uint16_t)(512.5f + 896 * (r - luma) / 1.5748f);
}

static void to_yuva444(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    const int planes = picture->data[3] ? 4 : 3;
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++) {
            const uint8_t *from = row(frame, x, y);
            uint8_t rgba[4] = {from[2], from[1], from[0], 255};
            uint16_t to[4];
            if (frame->alpha)
                bead_straight_rgba(from, 1, rgba);
            to_yuv444(rgba, to);
            to[3] = (uint16_t)((1023 * rgba[3] + 127) / 255);
            for (int p = 0; p < planes; p++)
                memcpy(line(picture, p, y) + 2 * (ptrdiff_t)x, &to[p], sizeof to[p]);
        }
    }
}

/* JFIF: BT.601 with all 256 levels. */
static void to_yuvj444(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++) {
            const uint8_t *bgr = row(frame, x, y);
            const float luma = 0.299f * bgr[2] + 0.587f * bgr[1] + 0.114f * bgr[0];
            line(picture, 0, y)[x] = (uint8_t)(luma + 0.5f);
            line(picture, 1, y)[x] = (uint8_t)fminf(255, 128.5f + (bgr[0] - luma) / 1.772f);
            line(picture, 2, y)[x] = (uint8_t)fminf(255, 128.5f + (bgr[2] - luma) / 1.402f);
        }
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
        {AV_PIX_FMT_YUV420P, to_yuv420},     {AV_PIX_FMT_YUVA420P, to_yuva420}, {AV_PIX_FMT_YUV444P10, to_yuva444},
        {AV_PIX_FMT_YUVA444P10, to_yuva444}, {AV_PIX_FMT_RGBA, to_rgba},        {AV_PIX_FMT_BGR0, copy_bgr0},
        {AV_PIX_FMT_BGRA, to_bgra},          {AV_PIX_FMT_RGB24, to_rgb24},      {AV_PIX_FMT_GBRP, to_gbrp},
        {AV_PIX_FMT_YUVJ444P, to_yuvj444},   {AV_PIX_FMT_YUV444P, to_yuvj444},
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
