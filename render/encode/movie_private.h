/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inside of movies: the table of codecs, and the two ways to write frames (libav's encoders, lines of hashes). */
#pragma once

#include <libavutil/pixfmt.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "render/encode/movie_internal.h"

struct bead_encoder; /* libav's part */
struct bead_subtitle_format;
struct bead_sound_format;

/* A way to write frames. */
struct bead_movie_way {
    enum bead_error (*open)(struct bead_movie *movie, struct bead_message *msg);
    enum bead_error (*add)(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                           struct bead_message *msg);
    /* `add` in two steps, for two threads: see bead_movie_reserve. NULL: not available. */
    enum bead_error (*reserve)(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg);
    enum bead_error (*convert)(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                               const struct bead_changes *missing, struct bead_message *msg);
    enum bead_error (*add_slot)(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                struct bead_message *msg);
    /* Set the cover; NULL: movies of this kind have none. */
    enum bead_error (*cover)(struct bead_movie *movie, const uint8_t *png, size_t bytes, struct bead_message *msg);
    /* Set the sound; NULL: movies of this kind have none. */
    enum bead_error (*sound)(struct bead_movie *movie, const float *samples, size_t count, struct bead_message *msg);
    /* Write all that was added to the part, and close it. For complete movies, may make another finished file, `plain`. */
    enum bead_error (*finish)(struct bead_movie *movie, bool complete, struct bead_message *msg);
    void (*destroy)(struct bead_movie *movie);
};

extern const struct bead_movie_way bead_movie_libav;

/* The encoder of one quality. */
struct bead_preset {
    const char *encoder; /* libav's name */
    enum AVPixelFormat format;
    int threads;         /* of the encoder, each for different frames */
    bool hinted;         /* the encoder skips parts that are unchanged by the hints */
    const char *options; /* of the encoder: "key=value key=value" */
};

enum { BEAD_ENDING_BYTES = 12 };

struct bead_codec {
    struct bead_codec_info info;
    const struct bead_movie_way *way;
    const char *muxer;         /* libav's name; NULL, like all members below, if the way has no codec */
    const char *muxer_options; /* "key=value key=value", with which the growing file can be read */
    const char *plain_muxer;   /* of the finished file; NULL: the same */
    const char *plain_options; /* of the finished file; NULL: that is the part itself */
    const char *ending;        /* BEAD_ENDING_BYTES after each flush, so that the growing file can be read; NULL: not needed */
    const struct bead_preset *presets; /* by enum bead_quality */
    const struct bead_preset
        *clear; /* of transparent movies, by quality; without an encoder: not in this quality. NULL: in no quality */
    const struct bead_preset *av1;                /* if the settings ask for AV1, by quality */
    bool final_delay;                             /* the muxer has this option, as it finds durations only from the next picture */
    bool chapters;                                /* the container has chapters */
    const struct bead_subtitle_format *subtitles; /* NULL: it has none */
    const struct bead_sound_format *sound;        /* NULL: it has none */
    bool gif;                                     /* the finished file is a GIF, made from the part */
    bool covers;                                  /* the container can hold a cover */
    const char *dpi;                              /* the encoder's option for it; NULL: none */
    int most_fps; /* 1/s: above it frames are left out, because players slow such files down; 0: no limit */
};

/* By the extension of `path`, ignoring case; NULL: none. */
const struct bead_codec *bead_codec_find(const char *path, bool still);
/* The table's row for these settings (quality, transparency, codec); NULL: there is none. */
const struct bead_preset *bead_codec_preset(const struct bead_codec *codec, const struct bead_movie_settings *settings);
/* The codec itself, or its substitute on this machine; libav must be open. */
const struct bead_preset *bead_codec_encoder(const struct bead_codec *codec, const struct bead_movie_settings *settings);
/* The number of frames for one picture in the file, so that it keeps to most_fps; usually 1. */
size_t bead_codec_group(const struct bead_codec *codec, double fps);

struct bead_movie {
    const struct bead_codec *codec;
    const struct bead_preset *preset;    /* the codec's, for these settings; NULL: none */
    int64_t group;                       /* bead_codec_group */
    struct bead_movie_settings settings; /* title and comment: valid only within open */
    char *path, *part;
    char *plain; /* name of the finished file while it is written; NULL: the part */
    char encoded_by[48];
    char *comment;                /* put into the finished file; NULL: none, or the muxer writes it */
    char *description;            /* NULL: none */
    struct bead_encoder *encoder; /* bead_movie_libav */
    FILE *lines;                  /* bead_movie_hashes */
    uint64_t shown, encoded;
    bool failed;
};

/* Call it before close: describes in words what happens, for those who cannot see it; stored in finished mp4 files, and before the
 * comment where muxers write no description. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_movie_describe(struct bead_movie *movie, const char *text, struct bead_message *msg);

/* Frames in two steps: one thread converts them into the encoder's pictures, another encodes these. A slot is a picture, which
 * belongs to one thread at a time. *reserved is false if frames need no conversion and should be added at once (hashes). Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error bead_movie_reserve(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg);
/* Bring a slot up to date with the frame. `missing`: changes since it last was, at first everything. Errors: CODEC, MEMORY. */
BEAD_CHECK enum bead_error bead_movie_convert(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                                              const struct bead_changes *missing, struct bead_message *msg);
/* Like bead_movie_add. `changes`: since the previous frame. */
BEAD_CHECK enum bead_error bead_movie_add_slot(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                               struct bead_message *msg);
