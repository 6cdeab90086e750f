/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps over keys: force against a key, averaged over seeds, a curve for each combination of the other keys. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_internal.h"

/* For each curve: the band between the quartiles, the mean or median, and the line of its power law, of two points. */
enum { SERIES = 3, LAW = 2 };

const char *sweep_plot_key_name(struct plot_panel *part, const struct bead_over *over, size_t key)
{
    char words[150], *text = plot_next_text(part);
    bead_over_key_name(over, key, true, words, sizeof words);
    bead_markup_quote(words, text, sizeof(plot_text));
    return text;
}

size_t sweep_plot_most_alike(const struct bead_sweep_curve *curve)
{
    size_t most = 0;
    for (size_t i = 0; i < curve->count; i++)
        most = curve->points[i].summary.count > most ? curve->points[i].summary.count : most;
    return most;
}

void sweep_plot_add(struct plot_panel *part, struct bead_series series, const struct bead_sweep_curve *curve,
                    enum sweep_plot_statistic what)
{
    const size_t n = curve->count;
    double *x = plot_add_numbers(part, series, n, SWEEP_PLOT_COLUMNS), *y = x + n, *other = y + n;
    for (size_t i = 0; i < n; i++) {
        const struct bead_summary *m = &curve->points[i].summary;
        x[i] = curve->points[i].x;
        y[i] = what == SWEEP_PLOT_MEAN ? m->mean : what == SWEEP_PLOT_MEDIAN ? m->median : m->quartile[0];
        other[i] = what == SWEEP_PLOT_QUARTILES ? m->quartile[1] : plot_bar_of_mean(m, curve->points[i].uncertainty.mean);
    }
    if (what == SWEEP_PLOT_QUARTILES) {
        plot_last(part)->mark = BEAD_MARK_BAND;
        plot_last(part)->upper = other;
        plot_last(part)->faint = true;
    } else if (what == SWEEP_PLOT_MEAN) {
        plot_last(part)->error = other;
    }
}

static void add(struct plot_panel *part, const struct bead_sweep_curve *curve, enum sweep_plot_statistic what, size_t number,
                const char *statistic)
{
    char *label = plot_next_text(part), quoted[200];
    struct bead_series series = {.mark = BEAD_MARK_LINE_POINTS};
    plot_tell_apart(&series, number);
    bead_markup_quote(curve->name, quoted, sizeof quoted);
    snprintf(label, sizeof(plot_text), "%.70s%s%s", quoted, *quoted && *statistic ? ", " : "", statistic);
    series.label = *label ? label : NULL;
    sweep_plot_add(part, series, curve, what);
}

/* The power law fitted to the curve, over its points. */
static void add_law(struct plot_panel *part, const struct bead_sweep_curve *curve)
{
    char *label = plot_next_text(part), slope[32], error[32] = "";
    bead_number(curve->slope, 3, slope, sizeof slope);
    if (curve->slope_error >= 5e-4)
        bead_number(curve->slope_error, 3, error, sizeof error);
    snprintf(label, sizeof(plot_text), "slope %s%s%s", slope, *error ? " ± " : "", error);
    const struct bead_series line = {.mark = BEAD_MARK_LINE, .colour = 5, .dash = BEAD_DASH_DOTTED, .label = label};
    double *x = plot_add_numbers(part, line, LAW, 2), *y = x + LAW;
    for (int i = 0; i < LAW; i++) {
        x[i] = curve->points[i ? curve->count - 1 : 0].x;
        y[i] = exp(curve->offset + curve->slope * log(x[i]));
    }
}

static void add_curve(struct plot_panel *part, const struct bead_output *output, const struct bead_sweep_curve *curve,
                      size_t number)
{
    const enum bead_sweep_show show = output->sweep_curves.show;
    const bool many = sweep_plot_most_alike(curve) > 1, median = many && show == BEAD_SWEEP_MEDIAN;
    if (many && show != BEAD_SWEEP_MEAN)
        add(part, curve, SWEEP_PLOT_QUARTILES, number, "quartiles");
    add(part, curve, median ? SWEEP_PLOT_MEDIAN : SWEEP_PLOT_MEAN, number, median ? "median" : many ? "mean" : "");
    if (output->plot.scale == BEAD_SCALE_LOG && isfinite(curve->slope))
        add_law(part, curve);
}

