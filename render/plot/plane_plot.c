/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps as planes: peak force by the number of random cells and their magnetism, with the threshold between the two
 * regimes; or a result by two keys. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/plot/plane.h"
#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_curves.h"
#include "sim/sweep/sweep_internal.h"

/* A panel for each place where forces are measured. */
struct plane {
    struct bead_plane_point *points;
    size_t count;
    enum bead_scale scales[2];
    double ends[2][2];
    struct bead_graph_image image;
    double *threshold; /* [sweeps] x, y and error, of those over spins */
    struct bead_series series;
    char axes[2][200], title[300];
    const char *units[2];
};

static void add_point(struct plane *p, double x, double y, double value)
{
    if (isfinite(y) && isfinite(value))
        p->points[p->count++] = (struct bead_plane_point){x, y, value};
}

/* ---- over spins ---- */

static void add_column(struct plane *p, const struct bead_sweep_statistics *s, double cells, size_t sweeps)
{
    const struct bead_threshold *t = &s->threshold;
    for (size_t i = 0; i < s->row_count; i++)
        add_point(p, cells, s->rows[i].magnetism, s->rows[i].summary.mean);
    if (!s->has_threshold || !isfinite(t->critical))
        return;
    size_t at = p->series.count++;
    for (; at > 0 && p->threshold[at - 1] > cells; at--) { /* by ascending number of cells */
        for (size_t k = 0; k < 3; k++)
            p->threshold[k * sweeps + at] = p->threshold[k * sweeps + at - 1];
    }
    p->threshold[at] = cells;
    p->threshold[sweeps + at] = t->critical;
    p->threshold[2 * sweeps + at] = isfinite(t->critical_error) ? t->critical_error : 0;
}

static enum bead_error take_spins(struct sweep_page *page, struct plane *p, size_t place, struct bead_message *msg)
{
    const struct bead_sweep *sweep = page->context->sweep;
    const size_t sweeps = bead_sweep_panels(sweep);
    size_t room = 0;
    for (size_t i = 0; i < sweeps; i++)
        room += bead_sweep_panel(sweep, i)->spec->group_count + 1;
    BEAD_TRY(plot_new(&page->store, &p->points, room, msg));
    BEAD_TRY(plot_new(&page->store, &p->threshold, 3 * sweeps, msg));
    for (size_t i = 0; i < sweeps; i++) {
        const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, i);
        struct bead_sweep_statistics s;
        if (place >= panel->places)
            continue;
        BEAD_TRY(bead_sweep_statistics(sweep, i, place, page->output->sweep_curves.threshold, &s, msg));
        add_column(p, &s, (double)panel->spec->cells, sweeps);
        bead_sweep_statistics_free(&s);
    }
    p->series.x = p->threshold;
    p->series.y = p->threshold + sweeps;
    p->series.error = p->threshold + 2 * sweeps;
    p->series.mark = BEAD_MARK_LINE_POINTS;
    p->series.label = "threshold *M*_c";
    p->scales[0] = BEAD_SCALE_LOG;
    snprintf(p->axes[0], sizeof p->axes[0], "random cells *N*");
    snprintf(p->axes[1], sizeof p->axes[1], "magnetism *M*");
    p->units[0] = p->units[1] = "";
    p->image.title = "mean *F*/\u2060*F*(*M*\u00a0=\u00a01)";
    p->image.unit = "";
    return BEAD_OK;
}

/* ---- over keys ---- */

/* The only key that is neither a seed nor along the axis. */
static const struct bead_over_key *other_key(const struct bead_over *over, size_t key)
{
    size_t k = 0;
    while (k == key || over->keys[k].seed)
        k++;
    return &over->keys[k];
}

static bool is_positive(const struct bead_over_key *key)
{
    for (size_t i = 0; i < key->count; i++) {
        if (!(key->value[i] > 0))
            return false;
    }
    return true;
}

