/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensors: the force at each over time, in one plot with the names at the curves. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/raster.h"
#include "render/stage/panel.h"
#include "render/view/horizon.h"
#include "render/view/sensor_curves.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/view_kinds.h"

/* In units of axis lines; of the label's font size. */
static const double curve_width = 2, strip = 1.5, sample_length = 1.6;

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;
    struct bead_rect plot;
    const struct bead_sensor *sensors;
    size_t count;
    double *values; /* of one time */
    struct bead_curves curves;
    struct bead_curves differences; /* from the comparison run's, with `trust` */
    double low, high;               /* N: range of the curves; the axis extends beyond it for the names */
    struct bead_axis force;
    double shown; /* s: drawn until here */
    bool drawn;
};

/* A sensor measures the bead force. In movies it shows the field of the other views and shares their range. */
static enum bead_field shown_field(const struct bead_view_setup *setup)
{
    return setup->fill && !bead_field_info(setup->field)->of_contacts ? setup->field : BEAD_FIELD_FORCE;
}

static unsigned sensors_fields(const struct bead_view_setup *setup)
{
    return BEAD_FIELD_BIT(shown_field(setup));
}

static void sensors_destroy(struct bead_view *v)
{
    if (!v)
        return;
    bead_curves_free(&v->curves);
    bead_curves_free(&v->differences);
    free(v->values);
    free(v);
}

static void set_ends(struct bead_view *view, double low, double high)
{
    view->low = fmin(0, low);
    view->high = high > view->low ? high : view->low + 1;
}

static enum bead_error sensors_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    *view = NULL;
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(setup->chain, &count);
    char place[128];
    if (count == 0)
        return bead_fail(msg, BEAD_ERROR_SCENE, "%sthere is no sensor to show; give a bead one: {bead: steel, sensor: first}",
                         bead_chain_place(setup->chain, "chain", place, sizeof place));
    BEAD_TRY(bead_new(view, 1, msg, "a plot of sensors"));
    struct bead_view *v = *view;
    BEAD_TRY(bead_new(&v->values, count, msg, "a plot of sensors"));
    v->setup = *setup;
    v->look = *setup->look;
    v->setup.look = &v->look;
    v->sensors = sensors;
    v->count = count;
    bead_curves_init(&v->curves, count, setup->time);
    bead_curves_init(&v->differences, count, setup->time);
    set_ends(v, setup->colours.low, setup->colours.high);
    return BEAD_OK;
}

static void sensors_extremes(const struct bead_view *view, double *low, double *high)
{
    *low = view->curves.low;
    *high = view->curves.high;
}

/* Sets the ends of the axis of forces, which until then are the setup's range of colours. */
static void sensors_set_range(struct bead_view *view, const struct bead_colours *, const double values[2])
{
    set_ends(view, values[0], values[1]);
}

static enum bead_error sensors_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *, struct bead_message *)
{
    v->plot = plot;
    return BEAD_OK;
}

/* Adds the force at each sensor, less that of the comparison run (NULL: the force itself). */
static enum bead_error add_forces(struct bead_view *v, struct bead_curves *curves, double time, const double *force,
                                  const double *comparison, struct bead_message *msg)
{
    BEAD_TRY(bead_curves_reserve(curves, msg));
    for (size_t k = 0; k < v->count; k++)
        v->values[k] = force[v->sensors[k].bead] - (comparison ? comparison[v->sensors[k].bead] : 0);
    bead_curves_add(curves, time, v->values);
    return BEAD_OK;
}

static enum bead_error sensors_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    const enum bead_field field = shown_field(&v->setup);
    const double *force = sample->field[field], *comparison = sample->comparison[field];
    if (!force)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "sensors need the field %s", bead_field_info(field)->name);
    if (v->setup.trust && !comparison)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no comparison run");
    BEAD_TRY(add_forces(v, &v->curves, sample->time, force, NULL, msg));
    return v->setup.trust ? add_forces(v, &v->differences, sample->time, force, comparison, msg) : BEAD_OK;
}

/* The first time at which a force differs from the comparison run's by more than a hundredth of the axis's range. */
static double sensors_horizon(struct bead_view *v)
{
    double threshold = BEAD_HORIZON_PART * (v->high - v->low);
    for (size_t s = 0; s < v->differences.count; s++) {
        const struct bead_stretch *stretch = v->differences.stretch + s * v->count;
        for (size_t k = 0; k < v->count; k++) {
            if (fmax(-stretch[k].low.value, stretch[k].high.value) > threshold)
                return stretch[k].first.time;
        }
    }
    return INFINITY;
}

/* ---- names ---- */

