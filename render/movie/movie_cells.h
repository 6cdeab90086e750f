/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a movie's frame: their number side by side, and the places of their views. Used by movie_layout.c. */
#pragma once

#include <math.h>

#include "render/draw/layout.h"
#include "render/movie/movie_layout.h"

/* Each level leaves out more than the one before, until the rest fits. */
enum { BEAD_LEVELS = 10 };
struct bead_level {
    double share;                                              /* of the frame's area, for the images of up to four chains */
    bool roomy;                                                /* labels may have separate lines */
    bool images, values, headings, titles, facts, axes, words; /* shown: titles, also of the film; values of vertical axes; clock */
    double views, rows;                                        /* gaps between them, in units of the ticks' font size */
    double heading;                                            /* line of a heading, in units of its font size */
    double least[3]; /* heights that beads, images and other views need, in the same units */
    double least_px; /* and the least of all except images */
};
extern const struct bead_level bead_levels[BEAD_LEVELS];

struct bead_cells {
    const struct bead_movie_wants *wants;
    const struct bead_level *level;
    enum bead_layout layout; /* never AUTO */
    size_t columns, rows;
    bool axes, headings;
    bool label_lines;
    struct bead_rect area;         /* px: of all cells with their axes */
    struct bead_layout_grid *grid; /* with room for all: a box for each view of each chain */

    int beyond[2]; /* px: of panels beyond their plots, set by bead_cells_place */
};

/* Whole pixels. */
static inline int bead_cells_whole(double x)
{
    return (int)ceil(x);
}
/* Chooses rectangles for headings and plots. False: there is no room. */
BEAD_CHECK bool bead_cells_place(struct bead_cells *cells, struct bead_movie_layout *layout);
/* The view that an overlay shows for all chains; view_count: none. */
size_t bead_cells_overlay(const struct bead_cells *cells);
/* The number of a chain's images that have a share of the frame, if there are few chains. */
size_t bead_cells_promised(const struct bead_cells *cells);
