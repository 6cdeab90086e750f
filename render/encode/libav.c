/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FFmpeg's libraries: opened once a movie needs them, each function looked up by its name; hints for encoders. */
#include "render/encode/libav.h"

#include <string.h>

#include "render/draw/libraries.h"

#define NAME(function) #function,

static const char *const names[] = {BEAD_AV_FUNCTIONS(NAME)};
#define COUNT(function) +1
enum {
    AVUTIL = 0 BEAD_AVUTIL_FUNCTIONS(COUNT),
    AVCODEC = 0 BEAD_AVCODEC_FUNCTIONS(COUNT),
    AVFORMAT = 0 BEAD_AVFORMAT_FUNCTIONS(COUNT),
    FUNCTIONS = AVUTIL + AVCODEC + AVFORMAT
};

static const struct {
    enum bead_opened_library library;
    size_t first, count;
} libraries[] = {
    {BEAD_LIBRARY_AVUTIL, 0, AVUTIL},
    {BEAD_LIBRARY_AVCODEC, AVUTIL, AVCODEC},
    {BEAD_LIBRARY_AVFORMAT, AVUTIL + AVCODEC, AVFORMAT},
};

/* Debian names the packages of libraries after their files; that of libavformat brings the others. */
static enum bead_error not_there(const char *why, struct bead_message *msg)
{
    const char *file = bead_library_info(BEAD_LIBRARY_AVFORMAT)->files[0], *ending = strstr(file, ".so.");
    return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "movies need FFmpeg's libraries (install %.*s%s): %s", (int)(ending - file), file,
                     ending + strlen(".so."), why);
}

enum bead_error bead_av_open(struct bead_av *av, struct bead_message *msg)
{
    void (*loaded[FUNCTIONS])(void);
    struct bead_message why;
    _Static_assert(sizeof loaded == sizeof *av, "nothing but functions");
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; i++) {
        size_t first = libraries[i].first;
        if (bead_library_load(bead_library_info(libraries[i].library)->files, names + first, libraries[i].count, loaded + first,
                              &why))
            return not_there(why.text, msg);
    }
    memcpy(av, loaded, sizeof *av);
    return BEAD_OK;
}

void bead_av_silence(const struct bead_av *av)
{
    if (av->av_log_get_level() > AV_LOG_QUIET)
        av->av_log_set_level(AV_LOG_QUIET);
}

int bead_av_options(const struct bead_av *av, const char *text, AVDictionary **options)
{
    return text && *text ? av->av_dict_parse_string(options, text, "=", " ", 0) : 0;
}

#ifdef AVUTIL_VIDEO_HINT_H
int bead_av_hint(const struct bead_av *av, AVFrame *picture, const struct bead_changes *changes)
{
    av->av_frame_remove_side_data(picture, AV_FRAME_DATA_VIDEO_HINT); /* slots come round */
    if (!changes)
        return 0;
    AVVideoHint *hint = av->av_video_hint_create_side_data(picture, changes->count);
    if (!hint)
        return AVERROR(ENOMEM);
    hint->type = AV_VIDEO_HINT_TYPE_CHANGED;
    for (size_t i = 0; i < changes->count; i++) {
        const struct bead_rect *r = &changes->rect[i];
        *av_video_hint_get_rect(hint, i) = (AVVideoRect){(uint32_t)r->x, (uint32_t)r->y, (uint32_t)r->width, (uint32_t)r->height};
    }
    return 0;
}
#else
int bead_av_hint(const struct bead_av *av, AVFrame *picture, const struct bead_changes *changes)
{
    (void)av, (void)picture, (void)changes;
    return 0;
}
#endif
