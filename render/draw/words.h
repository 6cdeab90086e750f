/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of pictures: lines of text cut to the available room, names of chains and materials, numbers and units. */
#pragma once

#include <stddef.h>

#include "beadreel/chain.h"
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
 * text is for bead_markup, else plain. Returns the width, px. */
double bead_words_fit(cairo_t *cr, const struct bead_text_style *style, const char *text, bool marked, double room, char *markup,
                      size_t size);

/* Names of chains and materials in pictures: never the identifiers of the scene. */

/* "" for an unnamed chain. */
static inline const char *bead_chain_title(const struct bead_chain *chain)
{
    const char *title = bead_chain_spec(chain)->title;
    return title ? title : "";
}

/* Fewest decimals, at most three, that write a magnetism: 0 for 1, 2 for 0.25, 3 for 1/3. */
int bead_magnetism_digits(double magnetism);
/* The number for the chain that needs the most, for a whole picture. */
int bead_magnetism_decimals(const struct bead_chain *const *chains, size_t count);

/* Plain text: "brass wall", "rigid wall". */
void bead_wall_name(const struct bead_chain *chain, char *out, size_t size);
/* Plain text: "driven from 1.00 kHz to 20.0 kHz", "striker 0.5 m/s"; "" if neither moves the chain. */
void bead_mover_name(const struct bead_chain *chain, char *out, size_t size);

/* Numbers and units as people write them. */

/* Power of ten, a multiple of 3, of the prefix that brings |value| into 1..1000 in `si_unit`, as far as the unit takes prefixes. */
int bead_prefix_exponent(double value, const char *si_unit);
/* "µ" for -6, "" for 0. */
const char *bead_prefix_sign(int exponent);
/* A number with a true minus sign and, from five digits on, thin spaces between thousands. */
void bead_number(double number, int decimals, char *out, size_t size);
/* "3 600" from 3571: two significant digits, thousands apart; powers of ten from 1e5 on, "2.5·10⁶". */
void bead_round_number(double x, char *out, size_t size);
/* 10^exponent; shown values are SI values divided by it, exactly rounded for negative exponents too. */
double bead_power_of_ten(int exponent);
