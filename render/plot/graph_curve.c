/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws the curves, points, bands and error bars of a panel. */
#include <assert.h>
#include <math.h>

#include "render/plot/graph_private.h"

/* In units of the label's font size. */
static const double point_radius = 0.24, cap = 0.16, curve_width = 0.09;
/* In radii of a mark: marks on a curve with points closer than the first are placed the second apart. */
static const double least_spacing = 2.6, thinned_spacing = 16;
/* The marks of a single curve first shrink to this. */
static const double least_mark = 0.6;
/* With more points than this, points of a cloud become smaller. */
static const double many_points = 150;
static const double paleness = 0.55, faint_paleness = 0.35, band_paleness = 0.22;
/* Points of equal x are spread over this part of the way to the next x. */
static const double jitter_share = 0.55, most_jitter = 1.6; /* most_jitter in units of the label's font size */
static const double full_turn = 6.283185307179586;

/* ---- points ---- */

/* Corners on a circle of radius 1, rotated by `turn` of a full turn; a shape without corners is a circle. */
static const struct shape {
    int corners;
    double turn, size;
    bool hollow, cross;
    double dent; /* > 0: radius of every other corner */
} shapes[] = {{0, 0, 1, false, false, 0},   {4, 0.125, 1.2, false, false, 0}, {3, 0.75, 1.3, false, false, 0},
              {4, 0, 1.3, false, false, 0}, {3, 0.25, 1.3, false, false, 0},  {10, 0.75, 1.5, false, false, 0.4},
              {0, 0, 1, true, false, 0},    {4, 0.125, 1.2, false, true, 0}};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

static_assert((int)SHAPES >= BEAD_SHAPES, "shapes of marks");

static void curve_outline(cairo_t *cr, const struct shape *shape, double x, double y, double radius)
{
    cairo_new_path(cr);
    if (shape->corners == 0)
        cairo_arc(cr, x, y, radius, 0, full_turn);
    for (int i = 0; i < shape->corners; i++) {
        double angle = full_turn * (shape->turn + (double)i / shape->corners);
        double far = shape->dent > 0 && i % 2 ? shape->dent * radius : radius;
        double px = x + far * cos(angle), py = y + far * sin(angle);
        if (shape->cross)
            cairo_move_to(cr, x, y);
        cairo_line_to(cr, px, py);
    }
    if (!shape->cross)
        cairo_close_path(cr);
}

static struct bead_rgb ink_of(const struct bead_look *look, const struct bead_series *series)
{
    struct bead_rgb ink = bead_look_curve(look, series->colour);
    return series->faint ? bead_rgb_mix(bead_look_ground(look), ink, faint_paleness) : ink;
}

void graph_draw_point(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, double x, double y, double size)
{
    const struct shape *shape = &shapes[series->shape % SHAPES];
    bool hollow = shape->hollow || series->hollow;
    struct bead_rgb ink = ink_of(look, series);
    curve_outline(cr, shape, x, y, shape->size * size);
    if (!shape->cross) {
        bead_rgb_set(cr, hollow ? bead_look_ground(look) : ink);
        cairo_fill_preserve(cr);
    }
    bead_rgb_set(cr, ink);
    cairo_set_line_width(cr, shape->cross ? 1.5 * look->line : fmin(look->line, 0.5 * size));
    cairo_set_dash(cr, NULL, 0, 0);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(cr);
}

/* ---- places ---- */

static double px_x(const struct graph_cell *cell, double value)
{
    return cell->plot.x + bead_axis_place(&cell->axis[0], value) * cell->plot.width;
}

static double px_y(const struct graph_cell *cell, double value)
{
    return cell->plot.y + (1 - bead_axis_place(&cell->axis[1], value)) * cell->plot.height;
}

static bool is_there(const struct graph_cell *cell, const struct bead_series *series, size_t i)
{
    return isfinite(series->y[i]) && isfinite(bead_axis_place(&cell->axis[0], series->x[i]));
}

