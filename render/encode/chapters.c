/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds the chapters of a movie to a format of libav, which frees them. */
#include "render/encode/tracks.h"

#include <math.h>

static const int per_second = 1000;

int bead_chapters_add(AVFormatContext *format, const struct bead_movie_settings *settings)
{
    size_t count = settings->chapter_count;
    if (count == 0)
        return 0;
    format->chapters = av_mallocz(count * sizeof(AVChapter *));
    if (!format->chapters)
        return AVERROR(ENOMEM);
    for (size_t i = 0; i < count; i++) {
        const struct bead_movie_chapter *from = &settings->chapters[i];
        AVChapter *chapter = av_mallocz(sizeof *chapter);
        if (!chapter)
            return AVERROR(ENOMEM);
        format->chapters[format->nb_chapters++] = chapter;
        chapter->id = (int)i + 1;
        chapter->time_base = (AVRational){1, per_second};
        chapter->start = llround(from->start * per_second);
        chapter->end = llround((i + 1 < count ? from[1].start : settings->length) * per_second);
        int code = av_dict_set(&chapter->metadata, "title", from->title, 0);
        if (code < 0)
            return code;
    }
    return 0;
}
