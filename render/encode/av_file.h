/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of libav, read and written by descriptor: after the first time no name is looked up, and no link followed. */
#pragma once

#include <stdbool.h>

#include "beadreel/error.h"
#include "render/encode/libav.h"
#include "render/encode/tracks.h"

/* Open `part` like bead_file_open, and empty it. A failure leaves no new file. Errors: IO. */
BEAD_CHECK enum bead_error bead_av_file_create(const char *part, int *descriptor, struct bead_message *msg);
/* A context that reads or writes the whole file from its beginning, with its own position; NULL: out of memory. The caller keeps
 * the descriptor. */
AVIOContext *bead_av_file_wrap(int descriptor, bool writes);
/* Free a context without flushing it, and set *context to NULL. NULL and pointers to NULL are allowed. */
void bead_av_file_unwrap(AVIOContext **context);

/* Added to the pictures in the finished file. */
struct bead_av_beside {
    AVRational frame_time; /* s: duration of the last picture */
    struct bead_tracks *tracks;
    AVPacket *cover; /* PNG; NULL: none */
    int format;      /* of pixels: enum AVPixelFormat */
};
/* Copy the movie in `from`, with the additions, into the file `to`, without encoding.
 * `to` has its metadata, but no streams and no file yet. Returns 0 or libav's error number. */
int bead_av_copy(int from, AVFormatContext *to, int descriptor, AVDictionary **options, const struct bead_av_beside *beside);

/* Make a GIF file from a finished lossless movie: from the descriptor of an APNG file to that of an empty file; `frames` in all, of
 * `frame_time` s each. Returns 0 or libav's error number. */
int bead_gif_make(int from, int to, AVRational frame_time, int64_t frames);