/* -1: left of or below the axis, 1: right of or above it, 0: on it. */
static int beyond(const struct bead_axis *axis, double value)
{
    double place = bead_axis_place(axis, value), slack = 1e-9;
    return place < -slack ? -1 : place > 1 + slack ? 1 : 0;
}

bool graph_series_end(const struct graph_cell *cell, const struct bead_series *series, double end[2])
{
    const double right = cell->plot.x + cell->plot.width, bottom = cell->plot.y + cell->plot.height, slack = 1e-6;
    double beyond[2] = {INFINITY, 0};
    for (size_t i = series->count; i-- > 0;) {
        end[0] = px_x(cell, series->x[i]);
        end[1] = px_y(cell, series->y[i]);
        if (is_there(cell, series, i) && end[0] <= right + slack) {
            const double part = (right - end[0]) / (beyond[0] - end[0]); /* cut off by the frame; 0: it ends before */
            end[0] = part > 0 ? right : end[0];
            end[1] += part * (beyond[1] - end[1]);
            return end[1] >= cell->plot.y - slack && end[1] <= bottom + slack;
        }
        if (is_there(cell, series, i))
            memcpy(beyond, end, sizeof beyond);
    }
    return false;
}

/* ---- lines ---- */

/* Lines are cut off far outside the plot: cairo's fixed-point numbers would overflow. */
struct pen {
    cairo_t *cr;
    double low[2], high[2]; /* px: the box kept */
    double last[2];
    bool down, drawn; /* there is a last point; the path ends there */
};

/* The part of the segment a..b within the pen's box, as fractions of its length. */
static bool cut(const struct pen *pen, const double a[2], const double b[2], double part[2])
{
    part[0] = 0;
    part[1] = 1;
    for (int i = 0; i < 2; i++) {
        double way = b[i] - a[i];
        if (way == 0 && (a[i] < pen->low[i] || a[i] > pen->high[i]))
            return false;
        if (way == 0)
            continue;
        double in = (pen->low[i] - a[i]) / way, out = (pen->high[i] - a[i]) / way;
        part[0] = fmax(part[0], fmin(in, out));
        part[1] = fmin(part[1], fmax(in, out));
    }
    return part[0] <= part[1];
}

static void line_to(struct pen *pen, double x, double y)
{
    double to[2] = {x, y}, part[2];
    if (pen->down && cut(pen, pen->last, to, part)) {
        double wx = x - pen->last[0], wy = y - pen->last[1];
        if (!pen->drawn || part[0] > 0)
            cairo_move_to(pen->cr, pen->last[0] + part[0] * wx, pen->last[1] + part[0] * wy);
        cairo_line_to(pen->cr, pen->last[0] + part[1] * wx, pen->last[1] + part[1] * wy);
        pen->drawn = part[1] >= 1;
    } else {
        pen->drawn = false;
    }
    pen->down = true;
    pen->last[0] = x;
    pen->last[1] = y;
}

/* The first, lowest, highest and last of many points in a column of pixels give the same picture as all of them. */
struct column {
    struct px {
        double x, y;
    } first, last, low, high;
    size_t count;
    bool low_first;
};

static void flush(struct pen *pen, struct column *column)
{
    if (column->count > 0)
        line_to(pen, column->first.x, column->first.y);
    if (column->count > 2) {
        struct px a = column->low_first ? column->low : column->high, b = column->low_first ? column->high : column->low;
        line_to(pen, a.x, a.y);
        line_to(pen, b.x, b.y);
    }
    if (column->count > 1)
        line_to(pen, column->last.x, column->last.y);
    column->count = 0;
}

static void curve_gather(struct pen *pen, struct column *column, struct px at)
{
    if (column->count > 0 && floor(at.x) != floor(column->first.x))
        flush(pen, column);
    if (column->count++ == 0) {
        *column = (struct column){at, at, at, at, 1, true};
        return;
    }
    if (at.y < column->low.y) {
        column->low = at;
        column->low_first = false;
    } else if (at.y > column->high.y) {
        column->high = at;
        column->low_first = true;
    }
    column->last = at;
}

/* Does the line to point i lie on an earlier curve's, whose marks alternate with this one's? Then one line is enough, since dashes
 * on dashes of other colours look like neither. */
