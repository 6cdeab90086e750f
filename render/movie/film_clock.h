/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time of the film against time of the motion: even, or with a speed that changes and pauses at captions. */
#pragma once

#include "beadreel/scene.h"

enum { BEAD_FILM_PIECES = 320 };

/* Begins at `motion` (s of the motion) and `film` (s of the film); first the picture is still for `pause` s. */
struct bead_film_piece {
    double motion, film, pause;
    double factor[2]; /* s of the motion for one of the film, at both ends; between them, linear on a logarithmic scale */
};

struct bead_film_clock {
    double slowed; /* s of the film for one of the motion, if there are no pieces: time is even */
    size_t count;
    struct bead_film_piece piece[BEAD_FILM_PIECES + 1]; /* the last is the end */
};

/* For motion from time[0] to time[1], s, which takes `duration` s of the film if the scene gives no speeds. */
void bead_film_clock_make(const struct bead_movie_asked *movie, const double time[2], double duration,
                          struct bead_film_clock *clock);
/* s of the film from its first picture of the motion to the last. */
double bead_film_length(const struct bead_film_clock *clock);
/* The time of the motion that the film shows; and when it first shows one, before any pause there. Only with pieces. */
double bead_film_motion(const struct bead_film_clock *clock, double film);
double bead_film_time(const struct bead_film_clock *clock, double motion);
/* The time of the motion `lasting` s of the film after `motion`; INFINITY: beyond the end. */
double bead_film_after(const struct bead_film_clock *clock, double motion, double lasting);
/* s of the motion for one of the film at a time of the motion; 0: there is a pause. */
double bead_film_factor(const struct bead_film_clock *clock, double motion);
/* The least and the greatest of these, without pauses. */
void bead_film_factors(const struct bead_film_clock *clock, double factors[2]);
