/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps as planes: peak force by the number of random cells and their magnetism, with the threshold between the two
 * regimes; or a result by two keys. */
#include <math.h>
#include <stdlib.h>

#include "render/plot/sweep_plot.h"
#include "sim/sweep/sweep_internal.h"

/* The points of a panel, until it has its colours. */
struct plane {
    struct bead_plane_point *points;
    size_t count;
};

static void add_point(struct plane *plane, double x, double y, double value)
{
    if (isfinite(y) && isfinite(value))
        plane->points[plane->count++] = (struct bead_plane_point){x, y, value};
}

/* Makes the colours; the axes of the panel have their titles, units and scales, and get their ends. */
static enum bead_error colour(struct bead_plot_data *data, size_t p, const struct plane *plane, const char *title, const char *unit,
                              struct bead_message *msg)
{
    struct plot_panel *part = &data->parts[p];
    struct bead_graph_axis *x = &part->shown->x, *y = &part->shown->y;
    struct bead_graph_image *image = &part->image;
    const double *range = data->output->plot.range;
    double ends[2][2];
    if (plane->count == 0)
        return bead_output_wrong(data->output, msg, "show: no chain of the sweep has a value for the plane");
    BEAD_TRY(bead_plane_make(plane->points, plane->count, (const enum bead_scale[]){x->scale, y->scale}, image, ends, msg));
    part->spectral.values = (double *)image->values;
    image->title = title;
    image->unit = unit;
    /* Forces begin at 0, as on axes; measures only if one of them is nearly 0. */
    const bool forces = !*data->output->sweep_curves.measure;
    image->low = !isnan(range[0]) ? range[0] : forces ? fmin(0, image->low) : image->low;
    image->high = !isnan(range[1]) ? range[1] : image->high;
    if (!(image->high > image->low))
        image->high = image->low + (image->low != 0 ? fabs(image->low) : 1);
    x->low = ends[0][0];
    x->high = ends[0][1];
    y->low = ends[1][0];
    y->high = ends[1][1];
    part->shown->image = image;
    return BEAD_OK;
}

/* ---- over spins ---- */

/* Adds a point of the threshold, by ascending number of cells. */
static void add_threshold(struct bead_series *line, double *x, size_t sweeps, double cells, const struct bead_threshold *t)
{
    const double point[] = {cells, t->critical, isfinite(t->critical_error) ? t->critical_error : 0};
    size_t at = line->count++;
    for (; at > 0 && x[at - 1] > cells; at--) {
        for (size_t k = 0; k < 3; k++)
            x[k * sweeps + at] = x[k * sweeps + at - 1];
    }
    for (size_t k = 0; k < 3; k++)
        x[k * sweeps + at] = point[k];
}

static enum bead_error take_spins(struct bead_plot_data *data, size_t p, struct plane *plane, struct bead_message *msg)
{
    const struct bead_sweep *sweep = data->context.sweep;
    const size_t sweeps = bead_sweep_panels(sweep);
    struct plot_panel *part = &data->parts[p];
    size_t room = 0;
    for (size_t i = 0; i < sweeps; i++)
        room += bead_sweep_panel(sweep, i)->spec->group_count + 1;
    BEAD_TRY(plot_new(&data->store, &plane->points, room, msg));
    BEAD_TRY(plot_reserve_series(data, p, 1, 3 * sweeps, msg));
    const struct bead_series line = {.mark = BEAD_MARK_LINE_POINTS, .label = "threshold *M*_c"};
    double *x = plot_add_numbers(part, line, sweeps, 3);
    plot_last(part)->error = x + 2 * sweeps;
    plot_last(part)->count = 0;
    for (size_t i = 0; i < sweeps; i++) {
        const struct bead_sweep_panel *panel = bead_sweep_panel(sweep, i);
        const double cells = (double)panel->spec->cells;
        struct bead_sweep_statistics s;
        if (p >= panel->places)
            continue;
        BEAD_TRY(bead_sweep_statistics(sweep, i, p, data->output->sweep_curves.threshold, &s, msg));
        for (size_t k = 0; k < s.row_count; k++)
            add_point(plane, cells, s.rows[k].magnetism, s.rows[k].summary.mean);
        if (s.has_threshold && isfinite(s.threshold.critical))
            add_threshold(plot_last(part), x, sweeps, cells, &s.threshold);
        bead_sweep_statistics_free(&s);
    }
    part->shown->series_count = plot_last(part)->count > 0;
    return BEAD_OK;
}

static enum bead_error fill_spins(struct bead_plot_data *data, size_t p, struct bead_message *msg)
{
    struct plane plane = {NULL, 0};
    BEAD_TRY(take_spins(data, p, &plane, msg));
    data->panels[p].x = (struct bead_graph_axis){.title = "random cells *N*", .unit = "", .scale = BEAD_SCALE_LOG};
    data->panels[p].y = (struct bead_graph_axis){.title = "magnetism *M*", .unit = ""};
    return colour(data, p, &plane, "mean *F*/\u2060*F*(*M*\u00a0=\u00a01)", "", msg);
}

/* ---- over keys ---- */

/* The only key that is neither a seed nor along the axis. */
static size_t other_key(const struct bead_over *over, size_t key)
{
    size_t k = 0;
    while (k == key || over->keys[k].seed)
        k++;
    return k;
}

static bool is_positive(const struct bead_over_key *key)
{
    for (size_t i = 0; i < key->count; i++) {
        if (!(key->value[i] > 0))
            return false;
    }
    return true;
}

static enum bead_error fill_keys(struct bead_plot_data *data, size_t p, const struct bead_sweep_curves *found, const char *unit,
                                 struct bead_message *msg)
{
    const struct bead_over *over = &bead_sweep_panel(data->context.sweep, 0)->spec->over;
    const size_t keys[2] = {found->key, other_key(over, found->key)};
    const struct bead_over_key *other = &over->keys[keys[1]];
    struct plane plane = {NULL, 0};
    BEAD_TRY(plot_new(&data->store, &plane.points, over->keys[keys[0]].count * other->count, msg));
    BEAD_TRY(plot_reserve_series(data, p, 0, 0, msg));
    for (size_t i = 0; i < found->count; i++) {
        const struct bead_sweep_curve *curve = &found->curves[i];
        for (size_t k = 0; k < curve->count; k++)
            add_point(&plane, curve->points[k].x, other->value[i], curve->points[k].summary.mean);
    }
    for (size_t k = 0; k < 2; k++) {
        const struct bead_over_key *key = &over->keys[keys[k]];
        const bool logarithmic = data->output->plot.scale == BEAD_SCALE_LOG && is_positive(key);
        *(k ? &data->panels[p].y : &data->panels[p].x) =
            (struct bead_graph_axis){.title = sweep_plot_key_name(&data->parts[p], over, keys[k]),
                                     .unit = key->unit,
                                     .scale = logarithmic ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR};
    }
    return colour(data, p, &plane, data->axis_title, unit, msg);
}

enum bead_error bead_plane_plot_fill(struct bead_plot_data *data, struct bead_message *msg)
{
    if (bead_sweep_panel(data->context.sweep, 0)->spec->over.key_count > 0)
        return sweep_plot_fill_keys(data, fill_keys, msg);
    BEAD_TRY(sweep_plot_reserve_places(data, msg));
    for (size_t p = 0; p < data->count; p++)
        BEAD_TRY(fill_spins(data, p, msg));
    return BEAD_OK;
}
