/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files as libav reads and writes them: by descriptor, so that no name is looked up, and no link followed, after the first time. */
#ifndef BEADREEL_RENDER_ENCODE_AV_FILE_H
#define BEADREEL_RENDER_ENCODE_AV_FILE_H

#include <stdbool.h>

#include "beadreel/error.h"
#include "render/encode/libav.h"
#include "render/encode/tracks.h"

/* Open `part` as bead_file_open does, and empty it. On failure no new file is left. Errors: IO. */
BEAD_CHECK enum bead_error bead_av_file_create(const char *part, int *descriptor, struct bead_message *msg);
/* A context that writes to, or reads, the whole file from its beginning, at a place of its own; NULL: no memory. The descriptor
 * stays the caller's. */
AVIOContext *bead_av_file_wrap(const struct bead_av *av, int descriptor, bool writes);
/* Free it without flushing, and set *context to NULL. NULL and pointers to NULL are allowed. */
void bead_av_file_unwrap(const struct bead_av *av, AVIOContext **context);

/* What comes to the pictures in the finished file. */
struct bead_av_beside {
    AVRational frame_time; /* s: how long the last picture lasts */
    struct bead_tracks *tracks;
    AVPacket *cover; /* PNG; NULL: none */
};
/* The movie that `from` holds, and what comes to it, into the file `to`, in the same container with other options, without
 * encoding. `to` knows its metadata, but neither streams nor file yet. Returns 0 or libav's negative number. */
int bead_av_copy(const struct bead_av *av, int from, AVFormatContext *to, int descriptor, AVDictionary **options,
                 const struct bead_av_beside *beside);

#endif
