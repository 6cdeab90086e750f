/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#pragma once

#include "beadreel/sweep.h"
#include "render/plot/plot_private.h"
#include "sim/sweep/sweep_curves.h"

/* Each makes the panels of a plot: over keys; of curves, or of the spread of energy, of chains, which it runs; of a plane of two
 * quantities. Errors: USAGE, SCENE, MEMORY, those of bead_sweep_lines_find. */
typedef enum bead_error sweep_plot(struct bead_plot_data *data, struct bead_message *msg);
sweep_plot bead_over_plot_fill, bead_lines_plot_fill, bead_plane_plot_fill;
/* Makes the panels of the spread of energy. Errors: MEMORY. */
struct bead_sweep_lines;
BEAD_CHECK enum bead_error bead_spreading_plot_fill(struct bead_plot_data *data, const struct bead_sweep_lines *lines,
                                                    struct bead_message *msg);

/* Allocates a panel for each place where forces are measured, titled with its name if there are several; one for a measure. */
BEAD_CHECK enum bead_error sweep_plot_reserve_places(struct bead_plot_data *data, struct bead_message *msg);
/* Fills panel `p` with results over keys, whose values have that unit and the title data->axis_title. */
typedef enum bead_error sweep_plot_keys(struct bead_plot_data *data, size_t p, const struct bead_sweep_curves *found,
                                        const char *unit, struct bead_message *msg);
/* Makes all panels with `fill`; for a measure, runs the chains. Errors: USAGE, MEMORY, those of `fill` and of runs. */
BEAD_CHECK enum bead_error sweep_plot_fill_keys(struct bead_plot_data *data, sweep_plot_keys *fill, struct bead_message *msg);
/* "striker velocity" for chain.striker.velocity; "magnetism" for chain.beads.0.magnetism: a text of the panel. */
const char *sweep_plot_key_name(struct plot_panel *part, const struct bead_over *over, size_t key);

/* Values known at points of a plane, as an image: each point has the box that ends half-way to its neighbours. */
struct bead_plane_point {
    double x, y, value;
};

/* Sorts the points. Columns are the points of equal x, each with its own values of y. Half-way is measured along the axes, whose
 * scales are linear or logarithmic; `ends` [x and y][2] are those of the boxes. image->values are to be freed; its title and unit
 * are the caller's. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_plane_make(struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                           struct bead_graph_image *image, double ends[2][2], struct bead_message *msg);

/* Adds a curve of a statistic that looks like `series`, a mean with its bars, or the band between the quartiles. */
enum sweep_plot_statistic { SWEEP_PLOT_MEAN, SWEEP_PLOT_MEDIAN, SWEEP_PLOT_QUARTILES };
enum { SWEEP_PLOT_COLUMNS = 3 /* numbers of a point */ };
void sweep_plot_add(struct plot_panel *part, struct bead_series series, const struct bead_sweep_curve *curve,
                    enum sweep_plot_statistic what);
/* The most values that one of its points has. */
size_t sweep_plot_most_alike(const struct bead_sweep_curve *curve);
