/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives a format of libav the chapters of a movie. The format frees them. */
#include "render/encode/chapters.h"

#include <math.h>
#include <string.h>

static const int per_second = 1000;

static void *take_zeros(const struct bead_av *av, size_t bytes)
{
    void *memory = av->av_malloc(bytes);
    return memory ? memset(memory, 0, bytes) : NULL;
}

int bead_chapters_add(const struct bead_av *av, AVFormatContext *format, const struct bead_movie_settings *settings)
{
    size_t count = settings->chapter_count;
    if (count == 0)
        return 0;
    format->chapters = take_zeros(av, count * sizeof(AVChapter *));
    if (!format->chapters)
        return AVERROR(ENOMEM);
    for (size_t i = 0; i < count; i++) {
        const struct bead_movie_chapter *from = &settings->chapters[i];
        AVChapter *chapter = take_zeros(av, sizeof *chapter);
        if (!chapter)
            return AVERROR(ENOMEM);
        format->chapters[format->nb_chapters++] = chapter;
        chapter->id = (int)i + 1;
        chapter->time_base = (AVRational){1, per_second};
        chapter->start = llround(from->start * per_second);
        chapter->end = llround((i + 1 < count ? from[1].start : settings->length) * per_second);
        int code = av->av_dict_set(&chapter->metadata, "title", from->title, 0);
        if (code < 0)
            return code;
    }
    return 0;
}
