/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures as an encoder wants them, changed in place as frames change. */
#ifndef BEADREEL_RENDER_ENCODE_PICTURES_H
#define BEADREEL_RENDER_ENCODE_PICTURES_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/frame.h"
#include "render/encode/convert.h"
#include "render/encode/libav.h"

/* What encoders are told of their pictures. */
struct bead_picture_format {
    int width, height;
    enum AVPixelFormat pixels;
    enum AVColorPrimaries primaries;
    enum AVColorTransferCharacteristic transfer;
    enum AVColorSpace matrix;
    enum AVColorRange range;
    enum AVChromaLocation chroma;
};
/* BT.709 for YUV, sRGB for everything else. */
struct bead_picture_format bead_picture_format(int width, int height, enum AVPixelFormat pixels);

struct bead_picture_slot {
    AVFrame *picture;
    bool filled;
};

struct bead_pictures {
    const struct bead_av *av; /* borrowed, as the name */
    struct bead_picture_format format;
    const char *name; /* of the file, for messages */
    bead_convert convert;
    struct bead_picture_slot *slots;
    size_t count;
};

/* One slot. Errors: MEMORY, CODEC. What was made is freed by close, also after an error. */
BEAD_CHECK enum bead_error bead_pictures_open(const struct bead_av *av, const struct bead_picture_format *format, const char *name,
                                              struct bead_pictures *pictures, struct bead_message *msg);
/* At least `count` slots. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_pictures_reserve(struct bead_pictures *pictures, size_t count, struct bead_message *msg);
/* Bring a slot up to date with a frame that differs in `missing`; the first time everything is converted. Slots may be converted in
 * one thread while another encodes others. Errors: MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_pictures_convert(const struct bead_pictures *pictures, size_t slot, const struct bead_frame *frame,
                                                 const struct bead_changes *missing, struct bead_message *msg);
/* Changes as far as they reach into the picture, in whole blocks of the conversion. */
struct bead_changes bead_pictures_align(const struct bead_pictures *pictures, const struct bead_changes *changes);
void bead_pictures_close(struct bead_pictures *pictures);

#endif
