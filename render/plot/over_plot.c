/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps over keys: force against a key, averaged over seeds, a curve for each combination of the other keys. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/plot_private.h"
#include "render/plot/sweep_plot.h"
#include "sim/base/memory.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* For each curve: the band between the quartiles, the mean or median, and the line of its power law, with so many numbers for each
 * point. */
enum { SERIES = 4, COLUMNS = 8 };

struct over_panel {
    struct bead_sweep_curves found;
    struct bead_series *series;
    double *numbers;
    char (*labels)[300];
    size_t count;
    char title[300], axis[200];
};

void bead_over_axis_name(const struct bead_over_key *key, char *text, size_t size)
{
    const char *last = strrchr(key->path, '.') + 1, *part = last - 1; /* a path has a point */
    char words[150];
    while (part > key->path && part[-1] != '.')
        part--;
    part = isdigit((unsigned char)*part) || part == key->path ? last : part;
    snprintf(words, sizeof words, "%s", part);
    for (char *c = words; *c; c++)
        *c = *c == '.' ? ' ' : *c;
    bead_markup_quote(words, text, size);
}

/* One series over the points of a curve; y from the statistics. */
enum statistic { MEAN, MEDIAN, QUARTILES };

static size_t most_alike(const struct bead_sweep_curve *curve)
{
    size_t most = 0;
    for (size_t i = 0; i < curve->count; i++)
        most = curve->points[i].summary.count > most ? curve->points[i].summary.count : most;
    return most;
}

static void add(struct over_panel *p, const struct bead_sweep_curve *curve, enum statistic what, size_t number, double **at)
{
    double longest = 0;
    const size_t n = curve->count;
    double *x = *at, *y = x + n, *other = y + n;
    *at = other + n;
    for (size_t i = 0; i < n; i++) {
        const struct bead_summary *m = &curve->points[i].summary;
        x[i] = curve->points[i].x;
        y[i] = what == MEAN ? m->mean : what == MEDIAN ? m->median : m->quartile[0];
        other[i] = what == QUARTILES ? m->quartile[1] : plot_bar_of_mean(m, curve->points[i].uncertainty);
        longest = fmax(longest, other[i]);
    }
    struct bead_series *series = &p->series[p->count];
    *series = (struct bead_series){.x = x, .y = y, .count = n, .mark = BEAD_MARK_LINE_POINTS, .label = p->labels[p->count]};
    plot_tell_apart(series, number);
    if (what == QUARTILES) {
        series->mark = BEAD_MARK_BAND;
        series->upper = other;
        series->faint = true;
    } else if (what == MEAN && longest > 0) {
        series->error = other;
    }
    p->count++;
}

static void label(const struct bead_sweep_curve *curve, const char *place, const char *statistic, char *text, size_t size)
{
    char quoted[200], slope[32], error[32];
    size_t used = 0;
    const char *const parts[] = {place, curve->name, statistic};
    *text = '\0';
    for (size_t i = 0; i < 3; i++) {
        bead_markup_quote(parts[i], quoted, sizeof quoted);
        if (*quoted)
            used += (size_t)snprintf(text + used, size - used, "%s%.70s", used ? ", " : "", quoted);
    }
    if (statistic[0] != '*')
        return;
    bead_number(curve->slope, 3, slope, sizeof slope);
    bead_number(curve->slope_error, 3, error, sizeof error);
    snprintf(text, size, "slope %s%s%s", slope, curve->slope_error >= 5e-4 ? " ± " : "", curve->slope_error >= 5e-4 ? error : "");
}

/* The power law that fits the curve, over its points. */
static void add_law(struct over_panel *p, const struct bead_sweep_curve *curve, double **at)
{
    double *x = *at, *y = x + 2;
    *at = y + 2;
    for (int i = 0; i < 2; i++) {
        x[i] = curve->points[i ? curve->count - 1 : 0].x;
        y[i] = exp(curve->offset + curve->slope * log(x[i]));
    }
    label(curve, "", "*", p->labels[p->count], sizeof p->labels[p->count]);
    p->series[p->count] = (struct bead_series){
        .x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE, .colour = 5, .dash = BEAD_DASH_DOTTED, .label = p->labels[p->count]};
    p->count++;
}

