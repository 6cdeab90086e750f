/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a movie's frame: how many stand side by side, and what their views get. movie_layout.c asks for it. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_CELLS_H
#define BEADREEL_RENDER_MOVIE_MOVIE_CELLS_H

#include "render/movie/movie_layout.h"

/* What is left out, in this order, until the rest fits. */
enum bead_level {
    BEAD_LEVEL_EVERYTHING,
    BEAD_LEVEL_NO_FACTS,
    BEAD_LEVEL_FEW_LABELS, /* no title, no titles of vertical axes, small gaps */
    BEAD_LEVEL_TIGHT,      /* ticks without labels at vertical axes */
    BEAD_LEVEL_NO_HEADINGS,
    BEAD_LEVEL_NO_AXES,
    BEAD_LEVEL_VIEWS_ONLY,
    BEAD_LEVELS
};

struct bead_cells {
    const struct bead_movie_wants *wants;
    enum bead_level level;
    enum bead_layout layout; /* never AUTO */
    size_t columns, rows;
    bool axes, headings, share; /* share: images must have theirs */
    bool label_lines;
    struct bead_rect area; /* px: of all cells with their axes */

    /* By bead_cells_place. */
    int width[2], beyond[2]; /* px: of plots, by halves of a cell; of panels beyond them */
};

/* Chooses rectangles for headings and plots; `reach` has room for all plots of the frame. False: there is no room. */
BEAD_CHECK bool bead_cells_place(struct bead_cells *cells, struct bead_stack_reach *reach, struct bead_movie_layout *layout);
/* The view that an overlay shows for all chains; view_count: none. */
size_t bead_cells_overlay(const struct bead_cells *cells);

static inline bool bead_level_titles(enum bead_level level)
{
    return level < BEAD_LEVEL_FEW_LABELS;
}

#endif
