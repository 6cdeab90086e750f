/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures: one or more views of every chain, with axes, headings and a colour bar; a separate still, or one of its panels.
 *
 *   bead_figure_create -> bead_figure_put, repeated -> bead_figure_start -> needs, feed -> bead_figure_extremes ->
 *   bead_figure_set_range -> bead_figure_finish -> bead_figure_decorate and bead_figure_draw (or bead_figure_vector)
 *
 * The layout is fixed before the first sample, so that images can be summed into their pixels; colours, curves and text are drawn
 * at the end, when their ranges are known. PNG, PDF and SVG come from the same drawing. */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "beadreel/sink.h"
#include "beadreel/view.h"
#include "render/colour/colour_range.h"
#include "render/draw/layout.h"
#include "render/draw/picture.h"
#include "render/encode/page.h"
#include "render/paint/canvas.h"

struct bead_part_settings {
    size_t chain;               /* the only one; SIZE_MAX: all */
    char letter[16];            /* "(a)"; "": none */
    const char *title;          /* shown instead of the chain's name; NULL: none */
    bool no_bar;                /* another part has the bar */
    bool no_across, no_upwards; /* no labels on the horizontal or vertical outer axis: a neighbouring panel has them */
    int terseness;              /* least terseness of its headings, because those of other panels have no room for more */
};

/* One view of one chain. */
struct bead_tile {
    struct bead_cell *cell;
    const struct bead_view_type *type;
    struct bead_view_setup setup;
    struct bead_view *view;
    struct bead_rect plot;
};

/* One chain: a heading and its views, stacked. */
struct bead_cell {
    size_t chain;
    size_t column, row;
    struct bead_tile *panel;      /* [view_count], of the figure's tiles */
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
    bool part;                                /* one of several panels: the still has title and caption */
    struct bead_part_settings set;            /* of a panel; else only `chain` is set */
    struct bead_rect area;                    /* of plots, axes, headings and bar; the whole page unless it is a panel */
    double margin;                            /* px, within the area */
    double time[2], at;                       /* s */
    struct bead_grid grid;                    /* of its samples: the figure's, or that of all panels */
    struct bead_colormap map, map_about_rest; /* the latter where forces can be shown about a static one */
    struct bead_colours colours;
    struct bead_colour_range range;
    double peak; /* the largest magnitude of a sample of the field */
    struct bead_cell *cells;
    struct bead_tile *tiles; /* [tile_count]: all views of the first cell, then those of the next */
    size_t cell_count, tile_count, view_count, columns, rows;
    bool coloured;         /* a view shows colours: there is a bar */
    bool stills;           /* a view shows one moment: beads, profile */
    bool collects;         /* a view shows all times: spacetime, sensors */
    struct bead_rect bar;  /* width 0: none */
    struct bead_rect line; /* of title and time, above everything; height 0: none */
    char why[96];
};

/* The beads, or contacts, of a chain that an output shows. Errors: SCENE (the chain ends before). */
BEAD_CHECK enum bead_error bead_figure_span(const struct bead_output *output, const struct bead_chain *chain,
                                            struct bead_span *span, struct bead_message *msg);
/* True if views of one moment are laid out by their beads: see struct bead_sink_type. */
bool bead_figure_looks_at_beads(const struct bead_output *output);
/* `settings`: of a panel; NULL: the figure has the whole page. Must be destroyed even after an error. Errors: SCENE (with the
 * output's place), MEMORY, IO and FORMAT of colour maps. */
BEAD_CHECK enum bead_error bead_figure_create(const struct bead_output *output, const struct bead_run_context *context,
                                              const struct bead_page *page, const struct bead_look *look,
                                              const struct bead_part_settings *settings, struct bead_figure **figure,
                                              struct bead_message *msg);
/* Lays the figure out in an area, with plots at least `least` away from its borders; *insets returns the distances. Errors: SCENE
 * (too small), MEMORY. */
BEAD_CHECK enum bead_error bead_figure_put(struct bead_figure *figure, struct bead_rect area, const struct bead_insets *least,
                                           struct bead_insets *insets, struct bead_message *msg);
/* Makes it ready for samples. */
BEAD_CHECK enum bead_error bead_figure_start(struct bead_figure *figure, struct bead_message *msg);
void bead_figure_needs(const struct bead_figure *figure, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_figure_feed(struct bead_figure *figure, const struct bead_sample *sample, struct bead_message *msg);
/* Widens the ranges of the colours and of the sensors' axis; both start as BEAD_NOTHING_SHOWN. */
void bead_figure_extremes(const struct bead_figure *figure, struct bead_shown_values *colours, struct bead_shown_values *sensors);
void bead_figure_set_range(struct bead_figure *figure, const struct bead_shown_values *colours,
                           const struct bead_shown_values *sensors);
bool bead_figure_needs_canvas(const struct bead_figure *figure);
BEAD_CHECK enum bead_error bead_figure_finish(struct bead_figure *figure, struct bead_canvas *canvas, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_figure_decorate(struct bead_figure *figure, cairo_t *cr, struct bead_message *msg);
/* `frame` holds the drawing of decorate; so does `background` if a view draws over it. */
BEAD_CHECK enum bead_error bead_figure_draw(struct bead_figure *figure, struct bead_frame *frame,
                                            const struct bead_frame *background, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_figure_vector(struct bead_figure *figure, cairo_t *cr, struct bead_message *msg);
/* Destroys the views, which may draw on a canvas: call it before the canvas is destroyed. */
void bead_figure_release(struct bead_figure *figure);
/* The horizontal or vertical axis of a panel; panels with equal axes share labels. */
struct bead_axis_kind {
    const char *title; /* NULL: cannot be shared */
    double low, high;
};
struct bead_axis_kind bead_figure_axis(const struct bead_figure *figure, bool upright);

void bead_figure_destroy(struct bead_figure *figure);

/* ---- among the files of a figure: figure.c (made and fed), figure_layout.c (places), figure_draw.c (headings, bar),
 * figure_write.c (the end) ---- */

/* True for views that show all times (spacetime, sensors); others show one moment. */
bool bead_tile_collects(const struct bead_tile *panel);
/* Creates and places the views that show all times (at the start), or the others (at the end). */
BEAD_CHECK enum bead_error bead_figure_views(struct bead_figure *figure, bool collecting, struct bead_canvas *canvas,
                                             struct bead_message *msg);
/* Title of the colour bar: the field, and a note if colours show the largest values of pixels instead of means. */
void bead_figure_bar_title(const struct bead_figure *figure, char *title, size_t size);
/* How much headings must be shortened for the longest to fit; cr NULL: measures in the same way. */
int bead_figure_terseness(const struct bead_figure *figure, cairo_t *cr);
/* Draws the heading of a cell, shortened to fit. Returns whether there is one; cr NULL: draws nothing. */
bool bead_figure_heading(const struct bead_figure *figure, const struct bead_cell *cell, cairo_t *cr);
/* Draws title and time above everything. Returns whether there are any; cr NULL: draws nothing. */
bool bead_figure_line(const struct bead_figure *figure, cairo_t *cr);
