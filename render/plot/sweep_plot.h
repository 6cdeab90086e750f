/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#pragma once

#include "beadreel/sweep.h"
#include "render/plot/plot_private.h"
#include "sim/sweep/sweep_curves.h"

/* A plot being made. */
struct sweep_page {
    const struct bead_output *output;
    const struct bead_run_context *context;
    const char *path;
    uint64_t *bytes;
    struct plot_store store;
    struct bead_panel *panels;
    size_t count;
    bool apart; /* each panel has its own axes */
};

/* Allocates panels. Errors: MEMORY. */
BEAD_CHECK enum bead_error sweep_page_reserve(struct sweep_page *page, size_t panels, struct bead_message *msg);
/* Would they have room? Errors: those of bead_graph_check. */
BEAD_CHECK enum bead_error sweep_page_check(const struct sweep_page *page, struct bead_message *msg);
/* Writes them. Errors: those of bead_graph_write. */
BEAD_CHECK enum bead_error sweep_page_write(const struct sweep_page *page, struct bead_message *msg);

/* Each fills and writes a page: a plot over keys; the spread of energy, or curves, of chains, which it runs; a plane of two
 * quantities. Errors: USAGE, MEMORY, those of bead_sweep_lines_find and bead_graph_write. */
typedef enum bead_error sweep_plot(struct sweep_page *page, struct bead_message *msg);
sweep_plot bead_over_plot_write, bead_spreading_plot_write, bead_lines_plot_write, bead_plane_plot_write;

/* The quantity on the axis of values of plots of sweeps over keys. */
struct bead_over_shown {
    struct bead_sweep_values of;            /* of a measure */
    const struct bead_sweep_values *values; /* the values; NULL: peak forces */
    const char *unit;
    char title[120];
};
/* Runs the chains for a measure; what->of is to be freed even after an error. Errors: those of bead_sweep_measured. */
BEAD_CHECK enum bead_error bead_over_shown_find(const struct bead_output *output, const struct bead_run_context *context,
                                                struct bead_over_shown *what, struct bead_message *msg);
/* "striker velocity" for chain.striker.velocity; "magnetism" for chain.beads.0.magnetism. */
void bead_over_axis_name(const struct bead_over *over, size_t key, char *text, size_t size);
