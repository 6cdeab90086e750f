/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes in a grid: one layout for figures, panels, graphs with their legends, and frames of films.
 *
 *   bead_layout_make -> wants of the lanes, lanes of the boxes -> bead_layout_settle, or bead_layout_divide -> boxes[i].at
 *
 * Lanes are the rows and columns of a grid. Their wants are met in this order: gaps and labels; `least`; `most`; shares; springs.
 * (Tracks of a CSS grid are sized like this, and a spring is TeX's glue.) Sizes are whole pixels, rounded down, so that lanes with
 * equal wants stay equal; room for labels is rounded up. If even the least does not fit, the caller gives something up and asks
 * again. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/render.h"

/* Distances from the borders of a box: left, top, right, bottom, px. */
struct bead_insets {
    double left, top, right, bottom;
};

/* A row or a column. */
struct bead_lane {
    size_t line;     /* if each row has its own columns: the number of its line of lanes */
    double gap;      /* px before it */
    double keep[2];  /* px at least before and after it, for labels that extend out of its boxes */
    double least;    /* px; its size unless it has a share */
    double share;    /* of the remaining length, in proportion to the shares of the other lanes */
    double most;     /* px, the rest is for the others; 0: any size */
    double spring;   /* share of the length that no lane can use, which becomes a gap before it */
    double reach[2]; /* px before and after it for labels: `keep`, or more if its boxes need it */
    double at, size; /* px: results */
};

/* All rows, or all columns. */
struct bead_lanes {
    struct bead_lane *lane;
    size_t count;
    double from, length; /* px */
    double spring;       /* after the last lane */
};

struct bead_layout_box {
    size_t column, row;       /* the first, from 0 */
    size_t columns, rows;     /* how many; 0: one */
    struct bead_insets reach; /* px that its labels extend out of it */
    struct bead_rect at;      /* result */
};

struct bead_layout_grid {
    struct bead_lanes columns, rows;
    struct bead_layout_box *boxes;
    size_t count;
};

/* All wants are zero. The caller fills them in and frees the grid. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_layout_make(size_t columns, size_t rows, size_t boxes, struct bead_layout_grid *grid,
                                            struct bead_message *msg);
void bead_layout_free(struct bead_layout_grid *grid);

/* Gives `count` lanes equal wants, with gaps only between them. */
void bead_lanes_want(struct bead_lane *lanes, size_t count, struct bead_lane want);
void bead_lanes_within(struct bead_lanes *lanes, double from, double length);
/* px that cannot be shared: gaps, room for labels, lanes without a share. */
double bead_lanes_fixed(const struct bead_lanes *lanes);
double bead_lanes_least(const struct bead_lanes *lanes);
/* Finds sizes and places along one direction, for the current `reach`. False: the lanes do not get their least sizes. */
bool bead_lanes_divide(struct bead_lanes *lanes);
/* Finds the room for labels that the boxes ask for; with `grow` at least the current room. */
void bead_layout_reach(struct bead_layout_grid *grid, bool grow);
/* The caller's functions for its boxes. */
struct bead_layout_owner {
    void *user;
    void (*heights)(void *user); /* updates wants of rows that depend on the width of columns; NULL: none does */
    enum bead_error (*measure)(void *user, struct bead_message *msg); /* sets `reach` of the boxes for their current sizes */
    enum bead_error (*no_room)(void *user, struct bead_message *msg); /* the error if they do not fit */
};

/* Sizes both directions and places the boxes; owner NULL: none. False: they do not fit. */
BEAD_CHECK bool bead_layout_divide(struct bead_layout_grid *grid, const struct bead_layout_owner *owner);
/* Distances from the borders of an area to the nearest boxes. */
struct bead_insets bead_layout_insets(const struct bead_layout_grid *grid, struct bead_rect area);
/* Divides, then measures and divides `passes` times. `grow`: after that the room for labels only grows, until all have theirs; else
 * the last measurement counts. */
BEAD_CHECK enum bead_error bead_layout_settle(struct bead_layout_grid *grid, int passes, bool grow,
                                              const struct bead_layout_owner *owner, struct bead_message *msg);

/* An area for equal cells in rows and columns. */
struct bead_layout_area {
    double width, height; /* px, of all cells */
    double around[2];     /* px of a cell's width and height that are not its plot */
    double shape;         /* wanted width of a plot, in heights */
    double empty;         /* cost if all cells were empty; 1: as much as a shape 2.7 times too wide or too high */
};

/* The cost of a shape other than the wanted one. */
double bead_layout_misfit(double width, double height, double shape);
/* The number of columns that gives `count` cells the best shape. */
size_t bead_layout_columns(size_t count, const struct bead_layout_area *area);
