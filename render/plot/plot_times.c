/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a chain against time, a panel for each chain: shared by plots of modes, energies and spreading. Times are in
 * data->sample, numbers in the parts' values, [numbers][times]. */
#include <math.h>

#include "render/plot/plot_private.h"
#include "sim/base/memory.h"
#include "sim/kinds/output_kinds.h"
#include "sim/measure/sink_grid.h"

/* Times of a curve unless the scene gives an interval, or a trajectory has its own: fewer would have corners, more not be visible.
 */
static const double least_times = 500, most_times = 4000;

enum bead_error plot_times_create(struct bead_plot_data *data, size_t numbers, const char *what, struct bead_message *msg)
{
    struct bead_grid *grid = &data->grid;
    BEAD_TRY(bead_sink_grid(data->output, &data->context, grid, msg));
    if (!grid->widens && !(data->output->shown.every > 0 || data->context.native.every > 0)) {
        const double span = grid->end - grid->start,
                     every = fmax(fmin(data->context.resolution, span / least_times), span / most_times);
        grid->every = span / fmax(1, ceil(span / every * (1 - 1e-9))); /* curves end at the frame */
    }
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
