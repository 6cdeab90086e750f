/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stack of plots: rows of chains, in each a heading and the chain's views, one below the other. Heights only; stills and movies
 * both lay out their views with it.
 *
 *   fill in the first part -> bead_stack_fixed -> bead_stack_divide -> bead_stack_row for each row, from the top */
#ifndef BEADREEL_RENDER_VIEW_STACK_H
#define BEADREEL_RENDER_VIEW_STACK_H

#include <stddef.h>

enum { BEAD_STACK_VIEWS = 8 };

/* How far axes and their labels reach out of a plot, px. */
struct bead_stack_reach {
    double above, below;
};

struct bead_stack {
    size_t rows, views;
    double heading, between_rows, between_views; /* px */
    const struct bead_stack_reach *reach;        /* [rows * views], borrowed */
    double share[BEAD_STACK_VIEWS];              /* of the height of all plots of a row */
    double most[BEAD_STACK_VIEWS];               /* px that a view can use; INFINITY: any height */
    double least[BEAD_STACK_VIEWS];              /* px that it must have, not above `most`; 0: nothing is promised to it */

    int height[BEAD_STACK_VIEWS]; /* px, of the plots of each view, by bead_stack_divide */
};

/* Where the things of a row begin, px. */
struct bead_stack_places {
    int heading, plot[BEAD_STACK_VIEWS];
};

/* px of all rows that are not plots. */
double bead_stack_fixed(const struct bead_stack *stack);
/* Divides `room`, px for the plots of one row, by the shares. A view with a promise gets that first; what a view cannot use goes to
 * the others. Returns what is used: more than `room` where it does not hold what is promised. */
int bead_stack_divide(struct bead_stack *stack, double room);
/* The row whose heading begins at `y`. Returns the y below its last axis. */
double bead_stack_row(const struct bead_stack *stack, size_t row, double y, struct bead_stack_places *places);

#endif
