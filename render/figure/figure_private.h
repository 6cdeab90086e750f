/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of a figure share: figure.c (made and fed), figure_layout.c (where things go), figure_draw.c (headings, bar),
 * figure_write.c (the end), figure_still.c (a page of its own). */
#ifndef BEADREEL_RENDER_FIGURE_FIGURE_PRIVATE_H
#define BEADREEL_RENDER_FIGURE_FIGURE_PRIVATE_H

#include <stdbool.h>

#include "beadreel/picture.h"
#include "beadreel/view.h"
#include "render/colour/colour_range.h"
#include "render/draw/page.h"
#include "render/figure/figure.h"
#include "render/view/stack.h"

/* One view of one chain. */
struct bead_tile {
    const struct bead_view_type *type;
    struct bead_view_setup setup;
    struct bead_view *view;
    struct bead_rect plot;
};

/* One chain: a heading and its views, stacked. */
struct bead_cell {
    size_t chain;
    size_t column, row;
    struct bead_tile panel[BEAD_STACK_VIEWS];
    struct bead_rect heading;     /* height 0: none */
    struct bead_rect trust;       /* line of text about the horizon; height 0: none */
    double horizon;               /* s; INFINITY: none */
    struct bead_sample moment[2]; /* samples before and after the time of the still; the cell owns their arrays */
    size_t moments;
};

struct bead_figure {
    const struct bead_output *output;
    struct bead_run_context context;
    struct bead_page page;
    struct bead_look look;
    bool part;                     /* one of several panels: the still has title and caption */
    struct bead_part_settings set; /* of a panel; else only `chain` is set */
    struct bead_rect area;         /* of plots, axes, headings and bar; the whole page unless it is a panel */
    double margin;                 /* px, within the area */
    double time[2], at;            /* s */
    struct bead_grid grid;
    struct bead_colormap map;
    struct bead_colours colours;
    struct bead_colour_range range;
    struct bead_cell *cells;
    size_t cell_count, view_count, columns, rows;
    bool coloured;         /* a view shows colours: there is a bar */
    bool stills;           /* a view shows one moment: beads, profile */
    bool collects;         /* a view shows all times: spacetime, sensors */
    struct bead_rect bar;  /* width 0: none */
    struct bead_rect line; /* of title and time, above all; height 0: none */
    char why[96];
};

/* True for views that show all times (spacetime, sensors); the others show one moment. */
bool bead_tile_collects(const struct bead_tile *panel);
/* Creates and places the views that show all times (at the start), or the others (at the end). */
BEAD_CHECK enum bead_error bead_figure_views(struct bead_figure *figure, bool collecting, struct bead_canvas *canvas,
                                             struct bead_message *msg);
/* Sets the rectangles of plots, headings and bar, and which axes are labelled; plots stay at least `least` away from the area's
 * borders. Errors: SCENE (too small), MEMORY. */
BEAD_CHECK enum bead_error bead_figure_arrange(struct bead_figure *figure, const struct bead_insets *least,
                                               struct bead_message *msg);
/* Title of the colour bar: the field, and whether colours show the largest values of pixels instead of means. */
void bead_figure_bar_title(const struct bead_figure *figure, char *title, size_t size);
/* Draws the heading of a cell, shortened to fit. Returns whether there is one; cr NULL: draws nothing. */
bool bead_figure_heading(const struct bead_figure *figure, const struct bead_cell *cell, cairo_t *cr);
/* Draws title and time above everything. Returns whether there are any; cr NULL: draws nothing. */
bool bead_figure_line(const struct bead_figure *figure, cairo_t *cr);

#endif
