/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sketches: the strokes of schematic drawings. The box of every text is kept, to check that all can be read. Lengths in px, y
 * downwards. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/scene.h"
#include "render/draw/axis.h"

struct bead_box {
    double x, y, width, height;
};

struct bead_sketch {
    cairo_t *cr;
    const struct bead_look *look;
    struct bead_box *boxes; /* of texts, in the order drawn */
    size_t count, room;
    bool failed; /* out of memory for boxes */
};

void bead_sketch_free(struct bead_sketch *sketch);
/* Do two texts overlap, or does one leave 0..width, 0..height? */
bool bead_sketch_crowded(const struct bead_sketch *sketch, double width, double height);

/* The look's text; `size` of the font. */
struct bead_text_style bead_sketch_style(const struct bead_sketch *sketch, double size);
double bead_sketch_width(const struct bead_text_style *style, const char *markup);
/* A line of text: y is the middle of its digits and capitals, x its start, middle or end. */
void bead_sketch_text(struct bead_sketch *sketch, const struct bead_text_style *style, double x, double y, const char *markup);

void bead_sketch_colour(struct bead_sketch *sketch, struct bead_rgb colour);
/* `part` of a colour, the rest of the background's. */
struct bead_rgb bead_sketch_mixed(const struct bead_look *look, struct bead_rgb colour, double part);
void bead_sketch_line(struct bead_sketch *sketch, double x0, double y0, double x1, double y1);
void bead_sketch_dashed(struct bead_sketch *sketch, bool dashed);
/* With a head at its end and, if `both`, at its start. */
void bead_sketch_arrow(struct bead_sketch *sketch, double x0, double y0, double x1, double y1, bool both);
/* A curly brace below x0..x1 at y, its point `depth` lower. */
void bead_sketch_brace(struct bead_sketch *sketch, double x0, double x1, double y, double depth);
/* A ball lit from above left. */
void bead_sketch_ball(struct bead_sketch *sketch, double x, double y, double r, const double colour[3]);
/* Three dots in place of beads left out. */
void bead_sketch_dots(struct bead_sketch *sketch, double x, double y, double width);
/* Slanted lines in a rectangle, which is first filled with `colour` (NULL: not filled). */
void bead_sketch_hatch(struct bead_sketch *sketch, struct bead_box box, const double colour[3]);

/* Pieces of text one after the other, each with an optional ball before it, in as many lines as the area's width requires; the last
 * line is at the bottom. The area shrinks by their height. False: no room. */
struct bead_piece {
    char markup[512];
    const double *colour; /* of a ball; NULL: none */
};
bool bead_sketch_pieces(struct bead_sketch *sketch, struct bead_box *area, const struct bead_piece *pieces, size_t count,
                        bool centred);

/* Labels in a row, left to right, each as close to its anchor as the others and low..high allow. */
struct bead_label {
    double anchor, width; /* px */
    double x;             /* found: left end */
};
enum { BEAD_LABELS = 64 }; /* in a row, at most */
/* `labels` in the order of their anchors; false: they do not fit. */
bool bead_labels_spread(struct bead_label *labels, size_t count, double gap, double low, double high);

/* Words that schematic drawings share. */

/* "dimer", "trimers"; "cell" for long ones. */
const char *bead_cell_word(size_t beads, bool several);

/* Markup of a letter in mathematical italics with a lower index (0: none). */
void bead_symbol_words(const char *letter, int index, char *out, size_t size);
/* Markup: "large steel, R = 4.76 mm, 3.63 g"; for several that differ only in size, "a to b, R = 4.76 mm to 1.80 mm, 3.63 g to
 * 0.195 g"; for one, if first is last. */
void bead_materials_words(const struct bead_material *first, const struct bead_material *last, char *out, size_t size);
