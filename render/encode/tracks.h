/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of a movie other than its pictures, if the container has them: chapters, and tracks of sound and subtitles, whose
 * packets are complete before the finished file is written. */
#pragma once

#include <stddef.h>

#include "render/encode/libav.h"
#include "render/encode/movie_private.h"

struct bead_track {
    AVCodecParameters *codec;
    AVRational unit;    /* s: of the times of the packets */
    const char *title;  /* borrowed; NULL: none */
    AVPacket **packets; /* [room], in order of time */
    size_t count, room;
    size_t written;
    int stream; /* its number in the file */
};

enum { BEAD_TRACKS = 2 };
struct bead_tracks {
    struct bead_track track[BEAD_TRACKS];
    size_t count;
};

void bead_tracks_free(struct bead_tracks *tracks);

/* Make streams for the tracks in a file whose header is not written yet. Returns libav's error number. */
int bead_tracks_open(struct bead_tracks *tracks, AVFormatContext *to);
/* Write, in order of time, the packets that begin before `time`, in the given unit. Each is written once. Returns libav's error
 * number. */
int bead_tracks_write(struct bead_tracks *tracks, AVFormatContext *to, int64_t time, AVRational unit);

/* ---- subtitles ---- */

/* The form of subtitles in a container. */
struct bead_subtitle_format {
    enum AVCodecID codec;
    bool counted;         /* each text is preceded by its length, two bytes */
    bool escaped;         /* & < > are written as in HTML */
    const uint8_t *style; /* extra data for the container; NULL: none */
    int style_bytes;
};
extern const struct bead_subtitle_format bead_subtitles_mp4, bead_subtitles_mkv, bead_subtitles_webm;

/* Add a track with the subtitles of the settings, if any. Returns libav's error number. */
int bead_subtitles_make(const struct bead_subtitle_format *format, const struct bead_movie_settings *settings,
                        struct bead_tracks *tracks);

/* ---- sound ---- */

/* The encoder of sound. */
struct bead_sound_format {
    const char *encoder; /* libav's name */
    enum AVSampleFormat samples;
    int64_t bit_rate; /* 1/s, per channel */
};
extern const struct bead_sound_format bead_sound_aac, bead_sound_opus;

/* Add a track with the samples (see bead_movie_sound). Returns libav's error number. */
int bead_sound_make(const struct bead_sound_format *format, const float *samples, size_t count, int channels,
                    struct bead_tracks *tracks);

/* ---- chapters ---- */

/* Add the chapters of the settings to a format whose header is not written yet. Each lasts until the next begins, the last one
 * until settings->length. Returns libav's error number. */
int bead_chapters_add(AVFormatContext *format, const struct bead_movie_settings *settings);
