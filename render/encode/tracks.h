/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tracks beside the pictures of a movie, such as subtitles: packets that are ready when the finished file is written. */
#ifndef BEADREEL_RENDER_ENCODE_TRACKS_H
#define BEADREEL_RENDER_ENCODE_TRACKS_H

#include <stddef.h>

#include "render/encode/libav.h"

struct bead_track {
    AVCodecParameters *codec;
    AVRational unit;    /* s: of the times of the packets */
    const char *title;  /* borrowed; NULL: none */
    AVPacket **packets; /* [room], by rising times */
    size_t count, room;
    size_t written;
    int stream; /* its number in the file */
};

enum { BEAD_TRACKS = 2 };
struct bead_tracks {
    struct bead_track track[BEAD_TRACKS];
    size_t count;
};

/* A track without packets, behind the others. NULL: no memory. */
struct bead_track *bead_tracks_add(const struct bead_av *av, struct bead_tracks *tracks);
/* An empty packet behind the others; the track's. NULL: no memory. */
AVPacket *bead_track_add(const struct bead_av *av, struct bead_track *track);
void bead_tracks_free(const struct bead_av *av, struct bead_tracks *tracks);

/* Streams for them in a file whose header is not written yet. Both return libav's number of an error. */
int bead_tracks_open(const struct bead_av *av, struct bead_tracks *tracks, AVFormatContext *to);
/* Write what begins before `time`, in the given unit, in order of time. Packets are written once. */
int bead_tracks_write(const struct bead_av *av, struct bead_tracks *tracks, AVFormatContext *to, int64_t time, AVRational unit);

#endif
