/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks and text: colours, lines and letters of a picture. All lengths in device pixels; a vector file's context is scaled so that
 * its unit is the pixel of the raster inside. */
#ifndef BEADREEL_LOOK_H
#define BEADREEL_LOOK_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/frame.h"
#include "beadreel/scene.h"

BEAD_BEGIN

struct bead_rgb {
    double r, g, b;
};

struct bead_look {
    bool dark, clear;          /* clear: nothing is painted behind what is drawn */
    char family[64];           /* Pango font family: "STIX" on paper, "Lato" on screens */
    double title, label, tick; /* font sizes, px */
    double line;               /* width of axes and curves, px */
    double gap;                /* the usual distance between things, px */
    double margin;             /* between the page's border and what is on it, px */
    struct bead_rgb background, panel, ink, faint, accent;
    struct bead_rgb axis; /* lines and ticks */
};

/* Paper look (lengths with dpi: 8 pt type) or screen look (type in proportion to the height, never unreadably small). */
BEAD_API void bead_look_paper(struct bead_look *look, double dpi);
BEAD_API void bead_look_screen(struct bead_look *look, int width, int height, bool dark);
/* Screen look for films: type in parts of the shorter side of the frame, 3 % for labels; `large`: 4 %. */
BEAD_API void bead_look_film(struct bead_look *look, int width, int height, bool dark, bool large);
/* Screen look for a projector: larger type, thicker lines. */
BEAD_API void bead_look_slide(struct bead_look *look, int width, int height, bool dark);
/* Another family for all letters; NULL, "auto": as it is. */
BEAD_API void bead_look_font(struct bead_look *look, const char *family);

/* Paint all of the page, or a rectangle of a panel, in the look's colours; nothing where it is clear. */
BEAD_API void bead_look_paint(const struct bead_look *look, cairo_t *cr);
BEAD_API void bead_look_paint_panel(const struct bead_look *look, cairo_t *cr, double x, double y, double width, double height);

/* Colour of the curve of this number, from 0; six, then again. */
BEAD_API struct bead_rgb bead_look_curve(const struct bead_look *look, size_t index);

enum bead_align { BEAD_ALIGN_START, BEAD_ALIGN_MIDDLE, BEAD_ALIGN_END, BEAD_ALIGN_BASELINE };

struct bead_text_style {
    const char *family;
    double size; /* px */
    struct bead_rgb colour;
    bool bold;
    enum bead_align across, down; /* where (x, y) lies in the text's box: start, middle, end; down also baseline */
    bool upwards;                 /* turned by 90 degrees, read from bottom to top; across/down then mean the screen's axes */
};
/* BEAD_ALIGN_MIDDLE of `down` is the middle of digits and capitals, which looks right beside ticks. */
/* Is there any font to write with? Errors: GRAPHICS. */
BEAD_API BEAD_CHECK enum bead_error bead_text_check(struct bead_message *msg);
/* Draw Pango markup at (x, y). */
BEAD_API void bead_text_draw(cairo_t *cr, const struct bead_text_style *style, double x, double y, const char *markup);
/* Size of its logical box, before turning. */
BEAD_API void bead_text_size(cairo_t *cr, const struct bead_text_style *style, const char *markup, double *width, double *height);
/* As above, in lines no wider than `wrap` px, aligned as `across` says; wrap 0: one line; < 0: one line no
 * wider than -wrap px, with an ellipsis in the middle where it is longer. */
BEAD_API void bead_text_draw_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, double x, double y,
                                   const char *markup);
BEAD_API void bead_text_size_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup, double *width,
                                   double *height);
/* Plain text to markup: escapes & < >; `out` of `size` bytes; cut between characters where it is too long. */
BEAD_API void bead_text_escape(const char *text, char *out, size_t size);

BEAD_END

#endif
