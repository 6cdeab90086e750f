/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes, colour bars and quantities: the parts of a picture that explain it. */
#pragma once

#include "beadreel/view.h"
#include "sim/base/internal.h"

/* `seen` is called for every text drawn on this surface, with the box of its ink in device units, to find collisions. `watch` is
 * borrowed until the surface is destroyed. False: out of memory. */
struct bead_text_watch {
    void (*seen)(void *context, const char *markup, double x, double y, double width, double height);
    void *context;
};
BEAD_INTERNAL bool bead_text_watch(cairo_surface_t *surface, const struct bead_text_watch *watch);
/* Markup of "M = 0.2" in mathematical italics. */
BEAD_INTERNAL void bead_text_magnetism(double magnetism, char *out, size_t size);

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
    double minor[96]; /* places of shorter ticks without labels between those: on uneven scales, and if there are few labels */
};
/* `em`: the ticks' font size; as many ticks as labels fit, beside each other (`horizontal`) or above each other. With the unit "1"
 * an axis counts, with whole numbers at its ticks; "" is for numbers. A range that makes no sense gets no ticks. */
BEAD_INTERNAL void bead_axis_make(struct bead_axis *axis, double low, double high, const char *si_unit, enum bead_scale scale,
                                  double length, double em, bool horizontal);
/* 0..1 of a value on the axis. */
BEAD_INTERNAL double bead_axis_place(const struct bead_axis *axis, double value);

enum bead_side { BEAD_SIDE_LEFT, BEAD_SIDE_BOTTOM, BEAD_SIDE_RIGHT };
/* Ticks, labels and title ("time (ms)" from title "time"; NULL: none) at a side of the plot rectangle; with `downwards` the low end
 * of a vertical axis is at the top. `labels` false: only ticks, no title. The line itself is not drawn: see bead_box_draw. Returns
 * how far out it reached, px. cr NULL: measures only. */
BEAD_INTERNAL double bead_axis_draw(cairo_t *cr, const struct bead_look *look, const struct bead_axis *axis, struct bead_rect plot,
                                    enum bead_side side, bool downwards, bool labels, const char *title);

/* Markup of "time (ms)" from the title "time". */
BEAD_INTERNAL void bead_axis_title(const struct bead_axis *axis, const char *title, char *out, size_t size);
/* A line of look->line around the plot rectangle, just outside its pixels. */
BEAD_INTERNAL void bead_box_draw(cairo_t *cr, const struct bead_look *look, struct bead_rect plot);

/* Width of a colour bar beside these, px, not rounded. */
enum bead_bar_of { BEAD_BAR_OF_FIGURE, BEAD_BAR_OF_SHEET, BEAD_BAR_OF_MOVIE };
BEAD_INTERNAL double bead_colour_bar_width(const struct bead_look *look, enum bead_bar_of place);

struct bead_colours;
/* A vertical colour bar in `bar` with ticks, title and, if values lie above (below) the range, pointed ends. Returns how far right
 * of the bar it extends, px. cr NULL: measures only. */
BEAD_INTERNAL double bead_colour_bar_draw(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                          const char *si_unit, const char *title, struct bead_rect bar, bool over, bool under);

/* Draws a horizontal bar, low values at the left, ticks below, without a title. Returns how far below the bar it extends. */
BEAD_INTERNAL double bead_colour_bar_draw_lying(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                                const char *si_unit, struct bead_rect bar, bool over, bool under);

/* The colours of values beside a vertical axis, which then replaces a bar; beyond the range, the colours of its ends. The axis is
 * linear or logarithmic. Draws nothing in an empty rectangle. */
BEAD_INTERNAL void bead_colour_axis_draw(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                         const struct bead_axis *axis, struct bead_rect bar);

/* A number with a unit prefix that suits it: "1.640 ms", "35 N"; `digits` significant. */
BEAD_INTERNAL void bead_quantity(double value, const char *si_unit, int digits, char *out, size_t size);
