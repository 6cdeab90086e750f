/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a movie's frames are: the card's first, then those of the motion, at equal steps from its first time to its last. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_TIMES_H
#define BEADREEL_RENDER_MOVIE_MOVIE_TIMES_H

#include "beadreel/sink.h"
#include "render/movie/film_clock.h"

struct bead_movie_times {
    double time[2], step; /* s: first and last frame of the motion, and between frames, at least where speed changes */
    struct bead_film_clock film;
    size_t card, frames;   /* those of the card; all */
    size_t group;          /* this many frames show the same picture: drafts have fewer pictures than frames */
    struct bead_grid grid; /* samples that they are made of */
};

/* Errors: SCENE (nothing to show, or too much). */
BEAD_CHECK enum bead_error bead_movie_times_choose(const struct bead_output *output, const struct bead_run_context *context,
                                                   struct bead_movie_times *times, struct bead_message *msg);
/* s: what frame `index` shows, or would without groups. */
double bead_movie_time(const struct bead_movie_times *times, size_t index);
/* The same between frames, at index and a fraction. */
double bead_movie_moment(const struct bead_movie_times *times, double index);
/* s of the film, from its first frame on, when a time of the motion is first shown; `fps`: frames a second. */
double bead_movie_film_time(const struct bead_movie_times *times, double motion, double fps);
/* Whether the frame has a picture of its own: the card, the first frame of each group, and the last frame have. */
bool bead_movie_draws(const struct bead_movie_times *times, size_t index);
/* How many of the frames have. */
size_t bead_movie_pictures(const struct bead_movie_times *times);
/* "120 frames (60 of them in the file: gif has at most 50 a second)", of the movie `output`. */
void bead_movie_count_words(const struct bead_movie_times *times, const struct bead_output *output, char *text, size_t size);

#endif
