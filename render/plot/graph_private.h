/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common to the files of a graph: graph.c (entry, files), graph_range.c (axes), graph_layout.c (places), graph_words.c (words at
 * rulers), graph_legend.c, graph_outer.c (legends), graph_ends.c (names at lines' ends), graph_draw.c (panels), graph_page.c (title
 * and caption), graph_image.c (colours and their bar), graph_contents.c (inside a plot's frame), graph_curve.c (curves and points).
 * Lengths in px. */
#pragma once

#include "render/draw/layout.h"
#include "render/encode/page.h"
#include "render/plot/graph.h"

struct graph_box {
    double x, y, width, height;
};

/* The covered parts of a panel, in square cells. */
struct graph_mask {
    int width, height;
    double cell, x, y; /* x, y: of the plot's corner */
    unsigned *sums;    /* [(height + 1) * (width + 1)]: covered cells above and to the left */
};

/* One entry of a legend: a curve, or a ruler whose word does not fit beside it. */
struct graph_entry {
    const struct bead_series *series; /* or */
    const struct bead_ruler *ruler;
    const struct graph_cell *cell; /* of the series */
    char *markup;                  /* borrowed */
    double width, height, x, y;    /* x, y: left end of the sample and middle of the row, within the legend */
    bool wraps;                    /* in several lines */
};

struct graph_legend {
    struct graph_entry *entries;
    size_t count, columns;
    double shrunk;        /* size of its type in units of the label's; 0: the label's */
    bool cut;             /* long words are cut, not wrapped */
    double wrap;          /* > 0: of the words; < 0: the width at which they are cut */
    struct graph_box box; /* width 0: not placed */
};

enum graph_word_state { GRAPH_WORD_NONE, GRAPH_WORD_PLACED, GRAPH_WORD_IN_LEGEND };

/* The word of a ruler. */
struct graph_word {
    char *markup;
    char *lettered; /* after the letter of the panel, for places outside it */
    enum graph_word_state state;
    struct graph_box box;
};

struct graph_cell {
    const struct bead_panel *panel;
    size_t row, column;
    double low[2], high[2]; /* of x and y */
    struct bead_axis axis[2];
    bool labelled[2];
    struct bead_rect plot;
    char *head;                  /* markup of letter and title; NULL: none */
    struct graph_word *words;    /* [ruler_count] */
    char **labels;               /* [series_count], markup; NULL: none */
    struct graph_legend legend;  /* the entries that stay inside */
    size_t most_points;          /* of the largest cloud of all panels: clouds have equal points */
    bool undashed;               /* lines are drawn solid, so that words do not use their gaps */
    bool ends;                   /* curves have their names at their ends, and no entries */
    bool legend_outside;         /* the curves' entries; with one panel, also the rulers' */
    bool rulers_outside, raised; /* raised: the y axis ends higher, to have room for the legend */
};

/* A graph as one of several panels. */
struct graph_frame {
    double margin;            /* around everything */
    struct bead_insets least; /* of plots from the borders */
    const char *letter;       /* of the first panel; "": none */
    bool explained;           /* the legend of an earlier panel has all entries of this one's */
    bool no_across;           /* no labels on the horizontal axes: another panel has them */
};

/* Title and caption of a page. */
struct graph_page {
    char *title, *caption;              /* markup; NULL: none */
    double width, height, above, below; /* above, below: room for title and caption */
    double caption_height;
};

struct graph_layout {
    const struct bead_graph *graph;
    struct graph_frame frame;
    const struct bead_look *look;
    double width, height;
    bool part; /* one of several panels: its plots cannot move, so legends stay inside if at all possible */
    size_t columns, rows;
    struct graph_cell *cells; /* [panel_count] */
    struct graph_page page;
    struct graph_legend legend; /* outside all panels */
    bool legend_right;
    struct bead_layout_grid grid; /* its boxes are the plots */
};

BEAD_CHECK enum bead_error graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width,
                                             double height, const struct graph_frame *frame, struct graph_layout *layout,
                                             struct bead_message *msg); /* frame NULL: a whole page */
void graph_layout_free(struct graph_layout *layout);
/* The letter of a panel: "(a)", ... "(z)", "(aa)", ... */
void graph_letter(size_t index, char *text, size_t size);

/* Between the panels and a legend outside them, in units of the label's font size. */
static const double graph_legend_gap = 0.7;
/* Fills the legends. Every entry appears once: in the first panel with it, or in the outer legend. */
void graph_gather_legends(struct graph_layout *layout);
/* Sizes the outer legend: beside the panels on wide pages, else where it leaves more room for plots. */
void graph_measure_outside(struct graph_layout *layout);

