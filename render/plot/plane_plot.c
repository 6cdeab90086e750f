/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps as planes: peak force by the number of random cells and their magnetism, with the threshold between the two
 * regimes; or a result by two keys. */
#include <math.h>
#include <stdlib.h>

#include "render/plot/sweep_plot.h"
#include "sim/base/memory.h"
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

/* ---- planes as images ---- */

/* Finer than the pixels of most pictures. */
enum { COLUMNS = 1024, ROWS = 1024 };

static int by_place(const void *a, const void *b)
{
    const struct bead_plane_point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

static double along(enum bead_scale scale, double value)
{
    return scale == BEAD_SCALE_LOG ? log(value) : value;
}

static double back(enum bead_scale scale, double place)
{
    return scale == BEAD_SCALE_LOG ? exp(place) : place;
}

/* Points of one x, from `first`. */
static size_t alike(const struct bead_plane_point *points, size_t count, size_t first)
{
    size_t end = first;
    while (end < count && points[end].x == points[first].x)
        end++;
    return end - first;
}

/* Widens a range to half a step beyond its first and last place. A single place has width 1. */
static void widen(double ends[2], const double *places, size_t count)
{
    const double low = count > 1 ? places[1] - places[0] : 1, high = count > 1 ? places[count - 1] - places[count - 2] : 1;
    ends[0] = fmin(ends[0], places[0] - low / 2);
    ends[1] = fmax(ends[1], places[count - 1] + high / 2);
}

/* The nearest of ascending places. */
static size_t nearest(const double *places, size_t count, double at)
{
    size_t i = 0;
    while (i + 1 < count && at > (places[i] + places[i + 1]) / 2)
        i++;
    return i;
}

/* The places of the points on the axes: [columns] of x, and [count] of y. */
struct places {
    double *x, *y;
    size_t *first; /* [columns + 1] points of each */
    size_t columns;
};

static enum bead_error find_places(const struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                   struct places *places, double ends[2][2], struct bead_message *msg)
{
    *places = (struct places){.columns = 0};
    BEAD_TRY(bead_new(&places->x, 2 * count + 1, msg, "a plane"));
    BEAD_TRY(bead_new(&places->first, count + 1, msg, "a plane"));
    places->y = places->x + count;
    for (size_t k = 0; k < 2; k++) {
        ends[k][0] = INFINITY;
        ends[k][1] = -INFINITY;
    }
    for (size_t i = 0, n; i < count; i += n) {
        n = alike(points, count, i);
        places->x[places->columns] = along(scales[0], points[i].x);
        for (size_t k = i; k < i + n; k++)
            places->y[k] = along(scales[1], points[k].y);
        widen(ends[1], places->y + i, n);
        places->first[++places->columns] = i + n;
    }
    widen(ends[0], places->x, places->columns);
    return BEAD_OK;
}

static void fill(const struct bead_plane_point *points, const struct places *places, double ends[2][2], double *values)
{
    for (size_t c = 0; c < COLUMNS; c++) {
        const double x = ends[0][0] + ((double)c + 0.5) / COLUMNS * (ends[0][1] - ends[0][0]);
        const size_t column = nearest(places->x, places->columns, x), first = places->first[column];
        for (size_t r = 0; r < ROWS; r++) {
            const double y = ends[1][0] + ((double)r + 0.5) / ROWS * (ends[1][1] - ends[1][0]);
            values[c * ROWS + r] = points[first + nearest(places->y + first, places->first[column + 1] - first, y)].value;
        }
    }
}

enum bead_error bead_plane_make(struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                struct bead_graph_image *image, double ends[2][2], struct bead_message *msg)
{
    struct places places;
    double *values = NULL;
    qsort(points, count, sizeof *points, by_place);
    enum bead_error err = find_places(points, count, scales, &places, ends, msg);
    if (!err)
        err = bead_new(&values, (size_t)COLUMNS * ROWS, msg, "a plane");
    if (!err) {
        fill(points, &places, ends, values);
        *image = (struct bead_graph_image){.columns = COLUMNS, .rows = ROWS, .values = values, .low = INFINITY, .high = -INFINITY};
        for (size_t i = 0; i < count; i++) {
            image->low = fmin(image->low, points[i].value);
            image->high = fmax(image->high, points[i].value);
        }
        for (size_t k = 0; k < 2; k++) {
            double *middle = k ? image->y : image->x;
            const double half = (ends[k][1] - ends[k][0]) / (2 * (k ? ROWS : COLUMNS));
            middle[0] = back(scales[k], ends[k][0] + half);
            middle[1] = back(scales[k], ends[k][1] - half);
            ends[k][0] = back(scales[k], ends[k][0]);
            ends[k][1] = back(scales[k], ends[k][1]);
        }
    }
    free(places.x);
    free(places.first);
    return err;
}