static bool is_under_another(const struct graph_cell *cell, const struct bead_series *series, size_t i)
{
    const struct bead_panel *panel = cell->panel;
    const double close = 0.002 * cell->plot.height;
    bool under = false;
    for (size_t s = 0; !under && i > 0 && &panel->series[s] != series && s < panel->series_count; s++) {
        const struct bead_series *other = &panel->series[s];
        under = other->mark == BEAD_MARK_LINE_POINTS && !other->faint && i < other->count;
        for (size_t k = i - 1; under && k <= i; k++)
            under = other->x[k] == series->x[k] && fabs(px_y(cell, other->y[k]) - px_y(cell, series->y[k])) <= close;
    }
    return under;
}

static void trace(cairo_t *cr, const struct graph_cell *cell, const struct bead_series *series, double margin)
{
    const struct bead_rect *plot = &cell->plot;
    struct pen pen = {cr,
                      {plot->x - margin, plot->y - margin},
                      {plot->x + plot->width + margin, plot->y + plot->height + margin},
                      {0, 0},
                      false,
                      false};
    struct column column = {0};
    bool dense = series->count > 4 * (size_t)plot->width;
    cairo_new_path(cr);
    for (size_t i = 0; i < series->count; i++) {
        double y = px_y(cell, series->y[i]);
        if (!is_there(cell, series, i) || !isfinite(y)) {
            flush(&pen, &column);
            pen.down = pen.drawn = false;
        } else if (dense) {
            curve_gather(&pen, &column, (struct px){px_x(cell, series->x[i]), y});
        } else {
            if (series->mark == BEAD_MARK_LINE_POINTS && !series->faint && is_under_another(cell, series, i))
                pen.down = pen.drawn = false;
            line_to(&pen, px_x(cell, series->x[i]), y);
        }
    }
    flush(&pen, &column);
}

double graph_full_point(const struct bead_look *look)
{
    return point_radius * look->label;
}

/* The spacing of neighbouring points, if they are evenly spaced along the axis. */
static double spacing_of(const struct graph_cell *cell, const struct bead_series *series)
{
    return series->count > 1 ? cell->plot.width / (double)(series->count - 1) : cell->plot.width;
}

/* The position of the series among the panel's curves with marks; *count: their number. */
static size_t turn_of(const struct bead_panel *panel, const struct bead_series *series, size_t *count)
{
    size_t turn = 0;
    *count = 0;
    for (size_t s = 0; s < panel->series_count; s++) {
        turn = &panel->series[s] == series ? *count : turn;
        *count += panel->series[s].mark == BEAD_MARK_LINE_POINTS;
    }
    return turn;
}

struct graph_thinning graph_thin(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series)
{
    double spacing = spacing_of(cell, series), radius = graph_full_point(look);
    size_t curves, turn = turn_of(cell->panel, series, &curves);
    if (series->mark != BEAD_MARK_LINE_POINTS || spacing >= least_spacing * radius * (curves > 1 ? 1 : least_mark))
        return (struct graph_thinning){1, 0};
    size_t every = (size_t)ceil(thinned_spacing * radius / spacing);
    return (struct graph_thinning){every, (2 * turn + 1) * every / (2 * curves)};
}

bool graph_is_guide(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series)
{
    return series->mark == BEAD_MARK_LINE_POINTS && graph_thin(cell, look, series).every == 1;
}

static bool is_rising(const struct bead_series *series)
{
    for (size_t i = 1; i < series->count; i++) {
        if (!(series->x[i] > series->x[i - 1]))
            return false;
    }
    return true;
}

bool graph_look_alike(const struct bead_series *a, const struct bead_series *b)
{
    return a->mark == b->mark && a->colour == b->colour && a->shape == b->shape && a->dash == b->dash && a->faint == b->faint &&
           a->hollow == b->hollow;
}

size_t graph_cloud(const struct bead_series *series)
{
    return series->mark == BEAD_MARK_POINTS && !is_rising(series) ? series->count : 0;
}

