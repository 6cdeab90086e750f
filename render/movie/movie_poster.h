/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The poster of a movie: one of its frames, kept while it passes, as a PNG file. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_POSTER_H
#define BEADREEL_RENDER_MOVIE_MOVIE_POSTER_H

#include "beadreel/movie.h"
#include "beadreel/sink.h"
#include "render/movie/composer.h"

/* Which frame it is. */
struct bead_poster_choice {
    double at, slack; /* s; at NaN: the frame that shows most */
    double interest;  /* of the best so far */
    bool taken;       /* there is one */
};
/* `at`: a time of the motion, s, or NaN; `step`: s of the motion between frames. */
struct bead_poster_choice bead_poster_choose(double at, double step);
/* Is a frame of this time as late as the choice asks? */
bool bead_poster_reached(const struct bead_poster_choice *choice, double time);
/* Asked of each frame in turn: is it the one, or better than all before? */
bool bead_poster_prefers(struct bead_poster_choice *choice, const struct bead_composer *composer, double time);
/* A frame as a PNG file with the scene's title. Errors: IO, MEMORY. */
BEAD_CHECK enum bead_error bead_poster_file(const char *path, const struct bead_frame *frame, const struct bead_scene *scene,
                                            uint64_t *bytes, struct bead_message *msg);

struct bead_poster;

/* For an output with a poster, to the file `path`; `step`: s of the motion between frames. `path` and scene are the
 * caller's. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_poster_create(const struct bead_output *output, const struct bead_scene *scene, const char *path,
                                              double step, struct bead_poster **poster, struct bead_message *msg);
/* NULL is allowed. */
void bead_poster_destroy(struct bead_poster *poster);
/* Call after each draw: keeps the frame if it is the requested one, or shows more than all before. */
BEAD_CHECK enum bead_error bead_poster_offer(struct bead_poster *poster, const struct bead_composer *composer, double time,
                                             struct bead_message *msg);
/* Writes the file, if any frame was offered, and gives it to the movie as its cover. `bytes`: size of the file, 0 if there is none.
 * Errors: IO, MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_poster_write(const struct bead_poster *poster, struct bead_movie *movie, uint64_t *bytes,
                                             struct bead_message *msg);

#endif
