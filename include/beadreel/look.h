/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks, text and axes: the parts of a picture that explain it. All lengths in device pixels; a vector
 * file's context is scaled so that its unit is the pixel of the raster inside. */
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
/* The same in lines no wider than `wrap` px, aligned as `across` says; wrap 0: one line; < 0: one line no
 * wider than -wrap px, with an ellipsis in the middle where it is longer. */
BEAD_API void bead_text_draw_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, double x, double y,
                                   const char *markup);
BEAD_API void bead_text_size_lines(cairo_t *cr, const struct bead_text_style *style, double wrap, const char *markup, double *width,
                                   double *height);
/* `seen` is called for every text drawn on this surface, with the box of its ink in device units: to see what collides. `watch` is
 * borrowed until the surface is gone. False: out of memory. */
struct bead_text_watch {
    void (*seen)(void *context, const char *markup, double x, double y, double width, double height);
    void *context;
};
BEAD_API bool bead_text_watch(cairo_surface_t *surface, const struct bead_text_watch *watch);
/* Plain text to markup: escapes & < >; `out` of `size` bytes; cut between characters where it is too long. */
BEAD_API void bead_text_escape(const char *text, char *out, size_t size);
/* Markup of "M = 0.2" in mathematical italics. */
BEAD_API void bead_text_magnetism(double magnetism, char *out, size_t size);

/* An axis from low to high (SI) over `length` px: round ticks, a unit prefix that suits the size. */
struct bead_axis {
    double low, high;
    enum bead_scale scale;
    char unit[32]; /* markup of the shown unit: "ms", "µs", "mN"; a power of ten or "" for numbers */
    double factor; /* shown = SI * factor */
    size_t count;
    struct bead_tick {
        double value;   /* SI */
        double place;   /* 0..1 from low to high */
        char label[24]; /* markup, with a proper minus sign */
    } ticks[24];
    size_t minor_count;
    double minor[96]; /* places of shorter ticks without labels between those: of uneven scales, and where there are few labels */
};
/* `em`: the ticks' font size; as many ticks as have room for their labels, set beside each other (`horizontal`) or above each
 * other. An axis whose unit is "1" counts: its ticks are whole numbers; "" is one of numbers. A range that makes no sense gets no
 * ticks. */
BEAD_API void bead_axis_make(struct bead_axis *axis, double low, double high, const char *si_unit, enum bead_scale scale,
                             double length, double em, bool horizontal);
/* 0..1 of a value on the axis. */
BEAD_API double bead_axis_place(const struct bead_axis *axis, double value);

enum bead_side { BEAD_SIDE_LEFT, BEAD_SIDE_BOTTOM, BEAD_SIDE_RIGHT };
/* Ticks, labels and title ("time (ms)" from title "time"; NULL: none) at a side of the plot rectangle; with downwards the
 * low end of a vertical axis is at the top. labels false: ticks only, no title. The line itself is not drawn: see
 * bead_box_draw. Returns how far out it reached, px. cr NULL: measures only. */
BEAD_API double bead_axis_draw(cairo_t *cr, const struct bead_look *look, const struct bead_axis *axis, struct bead_rect plot,
                               enum bead_side side, bool downwards, bool labels, const char *title);

/* Markup of "time (ms)" from the title "time". */
BEAD_API void bead_axis_title(const struct bead_axis *axis, const char *title, char *out, size_t size);
/* A line of look->line around the plot rectangle, just outside of its pixels. */
BEAD_API void bead_box_draw(cairo_t *cr, const struct bead_look *look, struct bead_rect plot);

/* How wide a colour bar is beside these, px, not rounded. */
enum bead_bar_of { BEAD_BAR_OF_FIGURE, BEAD_BAR_OF_SHEET, BEAD_BAR_OF_MOVIE };
BEAD_API double bead_colour_bar_width(const struct bead_look *look, enum bead_bar_of place);

struct bead_colours;
/* A vertical colour bar in `bar` with ticks, title and, where values lie above (below) the range, pointed ends. Returns how
 * far right of the bar it reached, px. cr NULL: measures only. */
BEAD_API double bead_colour_bar_draw(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                     const char *si_unit, const char *title, struct bead_rect bar, bool over, bool under);

/* The same lying, low values at the left, ticks below; `title` stands elsewhere. Returns how far below the bar it reached. */
BEAD_API double bead_colour_bar_draw_lying(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                           const char *si_unit, struct bead_rect bar, bool over, bool under);

/* A number with a unit prefix that suits it: "1.640 ms", "35 N"; `digits` significant. */
BEAD_API void bead_quantity(double value, const char *si_unit, int digits, char *out, size_t size);

BEAD_END

#endif
