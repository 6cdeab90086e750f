/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of libav, updated with the changes of frames, and made writable again if an encoder has kept one. */
#include "render/encode/pictures.h"

#include <stdlib.h>

enum { LINE_ALIGN = 64 /* bytes: blocks of the converters reach into the padding */ };

static enum bead_error no_memory(const struct bead_pictures *p, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_MEMORY, "%s: out of memory for a picture", p->name);
}

static enum bead_error add_slot(struct bead_pictures *p, struct bead_message *msg)
{
    const AVCodecContext *c = p->encoder;
    AVFrame *picture = av_frame_alloc();
    if (!picture)
        return no_memory(p, msg);
    p->slots[p->count++] = (struct bead_picture_slot){picture, false};
    picture->width = c->width;
    picture->height = c->height;
    picture->format = c->pix_fmt;
    picture->sample_aspect_ratio = c->sample_aspect_ratio;
    picture->color_primaries = c->color_primaries;
    picture->color_trc = c->color_trc;
    picture->colorspace = c->colorspace;
    picture->color_range = c->color_range;
    picture->chroma_location = c->chroma_sample_location;
    return av_frame_get_buffer(picture, LINE_ALIGN) < 0 ? no_memory(p, msg) : BEAD_OK;
}

enum bead_error bead_pictures_reserve(struct bead_pictures *pictures, size_t count, struct bead_message *msg)
{
    if (count <= pictures->count)
        return BEAD_OK;
    struct bead_picture_slot *more = realloc(pictures->slots, count * sizeof *more);
    if (!more)
        return no_memory(pictures, msg);
    pictures->slots = more;
    while (pictures->count < count)
        BEAD_TRY(add_slot(pictures, msg));
    return BEAD_OK;
}

enum bead_error bead_pictures_open(const AVCodecContext *encoder, const char *name, struct bead_pictures *pictures,
                                   struct bead_message *msg)
{
    *pictures = (struct bead_pictures){.encoder = encoder, .name = name};
    BEAD_TRY(bead_pictures_reserve(pictures, 1, msg));
    pictures->convert = bead_convert_find(encoder->pix_fmt);
    if (!pictures->convert)
        return bead_fail(msg, BEAD_ERROR_CODEC, "%s: cannot convert pixels for this encoder", name);
    return BEAD_OK;
}

void bead_pictures_close(struct bead_pictures *pictures)
{
    for (size_t i = 0; i < pictures->count; i++)
        av_frame_free(&pictures->slots[i].picture);
    free(pictures->slots);
}

/* Some encoders keep their pictures (x264's and VP9's do not): then continue with a copy. av_frame_make_writable would not keep the
 * lines aligned for the converters. */
static bool make_writable(AVFrame *picture)
{
    if (av_frame_is_writable(picture))
        return true;
    AVFrame *copy = av_frame_alloc();
    if (!copy)
        return false;
    copy->width = picture->width;
    copy->height = picture->height;
    copy->format = picture->format;
    bool good =
        av_frame_get_buffer(copy, LINE_ALIGN) >= 0 && av_frame_copy_props(copy, picture) >= 0 && av_frame_copy(copy, picture) >= 0;
    if (good) {
        av_frame_unref(picture);
        av_frame_move_ref(picture, copy);
    }
    av_frame_free(&copy);
    return good;
}

struct bead_changes bead_pictures_align(const struct bead_pictures *p, const struct bead_changes *changes)
{
    const struct bead_frame size = {.width = p->encoder->width, .height = p->encoder->height};
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
    if (!make_writable(to->picture))
        return no_memory(pictures, msg);
    to->filled = true;
    for (size_t i = 0; i < aligned.count; i++)
        pictures->convert(frame, aligned.rect[i], to->picture);
    return BEAD_OK;
}