/* Ranges of all cells' axes. Errors: SCENE (a range that makes no sense). */
BEAD_CHECK enum bead_error graph_find_ranges(struct graph_layout *layout, struct bead_message *msg);

/* The clear distance around a box of words, px. */
double graph_air(const struct bead_look *look);
BEAD_CHECK enum bead_error graph_mask_make(const struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask,
                                           struct bead_message *msg);
void graph_mask_free(struct graph_mask *mask);
/* The number of covered cells in a box; a box partly outside the plot counts as covered. */
unsigned graph_mask_covered(const struct graph_mask *mask, struct graph_box box);
void graph_mask_cover(struct graph_mask *mask, struct graph_box box);

/* Places the words of the cell's rulers in free room, others in the legend. True: a word has just moved there. */
bool graph_words_place(struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask);

/* Sizes the legend for a width, in this many columns; 0: as many as fit. */
void graph_legend_measure(struct graph_legend *legend, const struct bead_look *look, double width, size_t columns);
/* Sizes it for a width and, if possible, a height: with smaller type and long words cut, if necessary. */
void graph_legend_fit(struct graph_legend *legend, const struct bead_look *look, double width, double height);
/* Places it in free room of a panel. False: no room. */
bool graph_legend_place(struct graph_legend *legend, const struct bead_look *look, struct graph_mask *mask);
/* On an image: draws a piece of the page behind it. */
void graph_legend_back(const struct graph_legend *legend, const struct bead_look *look, cairo_t *cr);
void graph_legend_draw(const struct graph_legend *legend, const struct bead_look *look, cairo_t *cr);

/* Are the names of a panel's curves, and their widths, suitable for the ends of their lines? */
bool graph_ends_wanted(const struct graph_layout *layout, size_t cell);
/* Do the ends of the lines leave room for the names? */
bool graph_ends_fit(const struct graph_cell *cell, const struct bead_look *look);
/* How far such names extend to the right of the plot, px; 0 without any. */
double graph_ends_reach(const struct graph_cell *cell, const struct bead_look *look);
void graph_ends_draw(const struct graph_cell *cell, const struct bead_look *look, cairo_t *cr);
/* Where a line ends within the frame, px. False: nowhere. */
bool graph_series_end(const struct graph_cell *cell, const struct bead_series *series, double end[2]);

/* Drawing. */
struct bead_text_style graph_text(const struct bead_look *look);
/* Series that one entry of a legend explains if their labels are equal. */
bool graph_look_alike(const struct bead_series *a, const struct bead_series *b);
/* The number of points of a series that is a cloud, whose x do not rise; else 0. */
size_t graph_cloud(const struct bead_series *series);
/* Radius of points: the full size, and the size in a panel. */
double graph_full_point(const struct bead_look *look);
double graph_point_size(const struct bead_series *series, const struct graph_cell *cell, const struct bead_look *look);
void graph_draw_point(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, double x, double y, double size);
/* Marks are at every n-th point, from the first. */
struct graph_thinning {
    size_t every, first;
};
struct graph_thinning graph_thin(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series);
/* Guides join marks and are thin and pale; other lines are curves. */
bool graph_is_guide(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series);
void graph_stroke_style(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, bool guide);
struct bead_rgb graph_band_colour(const struct bead_look *look, const struct bead_series *series);
void graph_draw_series(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series);
/* Place 0..1 of a value on the axis that the ruler crosses. */
double graph_ruler_place(const struct graph_cell *cell, const struct bead_ruler *ruler, double value);
/* Dashes for a threshold, at a value of x; dots for a plateau. */
void graph_ruler_style(cairo_t *cr, const struct bead_look *look, const struct bead_ruler *ruler);
/* Draws curves, points and rulers; also used to make the mask of covered cells. */
void graph_draw_contents(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell);
/* Draws bands of rulers, below everything. */
void graph_draw_bands(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell);
/* Draws the cell's image, if it has one; the image's bar. Errors: MEMORY, GRAPHICS, IO (colour map). */
BEAD_CHECK enum bead_error graph_draw_image(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell,
                                            struct bead_message *msg);
BEAD_CHECK enum bead_error graph_draw_bar(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell,
                                          struct bead_message *msg);
/* How far the bar of an image extends to the right of its plot, px. */
double graph_image_reach(const struct bead_look *look, const struct graph_cell *cell);
BEAD_CHECK enum bead_error graph_draw_all(cairo_t *cr, const struct graph_layout *layout, struct bead_message *msg);
/* Sizes title and caption for a page. */
void graph_page_measure(struct graph_page *page, const struct bead_look *look, double width, double height);
/* The title begins above the left end of the `axes`, px; at the margin if it is too long for that. */
void graph_page_draw(const struct graph_page *page, const struct bead_look *look, cairo_t *cr, double axes);
