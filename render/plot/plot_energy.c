/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of the energy against time, stacked: a panel for each chain. A dotted line above them is the energy put in; lines are
 * parts that fall below 0, and the energies past the beads listed. */

#include "render/plot/plot_private.h"
#include "sim/base/memory.h"
#include "sim/measure/energy_parts.h"

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

/* A part that falls below 0 by less than this part of the energy put in is stacked as the others. */
static const double unseen = 1e-3;

/* Bits of the parts that fall below 0 in some panel, as gravity where beads descend: on a stack such an area would cover the part
 * below it, and end above the energy put in. */
static unsigned parts_below(const struct bead_plot_data *data)
{
    const size_t times = bead_grid_count(&data->grid), stacked = bead_energy_parts_stacked(data->output);
    unsigned below = 0;
    for (size_t p = 0; p < data->count; p++) {
        const double *value = data->parts[p].values, *put_in = value + stacked * times;
        for (size_t i = 0; i < data->parts[p].taken; i++) {
            for (size_t k = 0; k < stacked; k++)
                below |= value[k * times + i] < -unseen * (put_in[i] + put_in[times + i]) ? 1u << k : 0;
        }
    }
    return below;
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

/* Each part lies on the sum of those before it, and is replaced by its own sum; those that fall below 0 are lines. */
static void stack(struct bead_plot_data *data, size_t p, unsigned there, unsigned lines)
{
    struct plot_panel *part = &data->parts[p];
    const size_t times = bead_grid_count(&data->grid), stacked = bead_energy_parts_stacked(data->output);
    const double *below = part->values + data->numbers * times; /* zeros */
    for (size_t k = 0; k < stacked; k++) {
        if (!(there & 1u << k))
            continue;
        if (lines & 1u << k) {
            next_series(data, p, k, BEAD_MARK_LINE);
            continue;
        }
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
    const unsigned there = parts_there(data), lines = parts_below(data);
    for (size_t p = 0; p < data->count; p++)
        stack(data, p, there, lines);
    return BEAD_OK;
}

const struct plot_kind bead_plot_energy = {BEAD_SHOW_ENERGY, plot_energy_create, plot_energy_needs, plot_energy_feed,
                                           plot_energy_finish};
