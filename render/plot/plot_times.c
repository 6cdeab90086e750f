/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a chain against time, a panel for each chain: plots of modes and energies, and what that of spreading shares. Times
 * are in data->sample, numbers in the parts' values, [numbers][times]. */
#include <math.h>

#include "render/plot/plot_private.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/energy_parts.h"
#include "sim/measure/sink_grid.h"

/* Times of a curve unless the scene gives an interval, or a trajectory has its own; more would not be visible. */
static const double most_times = 4000;

enum bead_error plot_times_create(struct bead_plot_data *data, size_t numbers, const char *what, struct bead_message *msg)
{
    struct bead_grid *grid = &data->grid;
    BEAD_TRY(bead_sink_grid(data->output, &data->context, grid, msg));
    if (!grid->widens && !(data->output->shown.every > 0 || data->context.native.every > 0))
        grid->every = fmax(data->context.resolution, (grid->end - grid->start) / most_times);
    const size_t times = bead_grid_count(&data->grid);
    if (times < 2 || times > (size_t)1 << 22)
        return bead_output_wrong(data->output, msg, "every: %g gives %zu times; a plot shows from 2 to 4194304", data->grid.every,
                                 times);
    data->numbers = numbers;
    BEAD_TRY(plot_reserve_chains(data, 3 * numbers, (times + 4) * (numbers + 2), msg));
    for (size_t p = 0; p < data->count; p++) {
        const char *unit = bead_chain_time_unit(data->context.chains[data->parts[p].chain]);
        data->panels[p].x = (struct bead_graph_axis){"time", unit, data->grid.start, data->grid.end, BEAD_SCALE_LINEAR, false};
    }
    snprintf(data->why, sizeof data->why, "%s at %zu times", what, times);
    return plot_new(&data->store, &data->sample, times, msg);
}

struct plot_panel *plot_times_take(struct bead_plot_data *data, const struct bead_sample *sample)
{
    const double slack = 1e-6 * data->grid.every;
    for (size_t p = 0; p < data->count; p++) {
        struct plot_panel *part = &data->parts[p];
        if (part->chain != sample->chain || sample->time < bead_grid_time(&data->grid, part->taken) - slack)
            continue;
        if (part->taken >= bead_grid_count(&data->grid))
            return NULL;
        data->sample[part->taken] = sample->time;
        return part;
    }
    return NULL;
}

void plot_times_add(const struct bead_plot_data *data, struct plot_panel *part, const double *numbers)
{
    for (size_t k = 0; k < data->numbers; k++)
        part->values[k * bead_grid_count(&data->grid) + part->taken] = numbers[k];
    part->taken++;
}

/* The energies of the first few modes against time: a panel for each chain. */

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

/* The parts of the energy against time, stacked: a panel for each chain. A dotted line above them is the energy put in; lines are
 * the energies past the beads listed. */

static enum bead_error plot_energy_create(struct bead_plot_data *data, struct bead_message *msg)
{
    const double *range = data->output->plot.range;
    BEAD_TRY(plot_times_create(data, bead_energy_parts_count(data->output), "the energy budget", msg));
    for (size_t p = 0; p < data->count; p++)
        data->panels[p].y = (struct bead_graph_axis){"energy", "J", range[0], range[1], BEAD_SCALE_LINEAR, true};
    return plot_new(&data->store, &data->fronts, data->context.chain_count, msg);
}

static void plot_energy_needs(const struct bead_plot_data *, struct bead_needs *needs)
{
    needs->fields = BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY);
    needs->budget = true;
}

static enum bead_error plot_energy_feed(struct bead_plot_data *data, const struct bead_sample *sample, struct bead_message *msg)
{
    BEAD_FREED double *parts = NULL;
    struct plot_panel *part = plot_times_take(data, sample);
    if (!part)
        return BEAD_OK;
    BEAD_TRY(bead_new(&parts, data->numbers, msg, "a plot"));
    bead_energy_parts_find(data->output, data->context.chains[part->chain], sample, &data->fronts[part->chain], parts);
    plot_times_add(data, part, parts);
    return BEAD_OK;
}

/* Bits of the parts that are not 0 in some panel. */
static unsigned parts_there(const struct bead_plot_data *data)
{
    const size_t times = bead_grid_count(&data->grid);
    unsigned there = 0;
    for (size_t k = 0; k < bead_energy_parts_stacked(data->output); k++) {
        for (size_t p = 0; p < data->count; p++) {
            for (size_t i = 0; i < data->parts[p].taken; i++)
                there |= data->parts[p].values[k * times + i] != 0 ? 1u << k : 0;
        }
    }
    return there;
}

static struct bead_series *next_series(struct bead_plot_data *data, size_t p, size_t k, enum bead_mark mark)
{
    struct plot_panel *part = &data->parts[p];
    const size_t number = part->shown->series_count;
    bead_energy_part_name(data->output, k, part->labels[number]);
    struct bead_series *series = plot_add(part, (struct bead_series){.x = data->sample,
                                                                     .y = part->values + k * bead_grid_count(&data->grid),
                                                                     .count = part->taken,
                                                                     .mark = mark,
                                                                     .label = p == 0 ? part->labels[number] : NULL});
    plot_tell_apart(series, number);
    return series;
}

/* Each part lies on the sum of those before it, and is replaced by its own sum. */
static void stack(struct bead_plot_data *data, size_t p, unsigned there)
{
    struct plot_panel *part = &data->parts[p];
    const size_t times = bead_grid_count(&data->grid), stacked = bead_energy_parts_stacked(data->output);
    const double *below = part->values + data->numbers * times; /* zeros */
    for (size_t k = 0; k < stacked; k++) {
        if (!(there & 1u << k))
            continue;
        struct bead_series *series = next_series(data, p, k, BEAD_MARK_BAND);
        double *own = part->values + k * times;
        for (size_t i = 0; i < part->taken; i++)
            own[i] += below[i];
        series->upper = own;
        series->y = below;
        series->dash = 0;
        below = own;
    }
    double *work = part->values + stacked * times;
    for (size_t i = 0; i < part->taken; i++)
        work[i] += work[times + i];
    struct bead_series *put_in = next_series(data, p, stacked, BEAD_MARK_LINE);
    snprintf(part->labels[data->panels[p].series_count - 1], sizeof *part->labels, "put in");
    put_in->dash = BEAD_DASH_DOTTED;
    for (size_t k = stacked + 2; k < data->numbers; k++)
        next_series(data, p, k, BEAD_MARK_LINE);
}

static enum bead_error plot_energy_finish(struct bead_plot_data *data, const struct bead_outcome *, struct bead_message *)
{
    const unsigned there = parts_there(data);
    for (size_t p = 0; p < data->count; p++)
        stack(data, p, there);
    return BEAD_OK;
}

const struct plot_kind bead_plot_energy = {BEAD_SHOW_ENERGY, plot_energy_create, plot_energy_needs, plot_energy_feed,
                                           plot_energy_finish};
