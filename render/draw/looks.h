/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks of pictures and lines of text, in addition to those that a program's own views need. */
#pragma once

#include "beadreel/view.h"

/* Paper look (lengths with dpi: 8 pt type) or screen look (type in proportion to the height, always legible). */
void bead_look_paper(struct bead_look *look, double dpi);
void bead_look_screen(struct bead_look *look, int width, int height, bool dark);
/* Screen look for films: type in parts of the shorter side of the frame, 3 % for labels, `large` 4 %; on upright frames, for
 * phones, 5 and 6 %. */
void bead_look_film(struct bead_look *look, int width, int height, bool dark, bool large);
/* Sets the type of a film's look to this part of its size, but no smaller than legible. */
void bead_look_type(struct bead_look *look, double part);
/* The smallest legible part of its type. */
double bead_look_least_type(const struct bead_look *look);
/* Screen look for a projector: larger type, thicker lines. */
void bead_look_slide(struct bead_look *look, int width, int height, bool dark);
/* Patterns that distinguish lines without their colours: 0 is solid; the last is for plateaus and fits. */
enum { BEAD_DASHES = 6, BEAD_DASH_DOTTED = BEAD_DASHES };
struct bead_dashes {
    int count;
    double lengths[6]; /* on and off, in widths of the line */
};
/* Pattern number `index`, from 0; after BEAD_DASH_DOTTED they repeat. */
const struct bead_dashes *bead_look_dashes(size_t index);
/* Sets another family for all letters; NULL, "auto": no change. */
void bead_look_font(struct bead_look *look, const char *family);
void bead_rgb_set(cairo_t *cr, struct bead_rgb colour);
/* `part` of the way from a to b. */
struct bead_rgb bead_rgb_mix(struct bead_rgb a, struct bead_rgb b, double part);
/* What is behind curves. */
struct bead_rgb bead_look_ground(const struct bead_look *look);
/* Paint the whole page, or a rectangle of a panel, in the look's colours; nothing if it is clear. */
void bead_look_paint(const struct bead_look *look, cairo_t *cr);
void bead_look_paint_panel(const struct bead_look *look, cairo_t *cr, double x, double y, double width, double height);
/* Is there any font to write with? Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_text_check(struct bead_message *msg);
/* bead_text_draw and bead_text_size in lines no wider than `wrap` px, aligned as `across` says; wrap 0: one line; < 0: one line no
 * wider than -wrap px, with an ellipsis in the middle if it is longer. */
void bead_text_draw_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, double x, double y, const char *markup);
void bead_text_size_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup, double *width,
                          double *height);
/* Gives a look the dark colours of screens. */
void bead_look_darken(struct bead_look *look);

/* Fonts that come with the program. */

/* If the assets have fonts/fonts.conf, fontconfig reads that instead of the system's configuration, unless FONTCONFIG_FILE names
 * another. Call it before Pango first looks for a font; only the first call has an effect. */
void bead_fonts_use_own(void);
