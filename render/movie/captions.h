/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Captions of a movie: which one is shown when, and how. */
#ifndef BEADREEL_RENDER_MOVIE_CAPTIONS_H
#define BEADREEL_RENDER_MOVIE_CAPTIONS_H

#include <cairo.h>
#include <stddef.h>

#include "beadreel/look.h"
#include "beadreel/scene.h"
#include "render/movie/film_clock.h"

/* The caption at a time of the motion; SIZE_MAX: none. A caption stays until the
 * next one or until its own end. The last one, if it has no end, stays as long as it takes to read, at least 2.5 s of the film. */
size_t bead_captions_find(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, double time);
/* Until when a caption stays, s of the motion; INFINITY: to the end of the film. */
double bead_caption_end(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, size_t caption);
/* Lines that the longest caption needs in a frame of that width: at most 2, or 0 without captions. */
int bead_captions_lines(const struct bead_movie_asked *movie, const struct bead_look *look, int width);
/* Height of a line, px. */
double bead_caption_height(const struct bead_look *look);
/* Centred in `rect`, in as many lines as fit; a long caption gets smaller type and is cut as a last resort. */
void bead_caption_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect);

/* The text without its marks, for chapters and subtitles. */
void bead_caption_plain(const char *text, char *out, size_t size);

/* Checks that the movie shows the times of captions and poster, for runs whose end the scene does not give. `end`: the last time
 * shown, in `unit`. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_captions_check(const struct bead_output *output, const struct bead_scene *scene, double end,
                                               const char *unit, struct bead_message *msg);

#endif
