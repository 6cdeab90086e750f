/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sample times and spans of outputs, shared by all sinks. */
#include "sim/measure/sink_grid.h"

#include <math.h>
#include <stdlib.h>

#include "sim/kinds/output_kinds.h"

double bead_round_down(double x)
{
    int exponent = (int)floor(log10(x));
    double unit = pow(10, abs(exponent)), mantissa = exponent < 0 ? x * unit : x / unit;
    double round = mantissa >= 10 ? 10 : mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : mantissa >= 1 ? 1 : 0.5;
    return exponent < 0 ? round / unit : round * unit;
}

/* More samples than this are a mistake, whatever the disk. */
static const double most_samples = 1e10;

bool bead_grid_is_too_fine(const struct bead_grid *grid)
{
    return !((grid->end - grid->start) / grid->every < most_samples);
}

/* Move a grid onto the times of `native`. */
static void snap(const struct bead_grid *native, double every, struct bead_grid *grid)
{
    double multiple = every > 0 ? fmax(1, round(every / native->every)) : 1;
    double first = fmax(0, ceil((grid->start - native->start) / native->every - 1e-6));
    grid->start = native->start + first * native->every;
    grid->every = multiple * native->every;
    grid->end = fmin(grid->end, native->end);
    if (grid->widens) /* its end is a sample */
        grid->end = grid->start + fmax(0, floor((grid->end - grid->start) / grid->every + 1e-6)) * grid->every;
}

enum bead_error bead_sink_grid(const struct bead_output *output, const struct bead_run_context *context, struct bead_grid *grid,
                               struct bead_message *msg)
{
    double resolution = context->resolution > 0 && isfinite(context->resolution) ? context->resolution : 1e-6;
    grid->start = isnan(output->shown.time[0]) ? 0 : output->shown.time[0];
    grid->end = isnan(output->shown.time[1]) ? context->end : fmin(output->shown.time[1], context->end);
    grid->every = output->shown.every > 0 ? output->shown.every : bead_round_down(resolution);
    grid->widens = !(output->shown.every > 0) && bead_output_show(output) && bead_output_show(output)->of_powers;
    if (!(grid->start >= 0) || !(grid->end >= grid->start))
        return bead_output_wrong(output, msg, "time: starts at %g, but the run ends at %g", grid->start, grid->end);
    const struct bead_grid asked = *grid;
    if (context->native.every > 0)
        snap(&context->native, output->shown.every, grid);
    if (bead_grid_is_too_fine(grid))
        return bead_output_wrong(output, msg, "every: %g gives %.3g samples; at most %g are allowed", grid->every,
                                 (grid->end - grid->start) / grid->every, most_samples);
    if (bead_grid_count(grid) == 0)
        return bead_output_wrong(output, msg, "time: there are no samples from %g to %g", asked.start, asked.end);
    return BEAD_OK;
}

size_t bead_span_rows(const struct bead_span *span, size_t count)
{
    if (span->first >= count || span->last < span->first)
        return 0;
    return (span->last < count ? span->last : count - 1) - span->first + 1;
}

void bead_time_text(double time, const char *unit, char *text, size_t size)
{
    static const struct {
        double size;
        const char *unit;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
    size_t i = 0;
    if (!*unit) {
        snprintf(text, size, "%.4g", time);
        return;
    }
    while (i < 3 && time > 0 && time < 0.9999999 * units[i].size)
        i++;
    snprintf(text, size, "%.4g %s", time / units[i].size, units[i].unit);
}
