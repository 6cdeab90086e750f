/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pixels as encoders want them: changed rectangles of a frame into a retained picture of libav's. */
#ifndef BEADREEL_RENDER_ENCODE_CONVERT_H
#define BEADREEL_RENDER_ENCODE_CONVERT_H

#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>

#include "beadreel/frame.h"

/* Convert `rect`, already aligned with bead_convert_align, from `frame`
 * into `picture` (same size; lines aligned to 64 bytes). */
typedef void (*bead_convert)(const struct bead_frame *frame, struct bead_rect rect, AVFrame *picture);

/* The converter into a pixel format. NULL: there is none. */
bead_convert bead_convert_find(enum AVPixelFormat format);
/* The least rectangle of whole blocks (16 pixels by 2 rows) that holds the visible part of `rect`; its width may reach
 * into the padding of rows, its height may not leave the frame. Empty: width 0. */
struct bead_rect bead_convert_align(const struct bead_frame *frame, struct bead_rect rect);

#endif