double graph_point_size(const struct bead_series *series, const struct graph_cell *cell, const struct bead_look *look)
{
    double size = graph_full_point(look), least = fmax(0.7 * look->line, 0.4 * size);
    if (graph_cloud(series) > 0)
        return fmax(least, size * fmin(1, sqrt(many_points / (double)(cell->most_points + 1))));
    double alone = fmin(size, spacing_of(cell, series) / least_spacing); /* side by side */
    if (graph_thin(cell, look, series).every > 1)
        return size;
    return series->mark == BEAD_MARK_POINTS ? fmax(0.5 * least, alone) : fmax(least_mark * size, alone);
}

void graph_stroke_style(cairo_t *cr, const struct bead_look *look, const struct bead_series *series, bool guide)
{
    const struct bead_dashes *pattern = bead_look_dashes(series->dash);
    double width = series->faint || guide ? look->line : fmax(1.5 * look->line, curve_width * look->label), lengths[6];
    struct bead_rgb ink = ink_of(look, series);
    for (int i = 0; i < pattern->count; i++)
        lengths[i] = width * pattern->lengths[i];
    bead_rgb_set(cr, guide && !series->faint ? bead_rgb_mix(bead_look_ground(look), ink, paleness) : ink);
    cairo_set_line_width(cr, width);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cr, lengths, pattern->count, 0);
}

struct bead_rgb graph_band_colour(const struct bead_look *look, const struct bead_series *series)
{
    return bead_rgb_mix(bead_look_ground(look), bead_look_curve(look, series->colour), band_paleness);
}

/* ---- error bars ---- */

static void curve_draw_bar(cairo_t *cr, const struct graph_cell *cell, double x, double low, double high, double half)
{
    double bottom = cell->plot.y + cell->plot.height, top = cell->plot.y;
    double from = px_y(cell, low), to = px_y(cell, high);
    bool open_low = !(from <= bottom), open_high = !(to >= top); /* beyond the axis; below a logarithmic one at infinity */
    from = open_low ? bottom : fmax(from, top);
    to = open_high ? top : fmin(to, bottom);
    if (to > from || (open_low && to >= bottom) || (open_high && from <= top))
        return;
    cairo_move_to(cr, x, from);
    cairo_line_to(cr, x, to);
    for (int end = 0; end < 2; end++) {
        if (end ? open_high : open_low)
            continue;
        cairo_move_to(cr, x - half, end ? to : from);
        cairo_rel_line_to(cr, 2 * half, 0);
    }
}

/* Strokes a path that may lie on any colour of an image, with an edge like the page. */
static void stroke_over(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, struct bead_rgb ink, double width)
{
    if (cell->panel->image) {
        bead_rgb_set(cr, bead_look_ground(look));
        cairo_set_line_width(cr, width + 2 * look->line);
        cairo_stroke_preserve(cr);
    }
    bead_rgb_set(cr, ink);
    cairo_set_line_width(cr, width);
    cairo_stroke(cr);
}

static void draw_bars(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series)
{
    cairo_new_path(cr);
    for (size_t i = 0; i < series->count; i++) {
        double error = series->error[i];
        if (!is_there(cell, series, i) || !(error > 0) || beyond(&cell->axis[0], series->x[i]) != 0)
            continue;
        curve_draw_bar(cr, cell, px_x(cell, series->x[i]), series->y[i] - error, series->y[i] + error, cap * look->label);
    }
    cairo_set_dash(cr, NULL, 0, 0);
    stroke_over(cr, look, cell, ink_of(look, series), look->line);
}

/* ---- a series ---- */

/* Draws an arrow at the frame for a point beyond it. */
static void draw_arrow(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series,
                       double x, double size, bool up)
{
    double tip = up ? cell->plot.y : cell->plot.y + cell->plot.height, length = up ? 1.6 * size : -1.6 * size;
    cairo_new_path(cr);
    cairo_move_to(cr, x - size, tip + length);
    cairo_line_to(cr, x + size, tip + length);
    cairo_line_to(cr, x, tip);
    cairo_close_path(cr);
    bead_rgb_set(cr, ink_of(look, series));
    cairo_set_line_width(cr, fmin(look->line, 0.5 * size));
    cairo_set_dash(cr, NULL, 0, 0);
    if (!series->hollow)
        cairo_fill_preserve(cr);
    cairo_stroke(cr);
}