static enum bead_error fill(struct bead_plot_data *data, size_t p, const struct bead_sweep_curves *found, const char *unit,
                            struct bead_message *msg)
{
    const struct bead_plot_asked *asked = &data->output->plot;
    const struct bead_over *over = &bead_sweep_panel(data->context.sweep, 0)->spec->over;
    struct plot_panel *part = &data->parts[p];
    size_t numbers = 0;
    for (size_t i = 0; i < found->count; i++)
        numbers += 2 * SWEEP_PLOT_COLUMNS * found->curves[i].count + 2 * LAW;
    BEAD_TRY(plot_reserve_series(data, p, SERIES * found->count, numbers, msg));
    for (size_t i = 0; i < found->count; i++)
        add_curve(part, data->output, &found->curves[i], i);
    part->shown->x = (struct bead_graph_axis){
        sweep_plot_key_name(part, over, found->key), over->keys[found->key].unit, NAN, NAN, asked->scale, false};
    part->shown->y =
        (struct bead_graph_axis){data->axis_title, unit,         asked->range[0],
                                 asked->range[1],  asked->scale, isnan(asked->range[0]) && asked->scale != BEAD_SCALE_LOG};
    return BEAD_OK;
}

enum bead_error bead_over_plot_fill(struct bead_plot_data *data, struct bead_message *msg)
{
    return sweep_plot_fill_keys(data, fill, msg);
}

/* ---- of planes, too ---- */

enum bead_error sweep_plot_reserve_places(struct bead_plot_data *data, struct bead_message *msg)
{
    const size_t places = bead_sweep_panel(data->context.sweep, 0)->places;
    const bool measure = *data->output->sweep_curves.measure;
    BEAD_TRY(plot_reserve(data, measure ? 1 : places, msg));
    data->count = measure ? 1 : places;
    for (size_t p = 0; p < data->count && data->count > 1; p++)
        bead_markup_quote(bead_sweep_place(data->context.sweep, 0, p), data->parts[p].title, sizeof data->parts[p].title);
    return BEAD_OK;
}

/* Axes have prefixes for SI units; counts of beads have none. Returns the unit of the axis. */
static const char *name_measure(struct bead_plot_data *data, const char *unit)
{
    const bool count = strstr(unit, "bead") || strcmp(unit, "cells") == 0 || strcmp(unit, "contacts") == 0;
    snprintf(data->axis_title, sizeof data->axis_title, count ? "%s (%s)" : "%s", data->output->sweep_curves.measure, unit);
    return count ? "" : unit;
}

/* `values`: of a measure, else NULL. */
static enum bead_error fill_places(struct bead_plot_data *data, sweep_plot_keys *fill_panel, const struct bead_sweep_values *values,
                                   const char *unit, struct bead_message *msg)
{
    BEAD_TRY(sweep_plot_reserve_places(data, msg));
    for (size_t p = 0; p < data->count; p++) {
        BEAD_LEFT_TO(bead_sweep_curves_free) struct bead_sweep_curves found;
        BEAD_TRY(bead_sweep_curves_find(data->context.sweep, 0, p, values, data->output->sweep_curves.against, &found, msg));
        BEAD_TRY(fill_panel(data, p, &found, unit, msg));
    }
    return BEAD_OK;
}

enum bead_error sweep_plot_fill_keys(struct bead_plot_data *data, sweep_plot_keys *fill_panel, struct bead_message *msg)
{
    const char *measure = data->output->sweep_curves.measure, *unit = "N";
    BEAD_LEFT_TO(bead_sweep_values_free) struct bead_sweep_values of = {NULL, NULL};
    snprintf(data->axis_title, sizeof data->axis_title, "peak bead force");
    if (!*measure)
        return fill_places(data, fill_panel, NULL, unit, msg);
    BEAD_TRY(bead_sweep_measured(data->context.sweep, measure, data->context.sweep_settings, &of, &unit, msg));
    return fill_places(data, fill_panel, &of, name_measure(data, unit), msg);
}
