/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#pragma once

#include "beadreel/sweep.h"

/* The plot of a sweep over keys. Errors: USAGE, MEMORY, those of bead_graph_write. */
BEAD_CHECK enum bead_error bead_over_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                const char *path, uint64_t *bytes, struct bead_message *msg);
/* The spread of energy in the chains of a sweep, which are run. Errors: those of bead_sweep_spreads_find and bead_graph_write. */
BEAD_CHECK enum bead_error bead_spreading_plot_write(const struct bead_output *output, const struct bead_run_context *context,
                                                     const char *path, uint64_t *bytes, struct bead_message *msg);
