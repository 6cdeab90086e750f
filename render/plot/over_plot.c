/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps over keys: force against a key, averaged over seeds, a curve for each combination of the other keys. */
#include <math.h>

#include "render/draw/markup.h"
#include "render/draw/words.h"
#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* For each curve: the band between the quartiles, the mean or median, and the line of its power law, with this many numbers for
 * each point. */
enum { SERIES = 4, COLUMNS = 8 };

struct over_panel {
    struct bead_sweep_curves found;
    struct bead_series *series;
    char (*labels)[300];
    size_t count;
    char title[300], axis[200];
};

void bead_over_axis_name(const struct bead_over *over, size_t key, char *text, size_t size)
{
    char words[150];
    bead_over_key_name(over, key, true, words, sizeof words);
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
        other[i] = what == QUARTILES ? m->quartile[1] : plot_bar_of_mean(m, curve->points[i].uncertainty.mean);
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

/* The power law fitted to the curve, over its points. */
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

/* Axes have prefixes for SI units; counts of beads have none. */
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
static enum bead_error fill(struct sweep_page *page, struct over_panel *p, size_t place, const struct bead_over_shown *what,
                            struct bead_message *msg)
{
    const struct bead_plot_asked *asked = &page->output->plot;
    const struct bead_sweep *sweep = page->context->sweep;
    const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, 0);
    BEAD_TRY(bead_sweep_curves_find(sweep, 0, place, what->values, page->output->sweep_curves.against, &p->found, msg));
    const struct bead_over_key *key = &panel->spec->over.keys[p->found.key];
    const size_t curves = p->found.count;
    double *at = NULL;
    BEAD_TRY(plot_new(&page->store, &p->series, SERIES * curves, msg));
    BEAD_TRY(plot_new(&page->store, &p->labels, SERIES * curves, msg));
    BEAD_TRY(plot_new(&page->store, &at, curves * (COLUMNS + 2) * (key->count + 1), msg));
    for (size_t i = 0; i < curves; i++)
        add_curve(p, page->output, &p->found.curves[i], "", i, &at);
    if (panel->places > 1 && !what->values)
        bead_markup_quote(bead_sweep_place(sweep, 0, place), p->title, sizeof p->title);
    bead_over_axis_name(&panel->spec->over, p->found.key, p->axis, sizeof p->axis);
    page->panels[place] = (struct bead_panel){.title = *p->title ? p->title : NULL,
                                              .x = {p->axis, key->unit, NAN, NAN, asked->scale, false},
                                              .y = {what->title, what->unit, asked->range[0], asked->range[1], asked->scale,
                                                    isnan(asked->range[0]) && asked->scale != BEAD_SCALE_LOG},
                                              .series = p->series,
                                              .series_count = p->count};
    return BEAD_OK;
}

enum bead_error bead_over_plot_write(struct sweep_page *page, struct bead_message *msg)
{
    const size_t places = *page->output->sweep_curves.measure ? 1 : bead_sweep_panel(page->context->sweep, 0)->places;
    struct bead_over_shown what;
    struct over_panel *panels = NULL;
    enum bead_error err = bead_over_shown_find(page->output, page->context, &what, msg);
    if (!err)
        err = sweep_page_reserve(page, places, msg);
    if (!err)
        err = plot_new(&page->store, &panels, places, msg);
    for (size_t i = 0; i < places && !err; i++)
        err = fill(page, &panels[i], i, &what, msg);
    if (!err)
        err = sweep_page_write(page, msg);
    for (size_t i = 0; panels && i < places; i++)
        bead_sweep_curves_free(&panels[i].found);
    bead_sweep_values_free(&what.of);
    return err;
}
