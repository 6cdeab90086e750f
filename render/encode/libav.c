/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FFmpeg's libraries, opened for the first movie; hints for encoders. */
#include "render/encode/libav.h"

#include <stdlib.h>

#define TEXT(x)                TEXT_OF(x)
#define TEXT_OF(x)             #x
#define FILE_OF(name, version) "lib" name ".so." TEXT(version)
/* Debian names packages of libraries after their files; this one depends on the others. */
#define PACKAGE "libavformat" TEXT(LIBAVFORMAT_VERSION_MAJOR)

/* libav's structures change with the major versions, which must be those of the build. */
const struct bead_library_info bead_av_libraries[] = {
    {{FILE_OF("avutil", LIBAVUTIL_VERSION_MAJOR)}, "movies; impossible without it", PACKAGE},
    {{FILE_OF("avcodec", LIBAVCODEC_VERSION_MAJOR)}, "encodes movies, with libx264 and libvpx; impossible without it", PACKAGE},
    {{FILE_OF("avformat", LIBAVFORMAT_VERSION_MAJOR)}, "writes movies; impossible without it", PACKAGE},
    {{NULL}, NULL, NULL},
};

/* Not constant: set once for the process. */
void *bead_libav;

enum bead_error bead_av_open(struct bead_message *msg)
{
    struct bead_message why;
    if (!bead_library_load(bead_av_libraries, BEAD_LATE, &bead_libav, &why))
        return setenv("SVT_LOG", "0", false) == 0 ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for an encoder");
    return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "movies need FFmpeg's libraries: %s", why.text);
}

void bead_av_silence(void)
{
    if (av_log_get_level() > AV_LOG_QUIET)
        av_log_set_level(AV_LOG_QUIET);
}

int bead_av_options(const char *text, AVDictionary **options)
{
    return text && *text ? av_dict_parse_string(options, text, "=", " ", 0) : 0;
}

#ifdef AVUTIL_VIDEO_HINT_H
int bead_av_hint(AVFrame *picture, const struct bead_changes *changes)
{
    av_frame_remove_side_data(picture, AV_FRAME_DATA_VIDEO_HINT); /* slots are used again */
    if (!changes)
        return 0;
    AVVideoHint *hint = av_video_hint_create_side_data(picture, changes->count);
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
int bead_av_hint(AVFrame *, const struct bead_changes *)
{
    return 0;
}
#endif
