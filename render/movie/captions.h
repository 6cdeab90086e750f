/* Captions of a movie: which one is shown when, and how. */
#ifndef BEADREEL_RENDER_MOVIE_CAPTIONS_H
#define BEADREEL_RENDER_MOVIE_CAPTIONS_H

#include <cairo.h>
#include <stddef.h>

#include "beadreel/look.h"
#include "beadreel/scene.h"

/* The caption at a time of the motion; SIZE_MAX: none. `slowed`: s of the film for one of the motion. One stays until the next
 * appears or its own end; the last without an end for as long as it takes to read, at least 2.5 s of the film. */
size_t bead_captions_find(const struct bead_movie_asked *movie, double slowed, double time);
/* Lines that the longest needs in a frame of that width: 0 where there is none, at most 2. */
int bead_captions_lines(const struct bead_movie_asked *movie, const struct bead_look *look, int width);
/* Height of a line, px. */
double bead_caption_height(const struct bead_look *look);
/* In the middle of `rect`, in as many lines as it has room for; smaller, and in the end cut, where it is too long. */
void bead_caption_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect);

/* Does the movie show the times that captions and poster are given for? `end`: of what it shows, in `unit`. Scenes that give the
 * run's end have been checked; this is for runs whose end is found. Errors: SCENE. */
BEAD_CHECK enum bead_error bead_captions_check(const struct bead_output *output, const struct bead_scene *scene, double end,
                                               const char *unit, struct bead_message *msg);

#endif
