/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of libav, brought up to date with what changed in the frames, and made writable where an encoder kept one. */
#include "render/encode/pictures.h"

#include <stdlib.h>

enum { LINE_ALIGN = 64 /* bytes: blocks of the converters reach into the padding */ };

struct bead_picture_format bead_picture_format(int width, int height, enum AVPixelFormat pixels)
{
    struct bead_picture_format f = {width,           height,          pixels,           AVCOL_PRI_BT709,
                                    AVCOL_TRC_BT709, AVCOL_SPC_BT709, AVCOL_RANGE_MPEG, AVCHROMA_LOC_CENTER};
    if (pixels == AV_PIX_FMT_YUV420P || pixels == AV_PIX_FMT_YUVA420P)
        return f;
    f.chroma = AVCHROMA_LOC_UNSPECIFIED;
    if (pixels == AV_PIX_FMT_YUV444P10 || pixels == AV_PIX_FMT_YUVA444P10)
        return f;
    f.transfer = AVCOL_TRC_IEC61966_2_1; /* pixels as they are, which are sRGB */
    f.matrix = AVCOL_SPC_RGB;
    f.range = AVCOL_RANGE_JPEG;
    return f;
}

static enum bead_error no_memory(const struct bead_pictures *p, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for a picture", p->name);
}

static enum bead_error add_slot(struct bead_pictures *p, struct bead_message *msg)
{
    const struct bead_picture_format *f = &p->format;
    AVFrame *picture = p->av->av_frame_alloc();
    if (!picture)
        return no_memory(p, msg);
    p->slots[p->count++] = (struct bead_picture_slot){picture, false};
    picture->width = f->width;
    picture->height = f->height;
    picture->format = f->pixels;
    picture->sample_aspect_ratio = (AVRational){1, 1};
    picture->color_primaries = f->primaries;
    picture->color_trc = f->transfer;
    picture->colorspace = f->matrix;
    picture->color_range = f->range;
    picture->chroma_location = f->chroma;
    return p->av->av_frame_get_buffer(picture, LINE_ALIGN) < 0 ? no_memory(p, msg) : BEAD_OK;
}

enum bead_error bead_pictures_reserve(struct bead_pictures *pictures, size_t count, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    if (count <= pictures->count)
        return BEAD_OK;
    struct bead_picture_slot *more = realloc(pictures->slots, count * sizeof *more);
    if (!more)
        return no_memory(pictures, msg);
    pictures->slots = more;
    while (!err && pictures->count < count)
        err = add_slot(pictures, msg);
    return err;
}

enum bead_error bead_pictures_open(const struct bead_av *av, const struct bead_picture_format *format, const char *name,
                                   struct bead_pictures *pictures, struct bead_message *msg)
{
    *pictures = (struct bead_pictures){.av = av, .format = *format, .name = name};
    enum bead_error err = bead_pictures_reserve(pictures, 1, msg);
    pictures->convert = bead_convert_find(format->pixels);
    if (!err && !pictures->convert)
        err = bead_fail(msg, BEAD_ERROR_CODEC, "%s: the pixels cannot be converted for this encoder", name);
    return err;
}

void bead_pictures_close(struct bead_pictures *pictures)
{
    for (size_t i = 0; i < pictures->count; i++)
        pictures->av->av_frame_free(&pictures->slots[i].picture);
    free(pictures->slots);
}

/* Some encoders keep the picture they were given (x264's and VP9's do not): then it is left to them, and a copy of it
 * goes on. av_frame_make_writable would not keep the lines aligned as the converters need them. */
static bool make_writable(const struct bead_av *av, AVFrame *picture)
{
    if (av->av_frame_is_writable(picture))
        return true;
    AVFrame *copy = av->av_frame_alloc();
    if (!copy)
        return false;
    copy->width = picture->width;
    copy->height = picture->height;
    copy->format = picture->format;
    bool good = av->av_frame_get_buffer(copy, LINE_ALIGN) >= 0 && av->av_frame_copy_props(copy, picture) >= 0 &&
                av->av_frame_copy(copy, picture) >= 0;
    if (good) {
        av->av_frame_unref(picture);
        av->av_frame_move_ref(picture, copy);
    }
    av->av_frame_free(&copy);
    return good;
}

struct bead_changes bead_pictures_align(const struct bead_pictures *p, const struct bead_changes *changes)
{
    const struct bead_frame size = {.width = p->format.width, .height = p->format.height};
    struct bead_changes aligned = {.count = 0};
    for (size_t i = 0; i < changes->count; i++) {
        struct bead_rect r = bead_convert_align(&size, changes->rect[i]);
        if (r.width)
            aligned.rect[aligned.count++] = r;
    }
    return aligned;
}

enum bead_error bead_pictures_convert(const struct bead_pictures *pictures, size_t slot, const struct bead_frame *frame,
                                      const struct bead_changes *missing, struct bead_message *msg)
{
    const struct bead_changes whole = {1, {{0, 0, frame->width, frame->height}}};
    struct bead_picture_slot *to = &pictures->slots[slot];
    struct bead_changes aligned = bead_pictures_align(pictures, to->filled ? missing : &whole);
    if (!aligned.count)
        return BEAD_OK;
    if (!make_writable(pictures->av, to->picture))
        return no_memory(pictures, msg);
    to->filled = true;
    for (size_t i = 0; i < aligned.count; i++)
        pictures->convert(frame, aligned.rect[i], to->picture);
    return BEAD_OK;
}
