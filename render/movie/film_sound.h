/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sound of a film: a force, slowed like the picture. */
#ifndef BEADREEL_RENDER_MOVIE_FILM_SOUND_H
#define BEADREEL_RENDER_MOVIE_FILM_SOUND_H

#include "beadreel/movie.h"
#include "beadreel/sink.h"
#include "render/movie/movie_times.h"

struct bead_film_sound;

/* NULL where the output asks for none. Errors: SCENE (no chain has what is asked for; the film is too long), MEMORY. */
BEAD_CHECK enum bead_error bead_film_sound_create(const struct bead_output *output, const struct bead_run_context *context,
                                                  const struct bead_movie_times *times, struct bead_film_sound **sound,
                                                  struct bead_message *msg);
void bead_film_sound_destroy(struct bead_film_sound *sound);
/* Of the movie's file: 1, or 2 for several chains, the first at the left, the last at the right. */
int bead_film_sound_channels(const struct bead_film_sound *sound);
/* Adds what it needs of each sample. */
void bead_film_sound_needs(const struct bead_film_sound *sound, struct bead_needs *needs);
/* A sample on the grid of the times. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_film_sound_feed(struct bead_film_sound *sound, const struct bead_sample *sample,
                                                struct bead_message *msg);
/* The sound of the whole film into its movie. Errors: MEMORY, CODEC. */
BEAD_CHECK enum bead_error bead_film_sound_write(const struct bead_film_sound *sound, struct bead_movie *movie,
                                                 struct bead_message *msg);

#endif
