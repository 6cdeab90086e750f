/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Subtitles of movies, in containers that have them. */
#ifndef BEADREEL_RENDER_ENCODE_SUBTITLES_H
#define BEADREEL_RENDER_ENCODE_SUBTITLES_H

#include "render/encode/movie_private.h"
#include "render/encode/tracks.h"

/* How a container has them. */
struct bead_subtitle_format {
    enum AVCodecID codec;
    bool counted;         /* texts stand behind their length, two bytes */
    bool escaped;         /* & < > are written as in HTML */
    const uint8_t *style; /* what the container wants to know besides; NULL: nothing */
    int style_bytes;
};
extern const struct bead_subtitle_format bead_subtitles_mp4, bead_subtitles_mkv, bead_subtitles_webm;

/* A track of those of the settings; none where there are none. Returns libav's number of an error. */
int bead_subtitles_make(const struct bead_av *av, const struct bead_subtitle_format *format,
                        const struct bead_movie_settings *settings, struct bead_tracks *tracks);

#endif
