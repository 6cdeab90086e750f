/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a movie: the table of codecs, and the two ways to write frames (libav's encoders; lines of hashes). */
#ifndef BEADREEL_RENDER_ENCODE_MOVIE_PRIVATE_H
#define BEADREEL_RENDER_ENCODE_MOVIE_PRIVATE_H

#include <libavutil/pixfmt.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "beadreel/movie.h"

struct bead_encoder; /* libav's part */
struct bead_subtitle_format;
struct bead_sound_format;

/* A way to write frames. */
struct bead_movie_way {
    enum bead_error (*open)(struct bead_movie *movie, struct bead_message *msg);
    enum bead_error (*add)(struct bead_movie *movie, const struct bead_frame *frame, const struct bead_changes *changes,
                           struct bead_message *msg);
    /* The same in two steps, for two threads: see bead_movie_reserve. NULL: there is no such thing. */
    enum bead_error (*reserve)(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg);
    enum bead_error (*convert)(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                               const struct bead_changes *missing, struct bead_message *msg);
    enum bead_error (*add_slot)(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                struct bead_message *msg);
    /* The movie's cover; NULL: movies of this kind have none. */
    enum bead_error (*cover)(struct bead_movie *movie, const uint8_t *png, size_t bytes, struct bead_message *msg);
    /* Its sound; NULL: likewise. */
    enum bead_error (*sound)(struct bead_movie *movie, const float *samples, size_t count, struct bead_message *msg);
    /* Everything that was added is in the part, and the part closed. Of complete movies the finished file may be another one,
     * `plain`. */
    enum bead_error (*finish)(struct bead_movie *movie, bool complete, struct bead_message *msg);
    void (*destroy)(struct bead_movie *movie);
};

extern const struct bead_movie_way bead_movie_libav, bead_movie_hashes;

/* How one quality is encoded. */
struct bead_preset {
    const char *encoder; /* libav's name */
    enum AVPixelFormat format;
    int threads;         /* of the encoder, each with frames of its own */
    bool hinted;         /* the encoder skips what it is told has not changed */
    const char *options; /* of the encoder, as libav has them: "key=value key=value" */
};

enum { BEAD_ENDING_BYTES = 12 };

struct bead_codec {
    struct bead_codec_info info;
    const struct bead_movie_way *way;
    const char *muxer;         /* libav's name; NULL, like all behind it, where the way has no codec */
    const char *muxer_options; /* "key=value key=value"; the file can be read while it grows */
    const char *plain_options; /* of the finished file; NULL: it is what has grown */
    const char *ending;        /* BEAD_ENDING_BYTES that end a growing file for those who read it; NULL: it needs none */
    enum bead_error (*comment)(int descriptor, const char *text, struct bead_message *msg); /* NULL: the muxer writes it */
    const struct bead_preset *presets;                                                      /* by enum bead_quality */
    const struct bead_preset
        *clear;       /* of transparent movies, likewise; without an encoder: of this quality there are none. NULL: at all */
    bool final_delay; /* the muxer has this option, since it knows durations only from the next picture */
    bool chapters;    /* the container has chapters */
    const struct bead_subtitle_format *subtitles; /* NULL: it has none */
    const struct bead_sound_format *sound;        /* NULL: it has none */
    bool gif;                                     /* the finished file is a GIF, made of the one that has grown */
    bool covers;                                  /* the container has room for a picture beside the movie */
    int most_fps;                                 /* 1/s: more are thinned out, because players slow such files down; 0: no limit */
};

/* By the extension of `path`, in any case of letters; NULL: none. */
const struct bead_codec *bead_codec_find(const char *path);
/* What encodes a movie of such quality, transparent or not; NULL: nothing does. */
const struct bead_preset *bead_codec_preset(const struct bead_codec *codec, const struct bead_movie_settings *settings);
/* So many frames are one picture in the file, to stay below its most_fps; usually 1. */
size_t bead_codec_group(const struct bead_codec *codec, double fps);

struct bead_movie {
    const struct bead_codec *codec;
    struct bead_movie_settings settings; /* title and comment: only within open */
    char *path, *part;
    char *plain; /* the finished file, on its way; NULL: the part */
    char encoded_by[48];
    char *comment;                /* where the codec writes it at the end; NULL: none */
    struct bead_encoder *encoder; /* bead_movie_libav */
    FILE *lines;                  /* bead_movie_hashes */
    uint64_t shown, encoded;
    bool failed;
};

/* Frames in two steps: one thread converts them into pictures as the encoder wants them, another one encodes these. A slot is a
 * picture, and belongs to one of the two at a time. *reserved is false where frames are better added at once: hashes need
 * no conversion. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_movie_reserve(struct bead_movie *movie, size_t slots, bool *reserved, struct bead_message *msg);
/* Bring a slot up to date with the frame: what changed since the slot was up to date, the first time all. Errors: CODEC, MEMORY. */
BEAD_CHECK enum bead_error bead_movie_convert(struct bead_movie *movie, size_t slot, const struct bead_frame *frame,
                                              const struct bead_changes *missing, struct bead_message *msg);
/* As bead_movie_add. `changes`: since the frame before. */
BEAD_CHECK enum bead_error bead_movie_add_slot(struct bead_movie *movie, size_t slot, const struct bead_changes *changes,
                                               struct bead_message *msg);

#endif
