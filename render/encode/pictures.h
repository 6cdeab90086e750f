/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pictures of an encoder, changed in place as frames change. */
#pragma once

#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/render.h"
#include "render/encode/libav.h"

/* Converts changed rectangles of a frame into a picture of libav, in the pixel format of the encoder. */

/* Convert `rect`, already aligned with bead_convert_align, from `frame`
 * into `picture` (same size; lines aligned to 64 bytes). */
typedef void (*bead_convert)(const struct bead_frame *frame, struct bead_rect rect, AVFrame *picture);

/* The converter to a pixel format. NULL: there is none. */
bead_convert bead_convert_find(enum AVPixelFormat format);
/* The smallest rectangle of whole blocks (16 pixels by 2 rows) around the visible part of `rect`. It may extend into the padding of
 * rows, but not below the frame. Empty: width 0. */
struct bead_rect bead_convert_align(const struct bead_frame *frame, struct bead_rect rect);

struct bead_picture_slot {
    AVFrame *picture;
    bool filled;
};

struct bead_pictures {
    const AVCodecContext *encoder; /* has their size and colours; borrowed, like the name */
    const char *name;              /* of the file, for messages */
    bead_convert convert;
    struct bead_picture_slot *slots;
    size_t count;
};

/* Opens with one slot. Errors: MEMORY, CODEC. Close it also after an error. */
BEAD_CHECK enum bead_error bead_pictures_open(const AVCodecContext *encoder, const char *name, struct bead_pictures *pictures,
                                              struct bead_message *msg);
/* Make at least `count` slots. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_pictures_reserve(struct bead_pictures *pictures, size_t count, struct bead_message *msg);
/* Bring a slot up to date with a frame that differs in `missing`; the first time, all of it is converted. One thread may convert
 * slots while another encodes others. Errors: MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_pictures_convert(const struct bead_pictures *pictures, size_t slot, const struct bead_frame *frame,
                                                 const struct bead_changes *missing, struct bead_message *msg);
/* The part of the changes within the picture, in whole blocks of the conversion. */
struct bead_changes bead_pictures_align(const struct bead_pictures *pictures, const struct bead_changes *changes);
void bead_pictures_close(struct bead_pictures *pictures);
