/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#pragma once

#include "beadreel/sweep.h"
#include "sim/sweep/sweep_curves.h"

/* The plot of a sweep over keys. Errors: USAGE, MEMORY, those of bead_graph_write. */
BEAD_CHECK enum bead_error bead_over_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                const char *path, uint64_t *bytes, struct bead_message *msg);
/* The spread of energy in the chains of a sweep, which are run. Errors: those of bead_sweep_spreads_find and bead_graph_write. */
BEAD_CHECK enum bead_error bead_spreading_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                     const char *path, uint64_t *bytes, struct bead_message *msg);
/* A plane of two quantities. Errors: as above. */
BEAD_CHECK enum bead_error bead_plane_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                 const char *path, uint64_t *bytes, struct bead_message *msg);

/* Curves of the chains of a sweep, which are run. Errors: those of bead_sweep_lines_find and bead_graph_write. */
BEAD_CHECK enum bead_error bead_lines_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                 const char *path, uint64_t *bytes, struct bead_message *msg);

/* The quantity on the axis of values of plots of sweeps over keys. */
struct bead_over_shown {
    struct bead_sweep_values of;            /* of a measure */
    const struct bead_sweep_values *values; /* them; NULL: peak forces */
    const char *unit;
    char title[120];
};
/* Runs the chains for a measure; what->of is to be freed even after an error. Errors: those of bead_sweep_measured. */
BEAD_CHECK enum bead_error bead_over_shown_find(const struct bead_output *output, const struct bead_run_context *context,
                                                struct bead_over_shown *what, struct bead_message *msg);
/* "striker velocity" of chain.striker.velocity; "magnetism" of chain.beads.0.magnetism. */
void bead_over_axis_name(const struct bead_over_key *key, char *text, size_t size);
