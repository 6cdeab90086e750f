/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energies of the first few modes against time: a panel for each chain. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "render/plot/plot_private.h"
#include "sim/chain/chain_internal.h"

/* Times of a curve unless the scene gives an interval; more would not be visible. */
static const double most_times = 4000;

/* The requested interval, or as many times as are visible; replayed samples keep their times. */
static struct bead_grid plot_modes_choose_grid(const struct bead_output *output, const struct bead_run_context *context)
{
    const struct bead_grid *native = &context->native;
    double from = isnan(output->shown.time[0]) ? 0 : output->shown.time[0];
    double to = isnan(output->shown.time[1]) ? context->end : fmin(output->shown.time[1], context->end);
    if (native->every > 0) {
        double first = fmax(0, ceil((from - native->start) / native->every - 1e-6));
        double stride = output->shown.every > 0 ? fmax(1, round(output->shown.every / native->every)) : 1;
        return (struct bead_grid){native->start + first * native->every, stride * native->every, fmin(to, native->end)};
    }
    double every = output->shown.every > 0 ? output->shown.every : fmax(context->resolution, (to - from) / most_times);
    return (struct bead_grid){from, every, to};
}

static void plot_modes_make_axes(struct bead_plot_data *data, double low)
{
    const struct bead_output *output = data->output;
    for (size_t p = 0; p < data->count; p++) {
        const struct bead_chain *chain = data->context.chains[data->parts[p].chain];
        data->panels[p].x = (struct bead_graph_axis){"time",         bead_chain_time_unit(chain), data->grid.start,
                                                     data->grid.end, BEAD_SCALE_LINEAR,           false};
        data->panels[p].y =
            (struct bead_graph_axis){bead_chain_mode_title(chain), "", low, output->plot.range[1], output->plot.scale, true};
    }
}

/* Stores times in data->sample and a chain's energies in its part's values, [modes][times]. */
static enum bead_error plot_modes_create(struct bead_plot_data *data, struct bead_message *msg)
{
    const struct bead_output *output = data->output;
    data->grid = plot_modes_choose_grid(output, &data->context);
    size_t times = bead_grid_count(&data->grid);
    if (times < 2 || times > (size_t)1 << 22)
        return bead_output_wrong(output, msg, "every: %g gives %zu times; a plot shows from 2 to 4194304", data->grid.every, times);
    BEAD_TRY(plot_reserve_chains(data, output->curves.modes, times * output->curves.modes, msg));
    data->sample = calloc(times, sizeof *data->sample);
    for (size_t k = 0; k < output->curves.modes; k++)
        snprintf(data->parts[0].labels[k], sizeof *data->parts[0].labels, "mode %zu", k + 1);
    plot_modes_make_axes(data, output->plot.range[0]);
    snprintf(data->why, sizeof data->why, "energies of %zu modes at %zu times", output->curves.modes, times);
    return data->sample ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for %zu times of modes", times);
}

static void plot_modes_needs(const struct bead_plot_data *data, struct bead_needs *needs)
{
    *needs = (struct bead_needs){.beads = {0, SIZE_MAX}, .grid = data->grid, .until = data->grid.end, .why = data->why};
    for (size_t p = 0; p < data->count; p++)
        needs->fields |= bead_chain_mode_fields(data->context.chains[data->parts[p].chain]);
}

/* Samples may come more often than requested, for other panels of the figure. */
static enum bead_error plot_modes_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *)
{
    double energy[BEAD_MODES];
    const size_t modes = data->output->curves.modes, times = bead_grid_count(&data->grid);
    const double slack = 1e-6 * data->grid.every;
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        if (part->chain != sample->chain || sample->time < data->grid.start + (double)part->taken * data->grid.every - slack)
            continue;
        if (part->taken >= times)
            return BEAD_OK;
        bead_chain_mode_energies(data->context.chains[part->chain], sample->field, modes, energy);
        for (size_t k = 0; k < modes; k++)
            part->values[k * times + part->taken] = energy[k];
        data->sample[part->taken++] = sample->time;
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
        for (size_t k = 0; k < output->curves.modes; k++) {
            part->series[k] = (struct bead_series){.x = data->sample,
                                                   .y = part->values + k * bead_grid_count(&data->grid),
                                                   .count = part->taken,
                                                   .mark = BEAD_MARK_LINE,
                                                   .label = p == 0 ? part->labels[k] : NULL};
            plot_tell_apart(&part->series[k], k);
        }
    }
    plot_modes_make_axes(data, low);
    return BEAD_OK;
}

const struct plot_kind bead_plot_modes = {BEAD_SHOW_MODES,  true, plot_modes_create, plot_modes_needs, plot_modes_feed,
                                          plot_modes_finish};
