/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies: frames into a file through libavcodec and libavformat. The container follows the extension:
 * mp4 (H.264), mov (ProRes 4444; lossless: PNG), mkv (H.264; lossless: FFV1), webm (VP9), gif, png/apng (APNG), avif, webp;
 * lossless mp4 and webm keep RGB as it is. mp4, mkv and webm can have AV1 instead.
 *
 * bead_movie_check(path, &settings, &msg); early, before any work is done
 *   bead_movie_open(path, &settings, &movie, &msg);   writes path.part
 *   bead_movie_add(movie, &frame, &changes, &msg);    once a frame, in order
 *   bead_movie_close(movie, &bytes, &msg);            finishes, fsyncs, renames; or bead_movie_abort(movie)
 *
 * path.part plays while it grows, even if the program is killed: an mp4 file grows by fragments, which close copies into a plain
 * file with its index in front; a gif grows as an animated PNG, from which close makes the GIF; and an avif as mp4. Only webp
 * writes nothing before close.
 *
 * Only the changed rectangles are converted. Every frame is a picture of the file, at a constant rate; drafts leave out a frame
 * without changes and show the previous one for longer (but keep the last, so that the duration is exact). Encoder settings are
 * deterministic: same frames, same decoded frames, one thread. A movie may be used from any one thread at a time. The log of libav
 * is silenced, for the whole process. */
#ifndef BEADREEL_MOVIE_H
#define BEADREEL_MOVIE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/render.h"
#include "beadreel/scene.h"

BEAD_BEGIN

struct bead_movie_chapter {
    double start;      /* s of the movie */
    const char *title; /* plain text */
};

struct bead_movie_subtitle {
    double start, end; /* s of the movie */
    const char *text;  /* plain */
};

struct bead_movie_settings {
    size_t size;       /* of this structure: BEAD_DEFAULT */
    int width, height; /* pixels, 1..16384; odd sizes are an error where the codec needs even ones */
    double fps;        /* 1/s, 0.01..1000; gif shows at most 50 a second (every second or third frame), for the same time */
    enum bead_quality quality;
    const char *title, *comment; /* metadata; may be NULL */
    bool cover;                  /* bead_movie_cover will be called */
    /* mp4, mov, mkv and webm: by rising times, the first at 0; borrowed until the movie is closed. */
    const struct bead_movie_chapter *chapters;
    size_t chapter_count;
    double length; /* s: where the last chapter ends */
    int channels;  /* of sound: 1, or 2 (left and right); 0: none. bead_movie_sound will be called. mp4, mov, mkv and webm */
    bool alpha;    /* frames and movie have alpha: webm, mov, apng, png and webp */
    /* For the same containers: by rising times, none before the last has ended; borrowed until the movie is closed. */
    const struct bead_movie_subtitle *subtitles;
    size_t subtitle_count;
    enum bead_codec_asked codec;
    bool still; /* a picture of one frame, whatever `quality` says: jpg, tif, webp or avif */
    double dpi; /* of a still in tif: pixels an inch; 0: unknown */
};

struct bead_movie;

/* Can such a movie be made? Touches no file. Errors: SCENE (extension, size, rate), UNSUPPORTED (libav was built without the
 * encoder). */
BEAD_API BEAD_CHECK enum bead_error bead_movie_check(const char *path, const struct bead_movie_settings *settings,
                                                     struct bead_message *msg);
/* On failure *movie is NULL and no file is left. Errors: those of check; IO, CODEC, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_movie_open(const char *path, const struct bead_movie_settings *settings,
                                                    struct bead_movie **movie, struct bead_message *msg);
/* The next frame, of the movie's size. The first is taken whole, whatever `changes` says; `changes` NULL: all may have changed. The
 * movie keeps neither `frame` nor `changes`. After an error only close and abort make sense. Errors: IO, CODEC, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_movie_add(struct bead_movie *movie, const struct bead_frame *frame,
                                                   const struct bead_changes *changes, struct bead_message *msg);
/* A PNG file in memory, of the movie's size, as the movie's cover: at any time before close, if the settings announced it.
 * Containers other than mp4 have none; nothing happens then. Errors: CODEC, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_movie_cover(struct bead_movie *movie, const uint8_t *png, size_t bytes,
                                                     struct bead_message *msg);
/* The sound, if the settings have channels: `count` samples a channel, -1..1, interleaved, BEAD_SOUND_RATE a second from the first
 * frame on. Once, before close. Errors: CODEC, MEMORY. */
enum { BEAD_SOUND_RATE = 48000 };
BEAD_API BEAD_CHECK enum bead_error bead_movie_sound(struct bead_movie *movie, const float *samples, size_t count,
                                                     struct bead_message *msg);
/* Frees the movie in any case; on failure no file is left. *bytes (may be NULL): size of the file. Errors: IO, CODEC
 * (also where an earlier add failed, or no frame was added). */
BEAD_API BEAD_CHECK enum bead_error bead_movie_close(struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg);
/* Frees the movie and removes its file. NULL is allowed. */
BEAD_API void bead_movie_abort(struct bead_movie *movie);

BEAD_END

#endif
