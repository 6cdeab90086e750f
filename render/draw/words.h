/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of words: their style, their width, and shortening them to the room that there is. */
#pragma once

#include "beadreel/view.h"

/* From the baseline of a heading, of images and of plots, to the plot below it, in units of the label's font size. */
static const double bead_heading_drop = 0.6;

/* Text in the look's family, from the left. */
struct bead_text_style bead_words_style(const struct bead_look *look, double size, struct bead_rgb colour, enum bead_align down);
/* px, of markup. */
double bead_words_width(cairo_t *cr, const struct bead_text_style *style, const char *markup);
/* Draws markup into a box, which cuts it off; `x`, `y`: see bead_text_draw. */
void bead_words_draw_within(cairo_t *cr, const struct bead_text_style *style, struct bead_rect box, double x, double y,
                            const char *markup);
/* Writes the markup of as much of `text` as fits into `room` px, with an ellipsis where it is cut; "": nothing fits. `marked`: the
 * text is one for bead_markup, else plain. Returns the width, px. */
double bead_words_fit(cairo_t *cr, const struct bead_text_style *style, const char *text, bool marked, double room, char *markup,
                      size_t size);
