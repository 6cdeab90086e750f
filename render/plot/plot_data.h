/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Data of plots, gathered from a run and made into panels of graphs: force at sensors against time, energies of modes, or profiles,
 * in a panel for each chain; or peaks of contacts, all chains in one panel. */
#pragma once

#include "beadreel/sink.h"
#include "render/plot/graph.h"

struct bead_plot_data;

/* `output` is borrowed. `chain`: number of the only chain shown; SIZE_MAX: all. Errors: SCENE (with the output's place), MEMORY. */
BEAD_CHECK enum bead_error bead_plot_data_create(const struct bead_output *output, const struct bead_run_context *context,
                                                 size_t chain, struct bead_plot_data **data, struct bead_message *msg);
void bead_plot_data_needs(const struct bead_plot_data *data, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_plot_data_feed(struct bead_plot_data *data, const struct bead_sample *sample,
                                               struct bead_message *msg);
/* After the last sample: makes the panels. Errors: UNSUPPORTED (no outcomes for peaks), MEMORY. */
BEAD_CHECK enum bead_error bead_plot_data_finish(struct bead_plot_data *data, const struct bead_outcome *outcomes,
                                                 struct bead_message *msg);
/* The panels; owned by the data. Before finish they have axes and titles, but no series. */
const struct bead_panel *bead_plot_data_panels(const struct bead_plot_data *data, size_t *count);
/* Would the panels have room on the page of a plot? Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_plot_data_check(const struct bead_plot_data *data, struct bead_message *msg);
/* After finish: writes the panels as a plot. Errors: those of bead_graph_write. */
BEAD_CHECK enum bead_error bead_plot_data_write(const struct bead_plot_data *data, const char *path, uint64_t *bytes,
                                                struct bead_message *msg);
void bead_plot_data_destroy(struct bead_plot_data *data);
