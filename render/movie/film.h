/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all sinks of a movie know before the run: its frames, what these need of samples, and the composer that draws them. */
#ifndef BEADREEL_RENDER_MOVIE_FILM_H
#define BEADREEL_RENDER_MOVIE_FILM_H

#include "beadreel/sink.h"
#include "render/movie/composer.h"
#include "render/movie/movie_times.h"

/* Everything but its own numbers is borrowed. */
struct bead_film {
    const struct bead_output *output;
    struct bead_run_context context;
    int width, height;
    struct bead_movie_times times;
    unsigned fields, comparison; /* BEAD_FIELD_BITs, of samples and of those of the comparison run */
    size_t last_bead;            /* the last bead needed of the longest chain */
};

/* Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_film_prepare(const struct bead_output *output, const struct bead_run_context *context,
                                             struct bead_film *film, struct bead_message *msg);
/* Those of all frames. */
void bead_film_needs(const struct bead_film *film, const char *why, struct bead_needs *needs);
/* Is the range of its colours only known after a scouting pass? */
bool bead_film_scouts(const struct bead_film *film);
/* `range`: as scouted; `interest`: is bead_composer_interest wanted? Errors: those of bead_composer_create. */
BEAD_CHECK enum bead_error bead_film_compose(const struct bead_film *film, struct bead_range range, bool interest,
                                             struct bead_composer **composer, struct bead_message *msg);

#endif
