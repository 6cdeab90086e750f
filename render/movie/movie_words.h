/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of a movie's frame: time, facts, headings, captions, title card. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/scene.h"
#include "beadreel/view.h"
#include "render/draw/axis.h"
#include "render/movie/film_clock.h"

/* The format of times: in the unit of the picture's time axes, with a fixed number of decimals. */
struct bead_clock {
    double unit;   /* s */
    char sign[16]; /* "ms"; "": times have no unit */
    int decimals;
};

/* For times up to `end`, `step` apart, s. */
struct bead_clock bead_clock_make(double end, double step, const char *unit);
/* Markup of "t = 1.640 ms", with figures of one width. */
void bead_clock_text(const struct bead_clock *clock, double time, const struct bead_look *look, char *out, size_t size);
struct bead_text_style bead_clock_style(const struct bead_look *look);

/* Facts about the whole picture. */
struct bead_facts {
    const struct bead_film_clock *film;
    struct bead_clock clock;
    double magnify; /* 0: displacements are not shown */
    bool keyed;     /* a key of the beads names their materials */
    const struct bead_chain *const *chains;
    size_t chain_count;
    bool held; /* frames show the largest forces since the one before */
};
/* Facts common to all chains, text for bead_markup: "large-steel:aluminium, striker 0.443 m/s"; "" if none. */
void bead_facts_chain(const struct bead_facts *facts, char *out, size_t size);
/* "1 s of film = 0.28 ms", in the unit of the clock; equations have times without a unit. */
void bead_facts_speed(const struct bead_facts *facts, double factor, char *out, size_t size);
/* Lines that all facts need in `room` px. */
size_t bead_facts_lines(const struct bead_look *look, const struct bead_facts *facts, double room);
/* In as many lines as they need, from the left or ending at the right. */
void bead_facts_draw(cairo_t *cr, const struct bead_look *look, const struct bead_facts *facts, struct bead_rect rect, bool left);
/* "slowed 3 600 times", at a time of the motion; "1 s of film = 5 time units" if times have no unit. */
void bead_badge_text(const struct bead_facts *facts, double time, char *out, size_t size);
/* px, of the widest that the film shows. */
double bead_badge_width(const struct bead_look *look, const struct bead_facts *facts);
/* At the left of `rect`. */
void bead_badge_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect);
/* Text in one line, or in two if `rect` is high enough; cut with an ellipsis. The style's `down` is BEAD_ALIGN_MIDDLE. */
void bead_lines_draw(cairo_t *cr, struct bead_text_style style, const char *plain, struct bead_rect rect);
/* Name, M and label of a chain. */
struct bead_heading {
    const struct bead_chain *chain;
    struct bead_rgb colour; /* of the name */
    bool lines;             /* two: the label is below the name */
    bool below;             /* M is in that line, too */
    double size;            /* of the name, a part of the usual one */
};
bool bead_heading_has(const struct bead_chain *chain);
/* px, of the label alone, and of one line with the name; 0: no label. */
double bead_label_width(const struct bead_look *look, const struct bead_chain *chain);
double bead_heading_width(const struct bead_look *look, const struct bead_chain *chain);
/* px, of the name at its smallest, and M unless that is below it. */
double bead_heading_least(const struct bead_look *look, const struct bead_chain *chain, bool m);
/* The part of its usual size at which the name fits, or the smallest; regardless of the heading's own. */
double bead_heading_name(const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect);
/* Free space beside headings, in units of the ticks' size; chosen by eye. */
#define BEAD_HEADING_AIR 1.3
/* The size of labels that would otherwise have no room, as a part of the usual one; chosen by eye. */
#define BEAD_SMALLER_LABEL 0.85
/* The part of its usual size at which the label fits; 1: in full, or not at all. */
double bead_heading_label(const struct bead_look *look, const struct bead_heading *heading, struct bead_rect rect);
/* M is beside the name or, in the second line, before the label. A label that does not fit at this part of its size is left out, M
 * never. */
void bead_heading_draw(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, double label,
                       struct bead_rect rect);
/* px, of a chain's name above its image at its smallest; 0: it has none. */
double bead_name_least(const struct bead_look *look, const struct bead_chain *chain);
/* The part of its usual size at which it fits, or the smallest. */
double bead_name_size(const struct bead_look *look, const struct bead_chain *chain, double width);
/* Right-aligned, at this part of its usual size; as much as fits. */
void bead_name_draw(cairo_t *cr, const struct bead_look *look, const struct bead_heading *heading, double size,
                    struct bead_rect rect);

/* ---- captions: captions.c ---- */

/* The caption at a time of the motion; SIZE_MAX: none. A caption stays until the next one or until its own end; the last one, if it
 * has no end, for the time it takes to read, at least 2.5 s of the film. */
size_t bead_captions_find(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, double time);
/* The end of a caption, s of the motion; INFINITY: the end of the film. */
double bead_caption_end(const struct bead_movie_asked *movie, const struct bead_film_clock *clock, size_t caption);
/* Lines that the longest caption needs in a frame of that width: at most 2, or 0 without captions. */
int bead_captions_lines(const struct bead_movie_asked *movie, const struct bead_look *look, int width);
/* Height of a line, px. */
double bead_caption_height(const struct bead_look *look);
/* Centred in `rect`, in as many lines as fit; a long caption gets smaller type and is cut as a last resort. */
void bead_caption_draw(cairo_t *cr, const struct bead_look *look, const char *text, struct bead_rect rect);

/* ---- the title card: movie_card.c ---- */

/* Over the whole of a frame of width x height px: title, headings with the beads of their chains, facts. `text`: a line below the
 * title; NULL or "": none. `stage`: how the view stage draws a chain of this film; NULL: chains have no beads. Errors: MEMORY,
 * GRAPHICS. */
BEAD_CHECK enum bead_error bead_card_draw(cairo_t *cr, const struct bead_facts *facts, const struct bead_view_setup *stage,
                                          const struct bead_look *look, const char *title, const char *text, const int size[2],
                                          struct bead_message *msg);
