/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of a movie's frame: time, facts, headings. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_WORDS_H
#define BEADREEL_RENDER_MOVIE_MOVIE_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/frame.h"
#include "beadreel/look.h"
#include "render/movie/film_clock.h"

/* How times are written: in the unit of the picture's axes of time, always with the same width. */
struct bead_clock {
    double unit;   /* s */
    char sign[16]; /* "ms"; "": times have no unit */
    int digits, decimals;
};

/* For times up to `end`, `step` apart, s. */
struct bead_clock bead_clock_make(double end, double step, const char *unit);
/* Markup of "t = 1.640 ms", padded to constant width. */
void bead_clock_text(const struct bead_clock *clock, double time, const struct bead_look *look, char *out, size_t size);
struct bead_text_style bead_clock_style(const struct bead_look *look);

/* Facts about the whole picture. */
struct bead_facts {
    const struct bead_film_clock *film;
    struct bead_clock clock;
    double magnify; /* 0: displacements are not shown */
    const struct bead_chain *const *chains;
    size_t chain_count;
};
/* What all chains have in common: "large-steel:aluminium, striker 0.443 m/s"; "" if nothing. Text for bead_markup. */
void bead_facts_chain(const struct bead_facts *facts, char *out, size_t size);
/* Right-aligned in `rect`; facts that do not fit are left out, the last ones first. */
void bead_facts_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, struct bead_rect rect, bool left);
/* A line of text, cut with an ellipsis. */
void bead_line_draw(cairo_t *cr, struct bead_text_style style, const char *plain, struct bead_rect rect);
/* Name, M and label of a chain. */
struct bead_heading {
    const struct bead_chain *chain;
    struct bead_rgb colour; /* of the name */
    bool lines;             /* two: the label stands below the name */
};
bool bead_heading_has(const struct bead_chain *chain);
/* px, of one line; 0: there is no label. */
double bead_heading_width(const struct bead_look *look, const struct bead_chain *chain);
/* A label that does not fit is left out. */
void bead_heading_draw(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect);

/* ---- the title card: what is to be seen, and how slowly ---- */

/* Over the whole of a frame of width x height px. `text`: a line below the title; NULL or "": none. */
void bead_card_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, const char *title, const char *text,
                    int width, int height);

#endif
