/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of a graph share: graph.c (entry, files), graph_range.c (axes), graph_layout.c (where things go), graph_words.c
 * (words at rulers), graph_legend.c, graph_outer.c (legends), graph_draw.c (the page), graph_curve.c (curves and points). Lengths
 * in px. */
#ifndef BEADREEL_RENDER_PLOT_GRAPH_PRIVATE_H
#define BEADREEL_RENDER_PLOT_GRAPH_PRIVATE_H

#include "render/draw/page.h"
#include "render/plot/graph.h"

struct graph_box {
    double x, y, width, height;
};

/* Which parts of a panel are covered, in square cells. */
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
};

struct graph_legend {
    struct graph_entry *entries;
    size_t count, columns;
    double shrunk;        /* size of its type in units of the label's; 0: the label's */
    bool cut;             /* words too long are cut, not wrapped */
    double wrap;          /* > 0: of the words; < 0: where they are cut */
    struct graph_box box; /* width 0: not placed */
};

enum graph_word_state { GRAPH_WORD_NONE, GRAPH_WORD_PLACED, GRAPH_WORD_IN_LEGEND };

/* The word of a ruler. */
struct graph_word {
    char *markup;
    char *lettered; /* behind the letter of the panel, for places outside of it */
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
    struct graph_legend legend;  /* what is left inside */
    size_t most_points;          /* of the largest cloud of all panels: clouds have equal points */
    bool undashed;               /* lines are drawn whole: their gaps are no room for words */
    bool legend_outside;         /* the curves' entries; of one panel, the rulers', too */
    bool rulers_outside, raised; /* raised: the y axis ends higher, to have room for the legend */
};

/* A graph that is one of several panels. */
struct graph_frame {
    double margin;            /* around everything */
    struct bead_insets least; /* of plots from the borders */
    const char *letter;       /* of the first panel; "": none */
    bool explained;           /* the legend of an earlier panel says all that this one's would */
    bool no_across;           /* no labels on the horizontal axes: another panel has them */
};

struct graph_layout {
    const struct bead_graph *graph;
    struct graph_frame frame;
    const struct bead_look *look;
    double width, height;
    bool part; /* one of several panels: its plots cannot move, so legends stay inside if at all possible */
    size_t columns, rows;
    struct graph_cell *cells;                         /* [panel_count] */
    char *title, *caption;                            /* markup; NULL: none */
    double title_height, caption_height, head_height; /* head: letter and title of a panel */
    struct graph_legend legend;                       /* outside of all panels */
    bool legend_right;
    double *head;                        /* [rows]: of letters and titles */
    double *left, *right, *top, *bottom; /* how far axes and words reach out of the plots: [columns], [columns], [rows], [rows] */
};

BEAD_CHECK enum bead_error graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width,
                                             double height, const struct graph_frame *frame, struct graph_layout *layout,
                                             struct bead_message *msg); /* frame NULL: a whole page */
void graph_layout_free(struct graph_layout *layout);

/* Between the panels and a legend outside of them, in units of the label's font size. */
static const double graph_legend_gap = 0.7;
/* Heights of title and caption with their gaps. */
double graph_above_panels(const struct graph_layout *layout);
double graph_below_panels(const struct graph_layout *layout);
/* Both sides of all plots together, as axes and words leave them, without the outer legend; before the first arrangement, those of
 * the page. */
void graph_room_of_plots(const struct graph_layout *layout, double *width, double *height);

/* Every entry appears once: in the first panel that has it, or in the outer legend. */
void graph_gather_legends(struct graph_layout *layout);
/* Sizes the outer legend: beside the panels on wide pages, else below them, or wherever more room is left for plots. */
void graph_measure_outside(struct graph_layout *layout);

/* Ranges of all cells' axes. Errors: SCENE (a range that makes no sense). */
BEAD_CHECK enum bead_error graph_find_ranges(struct graph_layout *layout, struct bead_message *msg);

/* The clear distance around a box of words, px. */
double graph_air(const struct bead_look *look);
BEAD_CHECK enum bead_error graph_mask_make(const struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask,
                                           struct bead_message *msg);
void graph_mask_free(struct graph_mask *mask);
/* The number of covered cells in a box; a box that reaches out of the plot counts as covered. */
unsigned graph_mask_covered(const struct graph_mask *mask, struct graph_box box);
/* Cover a box, too. */
void graph_mask_cover(struct graph_mask *mask, struct graph_box box);

/* Places the words of the cell's rulers in free room; a word without room goes into the legend. True: a word has newly gone there.
 */
bool graph_words_place(struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask);

/* Sizes the legend for a width, in this many columns; 0: as many as fit. */
void graph_legend_measure(struct graph_legend *legend, const struct bead_look *look, double width, size_t columns);
/* Sizes it for a width and, if possible, a height: with smaller type and long words cut, if need be. */
void graph_legend_fit(struct graph_legend *legend, const struct bead_look *look, double width, double height);
/* Places it in free room of a panel. False: there is none. */
bool graph_legend_place(struct graph_legend *legend, const struct bead_look *look, struct graph_mask *mask);
void graph_legend_draw(const struct graph_legend *legend, const struct bead_look *look, cairo_t *cr);

/* Drawing. */
void graph_set_colour(cairo_t *cr, struct bead_rgb colour);
struct bead_rgb graph_mix(struct bead_rgb a, struct bead_rgb b, double part);
/* Where a title begins: above the left end of the `axes`; one too long for that at `left`. */
double graph_title_x(const struct bead_text_style *style, const char *markup, double axes, double left, double right);
double graph_title_size(const struct bead_look *look);
struct bead_text_style graph_text(const struct bead_look *look);
/* Curves that one entry of a legend explains, if they have the same label. */
bool graph_look_alike(const struct bead_series *a, const struct bead_series *b);
/* Points of a series that is a cloud, not one value for each x; 0: it is none. */
size_t graph_cloud(const struct bead_series *series);
/* Radius of points: the full size, and the size in a panel. */
double graph_full_point(const struct bead_look *look);
double graph_point_size(const struct bead_series *series, const struct graph_cell *cell, const struct bead_look *look);
void graph_draw_point(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, double x, double y, double size);
/* Of every how many points one has its mark, and which is the first. */
struct graph_thinning {
    size_t every, first;
};
struct graph_thinning graph_thin(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series);
/* A guide joins marks and is thin and pale; other lines are curves. */
void graph_stroke_style(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, bool guide);
struct bead_rgb graph_band_colour(const struct bead_look *look, const struct bead_series *series);
void graph_draw_series(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series);
/* Dashes for a threshold, at a value of x; dots for a plateau. */
void graph_ruler_style(cairo_t *cr, const struct bead_look *look, const struct bead_ruler *ruler);
/* Draws curves, points and rulers; the mask of covered cells is made with it as well. */
void graph_draw_contents(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell);
void graph_draw_all(cairo_t *cr, const struct graph_layout *layout);

#endif