/* Sideways offset of a point: multiples of the golden ratio spread any number of points of equal x evenly. */
static double aside(const struct graph_cell *cell, const struct bead_look *look, const struct bead_series *series, size_t i)
{
    static const double golden = 0.6180339887498949;
    size_t from = i, to = i + 1;
    while (from > 0 && series->x[from - 1] == series->x[i])
        from--;
    while (to < series->count && series->x[to] == series->x[i])
        to++;
    double next = to < series->count ? px_x(cell, series->x[to]) - px_x(cell, series->x[i])
                  : from > 0         ? px_x(cell, series->x[i]) - px_x(cell, series->x[from - 1])
                                     : 0;
    double x = px_x(cell, series->x[i]), frame = fmin(x - cell->plot.x, cell->plot.x + cell->plot.width - x);
    double width = fmin(fmin(jitter_share * fabs(next), most_jitter * look->label), 2 * fmax(frame, 0));
    return to - from < 2 ? 0 : width * (fmod(golden * (double)(i - from + 1), 1) - 0.5);
}

static void draw_points(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series)
{
    double size = graph_point_size(series, cell, look);
    struct graph_thinning thin = graph_thin(cell, look, series);
    for (size_t i = thin.first; i < series->count; i += thin.every) {
        if (!is_there(cell, series, i) || beyond(&cell->axis[0], series->x[i]) != 0)
            continue;
        int off = beyond(&cell->axis[1], series->y[i]);
        double x = px_x(cell, series->x[i]) + (series->jitter ? aside(cell, look, series, i) : 0);
        if (off == 0)
            graph_draw_point(cr, look, series, x, px_y(cell, series->y[i]), size);
        else if (series->arrows)
            draw_arrow(cr, look, cell, series, x, size, off > 0);
    }
}

/* Fills from y to the upper values, between thin lines of the series' dashes. */
static void draw_band(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series)
{
    struct bead_series edge = *series;
    const double *edges[] = {series->y, series->upper};
    cairo_new_path(cr);
    for (size_t i = 0; i < series->count; i++)
        cairo_line_to(cr, px_x(cell, series->x[i]), px_y(cell, series->y[i]));
    for (size_t i = series->count; i-- > 0;)
        cairo_line_to(cr, px_x(cell, series->x[i]), px_y(cell, series->upper[i]));
    cairo_close_path(cr);
    bead_rgb_set(cr, graph_band_colour(look, series));
    cairo_fill(cr);
    for (int k = 0; k < 2; k++) {
        edge.y = edges[k];
        trace(cr, cell, &edge, 8 * look->line);
        graph_stroke_style(cr, look, &edge, true);
        cairo_stroke(cr);
    }
}

static void draw_line(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series)
{
    trace(cr, cell, series, 8 * look->line);
    graph_stroke_style(cr, look, series, !cell->panel->image && graph_is_guide(cell, look, series));
    if (cell->undashed)
        cairo_set_dash(cr, NULL, 0, 0);
    if (cell->panel->image)
        stroke_over(cr, look, cell, ink_of(look, series), cairo_get_line_width(cr));
    else
        cairo_stroke(cr);
}

void graph_draw_series(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_series *series)
{
    const struct bead_rect *plot = &cell->plot;
    cairo_save(cr);
    cairo_rectangle(cr, plot->x, plot->y, plot->width, plot->height);
    cairo_clip(cr);
    if (series->mark == BEAD_MARK_BAND)
        draw_band(cr, look, cell, series);
    else if (series->mark != BEAD_MARK_POINTS)
        draw_line(cr, look, cell, series);
    if (series->error)
        draw_bars(cr, look, cell, series);
    cairo_restore(cr);
    if (series->mark == BEAD_MARK_POINTS || series->mark == BEAD_MARK_LINE_POINTS) /* not clipped at the frame */
        draw_points(cr, look, cell, series);
}
