/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sound of movies, in containers that have it. */
#ifndef BEADREEL_RENDER_ENCODE_SOUND_H
#define BEADREEL_RENDER_ENCODE_SOUND_H

#include "render/encode/movie_private.h"
#include "render/encode/tracks.h"

/* What encodes it. */
struct bead_sound_format {
    const char *encoder; /* libav's name */
    enum AVSampleFormat samples;
    int64_t bit_rate; /* 1/s, a channel */
};
extern const struct bead_sound_format bead_sound_aac, bead_sound_opus;

/* A track of the samples (see bead_movie_sound). Returns libav's number of an error. */
int bead_sound_make(const struct bead_av *av, const struct bead_sound_format *format, const float *samples, size_t count,
                    int channels, struct bead_tracks *tracks);

#endif