static enum bead_error take_keys(struct sweep_page *page, struct plane *p, size_t place, const struct bead_over_shown *what,
                                 struct bead_message *msg)
{
    const struct bead_output *output = page->output;
    const struct bead_sweep *sweep = page->context->sweep;
    const struct bead_over *over = &bead_sweep_panel(sweep, 0)->spec->over;
    struct bead_sweep_curves found;
    enum bead_error err = bead_sweep_curves_find(sweep, 0, place, what->values, output->sweep_curves.against, &found, msg);
    const struct bead_over_key *keys[2] = {&over->keys[found.key], other_key(over, found.key)};
    if (!err)
        err = plot_new(&page->store, &p->points, keys[0]->count * keys[1]->count, msg);
    for (size_t i = 0; !err && i < found.count; i++) {
        const struct bead_sweep_curve *curve = &found.curves[i];
        for (size_t k = 0; k < curve->count; k++)
            add_point(p, curve->points[k].x, keys[1]->value[i], curve->points[k].summary.mean);
    }
    bead_sweep_curves_free(&found);
    for (size_t k = 0; k < 2; k++) {
        bead_over_axis_name(over, (size_t)(keys[k] - over->keys), p->axes[k], sizeof p->axes[k]);
        p->units[k] = keys[k]->unit;
        p->scales[k] = output->plot.scale == BEAD_SCALE_LOG && is_positive(keys[k]) ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR;
    }
    p->image.title = what->title;
    p->image.unit = what->unit;
    return err;
}

/* ---- both ---- */

static enum bead_error make_panel(struct sweep_page *page, struct plane *p, size_t place, struct bead_message *msg)
{
    const struct bead_graph_image named = p->image;
    const double *range = page->output->plot.range;
    if (p->count == 0)
        return bead_output_wrong(page->output, msg, "show: no chain of the sweep has a value for the plane");
    BEAD_TRY(bead_plane_make(p->points, p->count, p->scales, &p->image, p->ends, msg));
    p->image.title = named.title;
    p->image.unit = named.unit;
    /* Forces begin at 0, as on axes; measures only if one of them is nearly 0. */
    const bool forces = !*page->output->sweep_curves.measure;
    p->image.low = !isnan(range[0]) ? range[0] : forces ? fmin(0, p->image.low) : p->image.low;
    p->image.high = !isnan(range[1]) ? range[1] : p->image.high;
    if (!(p->image.high > p->image.low))
        p->image.high = p->image.low + (p->image.low != 0 ? fabs(p->image.low) : 1);
    if (bead_sweep_panel(page->context->sweep, 0)->places > 1)
        bead_markup_quote(bead_sweep_place(page->context->sweep, 0, place), p->title, sizeof p->title);
    page->panels[place] = (struct bead_panel){.title = *p->title ? p->title : NULL,
                                              .x = {p->axes[0], p->units[0], p->ends[0][0], p->ends[0][1], p->scales[0], false},
                                              .y = {p->axes[1], p->units[1], p->ends[1][0], p->ends[1][1], p->scales[1], false},
                                              .series = &p->series,
                                              .series_count = p->series.count > 0,
                                              .image = &p->image};
    return BEAD_OK;
}

enum bead_error bead_plane_plot_write(struct sweep_page *page, struct bead_message *msg)
{
    const struct bead_sweep_panel *panel = bead_sweep_panel(page->context->sweep, 0);
    const bool over = panel->spec->over.key_count > 0;
    const size_t places = *page->output->sweep_curves.measure ? 1 : panel->places;
    struct bead_over_shown what = {.values = NULL};
    struct plane *planes = NULL;
    enum bead_error err = over ? bead_over_shown_find(page->output, page->context, &what, msg) : BEAD_OK;
    if (!err)
        err = sweep_page_reserve(page, places, msg);
    if (!err)
        err = plot_new(&page->store, &planes, places, msg);
    for (size_t i = 0; i < places && !err; i++) {
        err = over ? take_keys(page, &planes[i], i, &what, msg) : take_spins(page, &planes[i], i, msg);
        if (!err)
            err = make_panel(page, &planes[i], i, msg);
    }
    if (!err)
        err = sweep_page_write(page, msg);
    for (size_t i = 0; planes && i < places; i++)
        free((double *)planes[i].image.values);
    bead_sweep_values_free(&what.of);
    return err;
}