/* The place of a name: a row of `strip` px, from `x`. Rows are counted from the top of the plot. */
struct name {
    double x, width;
    char markup[128];
    int row;
};

static struct bead_text_style name_style(const struct bead_view *v)
{
    return (struct bead_text_style){
        .family = v->look.family, .size = v->look.label, .down = BEAD_ALIGN_MIDDLE, .across = BEAD_ALIGN_START};
}

/* Lays out the legend in rows of the plot's width: for each sensor a line and its name, or only its name in the line's colour.
 * Returns the number of rows. */
static int lay_out_names(const struct bead_view *v, cairo_t *cr, struct name *names, bool lines)
{
    double em = v->look.label, left = v->plot.x + 0.6 * em, x = left, height;
    struct bead_text_style style = name_style(v);
    int row = 0;
    for (size_t k = 0; k < v->count; k++) {
        bead_text_escape(v->sensors[k].name, names[k].markup, sizeof names[k].markup);
        bead_text_size(cr, &style, names[k].markup, &names[k].width, &height);
        double all = (lines ? (sample_length + 0.4) * em : 0) + names[k].width;
        if (x + all > v->plot.x + v->plot.width - 0.2 * em && x > left) {
            row++;
            x = left;
        }
        names[k].x = x;
        names[k].row = row;
        x += all + (lines ? 1.2 : 0.8) * em;
    }
    return row + 1;
}

static void sensors_draw_names(const struct bead_view *v, cairo_t *cr, const struct name *names, bool lines)
{
    double em = v->look.label;
    struct bead_text_style style = name_style(v);
    cairo_save(cr);
    cairo_rectangle(cr, v->plot.x, v->plot.y, v->plot.width, v->plot.height);
    cairo_clip(cr);
    for (size_t k = 0; k < v->count; k++) {
        double x = names[k].x, y = v->plot.y + (names[k].row + 0.65) * strip * em;
        struct bead_rgb colour = bead_look_curve(&v->look, k);
        if ((names[k].row + 1) * strip * em > v->plot.height) /* a name is whole or absent */
            continue;
        style.colour = lines ? v->look.ink : colour;
        if (lines) {
            cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
            cairo_set_line_width(cr, curve_width * v->look.line);
            cairo_move_to(cr, x, y);
            cairo_rel_line_to(cr, sample_length * em, 0);
            cairo_stroke(cr);
            x += (sample_length + 0.4) * em;
        }
        bead_text_draw(cr, &style, x, y, names[k].markup);
    }
    cairo_restore(cr);
}

/* The axis extends above the curves by the height of the rows of names, at most half of the plot. */
static void make_force_axis(struct bead_view *v, int rows)
{
    double taken = fmin((rows + 0.15) * strip * v->look.label / v->plot.height, 0.5);
    double high = v->low + (v->high - v->low) * 1.03 / (1 - taken);
    bead_axis_make(&v->force, v->low, high, bead_field_info(shown_field(&v->setup))->unit, BEAD_SCALE_LINEAR, v->plot.height,
                   v->look.tick, false);
}

static enum bead_error sensors_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *msg)
{
    struct name *names;
    BEAD_TRY(bead_new(&names, v->count, msg, "names of sensors"));
    bool lines = lay_out_names(v, cr, names, true) == 1;
    make_force_axis(v, lay_out_names(v, cr, names, lines));
    if (v->look.dark)
        bead_panel_fill(cr, &v->setup, v->plot);
    sensors_draw_names(v, cr, names, lines);
    free(names);
    if (!v->setup.axes)
        return BEAD_OK;
    struct bead_axis time;
    bead_axis_make(&time, v->setup.time[0], v->setup.time[1], "s", BEAD_SCALE_LINEAR, v->plot.width, v->look.tick, true);
    if (!v->look.dark)
        bead_box_draw(cr, &v->look, v->plot);
    bead_panel_axis(cr, &v->setup, &v->force, v->plot, false, bead_field_info(shown_field(&v->setup))->title);
    bead_panel_time_axis(cr, &v->setup, &time, v->plot);
    return BEAD_OK;
}

/* ---- curves ---- */

static double x_of(const struct bead_view *v, double time)
{
    return v->plot.x + (time - v->setup.time[0]) / (v->setup.time[1] - v->setup.time[0]) * v->plot.width;
}

static double sensors_y_of(const struct bead_view *v, double value)
{
    return v->plot.y + (1 - bead_axis_place(&v->force, value)) * v->plot.height;
}

static void line_to(const struct bead_view *v, cairo_t *cr, struct bead_point point)
{
    cairo_line_to(cr, x_of(v, point.time), sensors_y_of(v, point.value));
}

