/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Converts changed rectangles of a frame into a picture of libav, in the pixel format of the encoder. */
#pragma once

#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>

#include "beadreel/render.h"

/* Convert `rect`, already aligned with bead_convert_align, from `frame`
 * into `picture` (same size; lines aligned to 64 bytes). */
typedef void (*bead_convert)(const struct bead_frame *frame, struct bead_rect rect, AVFrame *picture);

/* The converter to a pixel format. NULL: there is none. */
bead_convert bead_convert_find(enum AVPixelFormat format);
/* The smallest rectangle of whole blocks (16 pixels by 2 rows) around the visible part of `rect`. It may extend into the padding of
 * rows, but not below the frame. Empty: width 0. */
struct bead_rect bead_convert_align(const struct bead_frame *frame, struct bead_rect rect);
