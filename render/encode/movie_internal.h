/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies, for the project's own code only. */
#pragma once

#include "beadreel/movie.h"

/* File extensions that can be written, with a description of the codec: row `index`, NULL after the last. */
struct bead_codec_info {
    const char *extension, *description;
};
const struct bead_codec_info *bead_movie_codec(size_t index);
/* "libavcodec (libx264)"; "": pictures are not encoded. */
const char *bead_movie_encoder(const struct bead_movie *movie);
uint64_t bead_movie_frames(const struct bead_movie *movie);  /* shown */
uint64_t bead_movie_encoded(const struct bead_movie *movie); /* given to the encoder */
/* Ends the movie here, unfinished: path.part stays and plays, and a file `path` of an earlier movie is kept. Frees the movie in any
 * case; on failure no part is left. *bytes (may be NULL): size of the part. Errors: as of close. */
BEAD_CHECK enum bead_error bead_movie_stop(struct bead_movie *movie, uint64_t *bytes, struct bead_message *msg);
