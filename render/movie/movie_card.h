/* The title card of a movie: what is to be seen, and how slowly. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_CARD_H
#define BEADREEL_RENDER_MOVIE_MOVIE_CARD_H

#include "render/movie/movie_words.h"

/* Over the whole of a frame of width x height px. `text`: a line below the title; NULL or "": none. */
void bead_card_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, const char *title, const char *text,
                    int width, int height);

#endif