static void add_curve(struct over_panel *p, const struct bead_output *output, const struct bead_sweep_curve *curve,
                      const char *place, size_t number, double **at)
{
    const enum bead_sweep_show show = output->sweep_curves.show;
    const bool many = most_alike(curve) > 1;
    static const char *const words[] = {[MEAN] = "mean", [MEDIAN] = "median", [QUARTILES] = "quartiles"};
    const bool shown[] = {[MEAN] = show != BEAD_SWEEP_MEDIAN,
                          [MEDIAN] = many && show == BEAD_SWEEP_MEDIAN,
                          [QUARTILES] = many && show != BEAD_SWEEP_MEAN};
    static const enum statistic order[] = {QUARTILES, MEAN, MEDIAN};
    for (size_t i = 0; i < 3; i++) {
        if (!shown[order[i]] && !(order[i] == MEAN && !many))
            continue;
        label(curve, place, many ? words[order[i]] : "", p->labels[p->count], sizeof p->labels[p->count]);
        add(p, curve, order[i], number, at);
        if (!*p->labels[p->count - 1])
            p->series[p->count - 1].label = NULL;
    }
    if (output->plot.scale == BEAD_SCALE_LOG && isfinite(curve->slope))
        add_law(p, curve, at);
}

/* Axes have prefixes for units of SI; counts of beads are no such. */
enum bead_error bead_over_shown_find(const struct bead_output *output, const struct bead_run_context *context,
                                     struct bead_over_shown *what, struct bead_message *msg)
{
    const char *measure = output->sweep_curves.measure;
    *what = (struct bead_over_shown){.unit = "N", .title = "peak bead force"};
    if (!*measure)
        return BEAD_OK;
    BEAD_TRY(bead_sweep_measured(context->sweep, measure, context->sweep_settings, &what->of, &what->unit, msg));
    what->values = &what->of;
    const bool count = strstr(what->unit, "bead") || strcmp(what->unit, "cells") == 0 || strcmp(what->unit, "contacts") == 0;
    snprintf(what->title, sizeof what->title, "%s%s%s%s", measure, count ? " (" : "", count ? what->unit : "", count ? ")" : "");
    what->unit = count ? "" : what->unit;
    return BEAD_OK;
}

/* Several places have a panel each. */
static enum bead_error fill(struct over_panel *p, struct bead_panel *shown, const struct bead_output *output,
                            const struct bead_sweep *sweep, size_t place, const struct bead_over_shown *what,
                            struct bead_message *msg)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, 0);
    BEAD_TRY(bead_sweep_curves_find(sweep, 0, place, what->values, output->sweep_curves.against, &p->found, msg));
    const struct bead_over_key *key = &panel->spec->over.keys[p->found.key];
    const size_t curves = p->found.count;
    BEAD_TRY(bead_new(&p->series, SERIES * curves + 1, msg, "a plot of a sweep"));
    BEAD_TRY(bead_new(&p->labels, SERIES * curves + 1, msg, "a plot of a sweep"));
    BEAD_TRY(bead_new(&p->numbers, curves * (COLUMNS + 2) * (key->count + 1), msg, "a plot of a sweep"));
    double *at = p->numbers;
    for (size_t i = 0; i < curves; i++)
        add_curve(p, output, &p->found.curves[i], "", i, &at);
    if (panel->places > 1 && !what->values)
        bead_markup_quote(bead_sweep_place(sweep, 0, place), p->title, sizeof p->title);
    bead_over_axis_name(key, p->axis, sizeof p->axis);
    const bool log_axes = output->plot.scale == BEAD_SCALE_LOG;
    *shown = (struct bead_panel){.title = *p->title ? p->title : NULL,
                                 .x = {p->axis, key->unit, NAN, NAN, output->plot.scale, false},
                                 .y = {what->title, what->unit, output->plot.range[0], output->plot.range[1], output->plot.scale,
                                       isnan(output->plot.range[0]) && !log_axes},
                                 .series = p->series,
                                 .series_count = p->count};
    return BEAD_OK;
}

enum bead_error bead_over_plot_write(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                     uint64_t *bytes, struct bead_message *msg)
{
    const struct bead_sweep *sweep = context->sweep;
    const size_t places = *output->sweep_curves.measure ? 1 : bead_sweep_panel(sweep, 0)->places;
    struct bead_over_shown what;
    BEAD_FREED struct over_panel *panels = NULL;
    BEAD_FREED struct bead_panel *shown = NULL;
    enum bead_error err = bead_over_shown_find(output, context, &what, msg);
    if (!err)
        err = bead_new(&panels, places, msg, "a plot of a sweep");
    if (!err)
        err = bead_new(&shown, places, msg, "a plot of a sweep");
    for (size_t i = 0; i < places && !err; i++)
        err = fill(&panels[i], &shown[i], output, sweep, i, &what, msg);
    const struct bead_graph graph = {.panels = shown, .panel_count = places, .letters = true, .share_x = true, .share_y = true};
    if (!err)
        err = bead_graph_write(&graph, output, bead_sweep_scene(sweep), path, bytes, msg);
    for (size_t i = 0; panels && i < places; i++) {
        bead_sweep_curves_free(&panels[i].found);
        free(panels[i].series);
        free(panels[i].labels);
        free(panels[i].numbers);
    }
    bead_sweep_values_free(&what.of);
    return err;
}
