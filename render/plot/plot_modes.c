/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energies of the first few modes against time: a panel for each chain. */
#include <math.h>
#include <stdlib.h>

#include "render/plot/plot_private.h"
#include "sim/chain/chain_internal.h"

static enum bead_error plot_modes_create(struct bead_plot_data *data, struct bead_message *msg)
{
    const struct bead_output *output = data->output;
    const double *range = output->plot.range;
    BEAD_TRY(plot_times_create(data, output->curves.modes, "energies of modes", msg));
    for (size_t k = 0; k < output->curves.modes; k++)
        snprintf(data->parts[0].labels[k], sizeof *data->parts[0].labels, "mode %zu", k + 1);
    for (size_t p = 0; p < data->count; p++) {
        const char *title = bead_chain_mode_title(data->context.chains[data->parts[p].chain]);
        data->panels[p].y = (struct bead_graph_axis){title, "", range[0], range[1], output->plot.scale, true};
    }
    return BEAD_OK;
}

static void plot_modes_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    needs->beads = (struct bead_span){0, SIZE_MAX};
    for (size_t p = 0; p < data->count; p++)
        needs->fields |= bead_chain_mode_fields(data->context.chains[data->parts[p].chain]);
}

static enum bead_error plot_modes_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *)
{
    double energy[BEAD_MODES];
    struct plot_panel *part = plot_times_take(data, sample);
    if (part) {
        bead_chain_mode_energies(data->context.chains[part->chain], sample->field, data->output->curves.modes, energy);
        plot_times_add(data, part, energy);
    }
    return BEAD_OK;
}

/* A logarithmic axis extends six powers of ten below the highest value. */
static double lowest(const struct bead_plot_data *data)
{
    double most = 0;
    for (size_t p = 0; p < data->count; p++) {
        for (size_t i = 0; i < bead_grid_count(&data->grid) * data->output->curves.modes; i++)
            most = fmax(most, data->parts[p].values[i]);
    }
    return data->output->plot.scale == BEAD_SCALE_LOG && most > 0 ? 1e-6 * most : NAN;
}

static enum bead_error plot_modes_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *)
{
    const struct bead_output *output = data->output;
    double low = isnan(output->plot.range[0]) ? lowest(data) : output->plot.range[0];
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        part->shown->y.low = low;
        for (size_t k = 0; k < output->curves.modes; k++)
            plot_add(part, plot_line(data->sample, part->values + k * bead_grid_count(&data->grid), part->taken,
                                     p == 0 ? part->labels[k] : NULL, k));
    }
    return BEAD_OK;
}

const struct plot_kind bead_plot_modes = {BEAD_SHOW_MODES, plot_modes_create, plot_modes_needs, plot_modes_feed, plot_modes_finish};
