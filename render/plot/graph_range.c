/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges of a graph's axes: as requested, else from data and rulers, widened so that nothing touches the frame. First step of the
 * layout. */
#include <math.h>

#include "render/plot/graph_private.h"

/* Parts of the range added at both ends; lines without points fill the x axis. */
static const double widened_x = 0.03, widened_y = 0.06;
/* Values whose relative difference is smaller count as equal. */
static const double alike = 1e-9;
static const double log_room = 1.3;
static const double largest = 1e300; /* beyond, lengths of axes overflow */
/* A logarithmic axis with only its upper end given extends down to this part of it. */
static const double log_span = 1e-4;

static void take(double value, enum bead_scale scale, double range[2])
{
    if (!(fabs(value) <= largest) || (scale == BEAD_SCALE_LOG && !(value > 0)))
        return;
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

/* Smallest and largest x (`axis` 0) or y shown in a panel. */
static void take_panel(const struct bead_panel *panel, int axis, double range[2])
{
    enum bead_scale scale = (axis ? panel->y : panel->x).scale;
    for (size_t s = 0; s < panel->series_count; s++) {
        const struct bead_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count; i++) {
            double value = axis ? series->y[i] : series->x[i];
            if (!isfinite(series->x[i]) || !isfinite(series->y[i]))
                continue;
            take(value, scale, range);
            if (axis && series->error && isfinite(series->error[i])) {
                take(value - series->error[i], scale, range);
                take(value + series->error[i], scale, range);
            }
            if (axis && series->upper)
                take(series->upper[i], scale, range);
        }
    }
    for (size_t r = 0; r < panel->ruler_count; r++) {
        const struct bead_ruler *ruler = &panel->rulers[r];
        if (ruler->vertical != (axis == 0))
            continue;
        take(ruler->value, scale, range);
        take(ruler->low, scale, range);
        take(ruler->high, scale, range);
    }
}

static bool has_points(const struct bead_panel *panel)
{
    for (size_t s = 0; s < panel->series_count; s++) {
        if (panel->series[s].mark != BEAD_MARK_LINE)
            return true;
    }
    return false;
}

static void widen_log(double range[2])
{
    if (!(range[0] <= range[1])) {
        range[0] = 1;
        range[1] = 10;
    }
    double room = fmax(log_room, exp(0.04 * (log(range[1]) - log(range[0]))));
    range[0] /= room;
    range[1] *= room;
}

static void range_widen(const struct bead_graph_axis *axis, bool counts, double part, double range[2])
{
    if (!(range[0] <= range[1])) {
        range[0] = 0;
        range[1] = 1;
    }
    if (axis->zero && range[0] > 0)
        range[0] = 0;
    double size = fmax(fabs(range[0]), fabs(range[1])), length = range[1] - range[0];
    if (length <= alike * size || length == 0) {
        double room = counts ? 0.5 : size > 0 ? 0.1 * size : 1;
        range[0] -= room;
        range[1] += room;
        return;
    }
    bool from_zero = axis->zero && range[0] >= 0;
    double room = counts && part > 0 ? fmax(0.5, part * length) : part * length;
    range[0] -= from_zero ? 0 : room;
    range[1] += room;
}

/* Requested ends replace those found. */
static void apply(const struct bead_graph_axis *axis, double range[2])
{
    bool low = !isnan(axis->low), high = !isnan(axis->high), logarithmic = axis->scale == BEAD_SCALE_LOG;
    range[0] = low ? axis->low : range[0];
    range[1] = high ? axis->high : range[1];
    if (range[1] > range[0])
        return;
    if (low && !high)
        range[1] = logarithmic ? 10 * range[0] : range[0] + fmax(fabs(range[0]), 1e-300);
    else if (high && !low)
        range[0] = logarithmic ? log_span * range[1] : range[1] - fmax(fabs(range[1]), 1e-300);
}

static enum bead_error range_check(const struct bead_graph_axis *axis, struct bead_message *msg)
{
    if (axis->low >= axis->high)
        return bead_fail(msg, BEAD_ERROR_SCENE, "range: is [%g, %g]; the first must be less than the second", axis->low,
                         axis->high);
    if (axis->scale == BEAD_SCALE_LOG && fmin(axis->low, axis->high) <= 0) /* of two, if one is NaN the other */
        return bead_fail(msg, BEAD_ERROR_SCENE, "range: is [%g, %g]; a logarithmic scale needs numbers above 0", axis->low,
                         axis->high);
    return BEAD_OK;
}

/* Makes the final range from the one found. */
static void range_settle(const struct bead_graph_axis *axis, double part, double range[2])
{
    bool counts = strcmp(axis->unit, "1") == 0;
    if (axis->scale != BEAD_SCALE_LOG)
        range_widen(axis, counts, part, range);
    else if (part > 0 || !(range[1] > range[0]))
        widen_log(range);
    apply(axis, range);
}

static enum bead_error find_axis(struct graph_layout *layout, int axis, struct bead_message *msg)
{
    const struct bead_graph *graph = layout->graph;
    bool shared = axis ? graph->share_y : graph->share_x, points = false;
    double all[2] = {INFINITY, -INFINITY};
    for (size_t p = 0; p < graph->panel_count; p++) {
        take_panel(&graph->panels[p], axis, all);
        points = points || has_points(&graph->panels[p]);
    }
    for (size_t p = 0; p < graph->panel_count; p++) {
        const struct bead_panel *panel = &graph->panels[p], *which = shared ? &graph->panels[0] : panel;
        const struct bead_graph_axis *settings = axis ? &which->y : &which->x;
        double range[2] = {shared ? all[0] : INFINITY, shared ? all[1] : -INFINITY};
        BEAD_TRY(range_check(settings, msg));
        if (!shared)
            take_panel(panel, axis, range);
        range_settle(settings, axis ? widened_y : (shared ? points : has_points(panel)) ? widened_x : 0, range);
        layout->cells[p].low[axis] = range[0];
        layout->cells[p].high[axis] = range[1];
    }
    return BEAD_OK;
}

enum bead_error graph_find_ranges(struct graph_layout *layout, struct bead_message *msg)
{
    BEAD_TRY(find_axis(layout, 0, msg));
    return find_axis(layout, 1, msg);
}