/* The curve is straight between samples: finds its point between two. */
static struct bead_point between(struct bead_point a, struct bead_point b, double time)
{
    return (struct bead_point){time, a.value + (b.value - a.value) * (time - a.time) / (b.time - a.time)};
}

/* The path of a curve from the last point before one time to another time. */
static void trace(const struct bead_view *v, cairo_t *cr, size_t curve, double from, double to)
{
    struct bead_point points[4], before = {-INFINITY, 0};
    cairo_new_path(cr);
    for (size_t s = 0; s < v->curves.count && before.time < to; s++) {
        const size_t count = bead_curves_points(&v->curves, s, curve, points);
        for (size_t i = 0; i < count && before.time < to; i++) {
            const bool begins = before.time < from && points[i].time >= from && isfinite(before.time);
            if (begins)
                line_to(v, cr, before);
            if (points[i].time > to && isfinite(before.time))
                points[i] = between(before, points[i], to);
            before = points[i];
            if (before.time >= from && before.time <= to)
                line_to(v, cr, before);
        }
    }
}

/* Draws the curves from one time to another; the caller clips them to the plot. */
static void paint_curves(const struct bead_view *v, cairo_t *cr, double from, double to)
{
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cr, curve_width * v->look.line);
    for (size_t k = 0; k < v->count; k++) {
        struct bead_rgb colour = bead_look_curve(&v->look, k);
        trace(v, cr, k, from, to);
        cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
        cairo_stroke(cr);
    }
}

/* Draws a line, below the curves, where they stop being predictable. */
static void paint_horizon(struct bead_view *v, cairo_t *cr)
{
    double time = v->setup.trust ? sensors_horizon(v) : INFINITY;
    if (!(time <= v->setup.time[1]))
        return;
    cairo_new_path(cr);
    double line = v->look.line; /* covers whole pixels */
    cairo_move_to(cr, round(x_of(v, time) - line / 2) + line / 2, v->plot.y);
    cairo_rel_line_to(cr, 0, v->plot.height);
    bead_horizon_stroke(cr, &v->look);
}

static void clip(cairo_t *cr, struct bead_rect rect)
{
    cairo_rectangle(cr, rect.x, rect.y, rect.width, rect.height);
    cairo_clip(cr);
}

/* Stills show all times, movies times up to the present. */
static double until(const struct bead_view *v, double time)
{
    return v->setup.fill ? time : INFINITY;
}

/* Pixel columns that lines from one time to another may touch. */
static struct bead_rect touched(const struct bead_view *v, double from, double to)
{
    double margin = curve_width * v->look.line + 1;
    double left = fmax(v->plot.x, floor(x_of(v, from) - margin));
    double right = fmin(v->plot.x + v->plot.width, ceil(x_of(v, to) + margin));
    return (struct bead_rect){(int)left, v->plot.y, (int)fmax(0, right - left), v->plot.height};
}

static enum bead_error sensors_draw(struct bead_view *v, double time, struct bead_frame *frame, const struct bead_frame *background,
                                    struct bead_changes *changes, struct bead_message *msg)
{
    double to = fmin(until(v, time), v->setup.time[1]), from = v->drawn ? v->shown : v->setup.time[0];
    if (v->drawn && to <= v->shown)
        return BEAD_OK;
    struct bead_rect rect = touched(v, from, to);
    if (background && v->setup.fill)
        bead_frame_copy(frame, background, rect);
    cairo_t *cr = bead_raster_begin(frame);
    clip(cr, rect);
    paint_horizon(v, cr);
    double margin = (v->setup.time[1] - v->setup.time[0]) * (4 * curve_width * v->look.line + 4) / v->plot.width;
    paint_curves(v, cr, from - margin, until(v, time));
    bead_changes_add(changes, rect);
    v->shown = to;
    v->drawn = true;
    return bead_raster_end(cr, "curves of sensors", msg);
}

static enum bead_error sensors_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *)
{
    cairo_save(cr);
    clip(cr, v->plot);
    paint_horizon(v, cr);
    paint_curves(v, cr, -INFINITY, until(v, time));
    cairo_restore(cr);
    return BEAD_OK;
}

const struct bead_view_type bead_view_sensors_type = {
    .info = &bead_view_infos[BEAD_VIEW_SENSORS],
    .fields = sensors_fields,
    .create = sensors_create,
    .place = sensors_place,
    .decorate = sensors_decorate,
    .feed = sensors_feed,
    .draw = sensors_draw,
    .vector = sensors_vector,
    .destroy = sensors_destroy,
    .extremes = sensors_extremes,
    .set_range = sensors_set_range,
    .horizon = sensors_horizon,
};
