/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View: the field along the chain, as a smooth line over a filled area, with dots at the beads if they fit. The view of one chain
 * can also draw other chains' curves, on one axis. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/smooth_curve.h"
#include "render/stage/along.h"
#include "render/stage/camera.h"
#include "render/stage/latest.h"
#include "render/stage/moving_labels.h"
#include "render/stage/panel.h"
#include "render/view/profile_hold.h"
#include "render/view/profile_scan.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/chain/system.h"
#include "sim/kinds/view_kinds.h"

/* Heights are rounded to this fraction of a pixel; smaller motion is not redrawn. */
static const double steps_per_pixel = 32;
/* Dots at the values, in units of the curve's width: radius, and the least distance between values with dots. */
static const double dot_size = 1.5, dot_room = 7;
static const double area_alpha = 0.26, shared_alpha = 0.12;
enum { MOST_SPANS = 8, MERGE_GAP = 12, MOST_OTHERS = 15 };

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;
    size_t first, count; /* values shown */
    bool fixed;          /* the first and the last are a string's fixed ends: 0 */
    double *numbers;     /* memory of `value` and `place` */
    double *value[2];
    struct bead_latest latest;
    float *pixels;        /* memory of x, y, old_y, held, old_held */
    float *x, *y, *old_y; /* px of the plot, of the values */
    float *sx, *sy;       /* of the curve through them, in one piece of memory */
    size_t points;        /* of the curve, as of now */
    unsigned parts;       /* of the curve in each gap between values */
    float dots;           /* px: radius; 0: none */
    double *place;        /* m along the chain: with a camera */
    double left;          /* m: the camera's left edge as drawn last */
    size_t from, to;      /* values in the plot, and one more on each side; `to` exclusive */
    struct bead_moving_labels *labels;
    struct bead_axis axis;
    double base;                           /* value where the area ends */
    double ends[2];                        /* of the axis along the chain, in its units */
    struct bead_view *others[MOST_OTHERS]; /* borrowed: drawn with this one */
    size_t other_count;
    struct bead_hold *hold; /* NULL: nothing is kept */
    float *held, *old_held; /* px of the plot: the largest values so far */
    uint8_t *changed;       /* [plot.width]: columns to be drawn again */
    struct bead_rect plot;
    bool drawn;
};

static unsigned profile_fields(const struct bead_view_setup *setup)
{
    return BEAD_FIELD_BIT(setup->field);
}

static void profile_destroy(struct bead_view *v)
{
    if (!v)
        return;
    free(v->numbers);
    free(v->pixels);
    free(v->sx);
    free(v->changed);
    bead_moving_labels_destroy(v->labels);
    bead_hold_destroy(v->hold);
    free(v);
}

/* Values on one side of that at rest, in films that show all beads. */
static bool holds(const struct bead_view_setup *setup)
{
    const bool contacts = bead_chain_spec(setup->chain)->system->has_contacts, one_side = setup->colours.low >= setup->colours.rest;
    return (setup->hold || setup->cells) && setup->fill && contacts && one_side && !setup->camera;
}

static enum bead_error profile_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    size_t n = setup->beads.last - setup->beads.first + 1;
    BEAD_TRY(bead_new(view, 1, msg, "a profile"));
    struct bead_view *v = *view;
    v->setup = *setup;
    v->look = *setup->look;
    v->setup.look = &v->look;
    v->first = setup->beads.first;
    v->fixed = bead_along_fixed(setup) && (setup->field == BEAD_FIELD_DISPLACEMENT || setup->field == BEAD_FIELD_VELOCITY);
    n += 2 * v->fixed;
    v->count = v->to = n;
    BEAD_TRY(bead_new(&v->numbers, 3 * n, msg, "a profile of %zu beads", n));
    BEAD_TRY(bead_new(&v->pixels, 5 * n, msg, "a profile of %zu beads", n));
    v->value[0] = v->numbers;
    v->value[1] = v->numbers + n;
    v->place = v->numbers + 2 * n;
    v->x = v->pixels;
    v->y = v->pixels + n;
    v->old_y = v->pixels + 2 * n;
    v->held = v->pixels + 3 * n;
    v->old_held = v->pixels + 4 * n;
    if (holds(setup))
        BEAD_TRY(bead_hold_create(setup->chain, setup->beads, &v->hold, msg));
    return BEAD_OK;
}

/* The axis spans the range of the colours, with some air above the highest value. */
static void profile_make_axis(struct bead_view *v)
{
    const struct bead_colours *colours = &v->setup.colours;
    enum bead_scale scale = colours->scale == BEAD_SCALE_LOG ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR;
    double low = colours->low, high = colours->high, air = 0.04 * (high - low);
    if (scale == BEAD_SCALE_LINEAR) {
        high += air;
        low -= low < 0 || colours->rest > 0 ? air : 0;
    }
    bead_axis_make(&v->axis, low, high, bead_chain_field(v->setup.chain, v->setup.field)->unit, scale, v->plot.height, v->look.tick,
                   false);
    v->base = scale == BEAD_SCALE_LOG ? low : fmin(high, fmax(low, colours->rest));
}

/* Width of the curve, px. */
static double line_width(const struct bead_view *v)
{
    return fmax(1.6, 1.8 * v->look.line);
}

static float profile_y_of(const struct bead_view *v, double value)
{
    double place = bead_axis_place(&v->axis, value), line = 0.5 * v->look.line;
    place = place > -0.01 ? fmin(place, 1.2) : -0.01; /* minus infinity on a logarithmic axis, and NaN */
    double y = line + (1 - place) * (v->plot.height - 2 * line);
    return (float)(round(y * steps_per_pixel) / steps_per_pixel);
}

/* Places of values along the chain: a contact is to the right of its bead. */
static void profile_find_places(struct bead_view *v)
{
    const struct bead_chain *chain = v->setup.chain;
    bool contacts = bead_field_info(v->setup.field)->of_contacts;
    for (size_t i = 0; i < v->count; i++) {
        size_t bead = v->first + i;
        v->place[i] = bead_chain_position(chain)[bead] + (contacts ? bead_chain_radius(chain)[bead] : 0);
    }
}

/* Finds x of all values from the camera's window, and the range of those in the plot. */
static void profile_follow(struct bead_view *v)
{
    double left = bead_camera_left(v->setup.camera), scale = v->plot.width / bead_camera_width(v->setup.camera);
    size_t from = v->count, to = 0;
    for (size_t i = 0; i < v->count; i++) {
        double x = (v->place[i] - left) * scale;
        v->x[i] = (float)x;
        if (x < 0 || x > v->plot.width)
            continue;
        from = i < from ? i : from;
        to = i + 1;
    }
    v->from = from > 0 && from < to ? from - 1 : 0;
    v->to = to < v->count ? to + 1 : v->count;
    v->drawn = v->drawn && left == v->left;
    v->left = left;
}

/* Curve `k` of the plot: the view's own, then the others'. */
static struct bead_view *curve_at(struct bead_view *v, size_t k)
{
    return k == 0 ? v : v->others[k - 1];
}

static enum bead_error profile_overlay(struct bead_view *v, struct bead_view *other, struct bead_message *msg)
{
    if (v->other_count == MOST_OTHERS)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "an overlay shows at most %d chains", MOST_OTHERS + 1);
    v->others[v->other_count++] = other;
    return BEAD_OK;
}

static struct bead_chain_axis profile_along(const struct bead_view *v)
{
    return bead_chain_axis(v->setup.chain, bead_field_info(v->setup.field)->of_contacts);
}

/* Finds the ends of an axis for all curves. */
static void profile_find_ends(struct bead_view *v)
{
    v->ends[0] = INFINITY;
    v->ends[1] = -INFINITY;
    for (size_t k = 0; k <= v->other_count; k++) {
        const struct bead_view *curve = curve_at(v, k);
        const struct bead_chain_axis along = profile_along(curve);
        const double beyond = bead_along_fixed(&curve->setup) ? 1 : 0.5;
        v->ends[0] = fmin(v->ends[0], along.first + ((double)curve->setup.beads.first - beyond) * along.spacing);
        v->ends[1] = fmax(v->ends[1], along.first + ((double)curve->setup.beads.last + beyond) * along.spacing);
    }
}

/* Allocates the curve, once the distance between values is known. */
static enum bead_error profile_make_curve(struct bead_view *v, struct bead_message *msg)
{
    double width = v->setup.camera ? bead_camera_width(v->setup.camera) : 0, last = v->count > 1 ? (double)(v->count - 1) : 1;
    double pitch =
        width > 0 ? v->plot.width * (v->place[v->count - 1] - v->place[0]) / last / width : (v->x[v->count - 1] - v->x[0]) / last;
    v->parts = bead_smooth_parts(pitch);
    v->dots = (float)(pitch > dot_room * line_width(v) ? dot_size * line_width(v) : 0);
    const size_t points = v->count * v->parts + 1;
    BEAD_TRY(bead_new(&v->sx, 2 * points, msg, "a profile of %zu beads", v->count));
    v->sy = v->sx + points;
    return BEAD_OK;
}

/* Places the values on the axis of the view that draws them, `on`. */
static void profile_spread(struct bead_view *v, const struct bead_view *on)
{
    const struct bead_chain_axis along = profile_along(v);
    v->plot = on->plot;
    const bool uneven = on->other_count == 0 && bead_along_uneven(&v->setup, v->plot.width);
    profile_make_axis(v);
    for (size_t i = 0; i < v->count; i++) {
        const double number = (double)(v->first + i) - v->fixed, value = along.first + number * along.spacing;
        v->x[i] = (float)((value - on->ends[0]) / (on->ends[1] - on->ends[0]) * on->plot.width);
        if (on->other_count == 0) /* without rounding */
            v->x[i] = (float)(((double)i + 0.5) * on->plot.width / (double)v->count);
        if (uneven)
            v->x[i] = (float)(bead_along_place(&v->setup, number) * on->plot.width);
    }
}

static enum bead_error profile_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *, struct bead_message *msg)
{
    v->plot = plot;
    BEAD_TRY(bead_new(&v->changed, (size_t)plot.width + 1, msg, "a profile"));
    profile_find_ends(v);
    if (v->setup.camera)
        profile_find_places(v);
    for (size_t k = 0; k <= v->other_count; k++) {
        profile_spread(curve_at(v, k), v);
        BEAD_TRY(profile_make_curve(curve_at(v, k), msg));
    }
    return BEAD_OK;
}

/* Numbers below the plot move with the camera; their title is left of them. */
static enum bead_error move_labels(struct bead_view *v, cairo_t *cr, struct bead_message *msg)
{
    bead_panel_name(cr, &v->setup, NULL, v->plot, bead_field_info(v->setup.field)->of_contacts ? "contact" : "bead");
    struct bead_rect strip = {v->plot.x, v->plot.y + v->plot.height, v->plot.width, (int)ceil(1.8 * v->look.tick)};
    double width = bead_camera_width(v->setup.camera);
    BEAD_TRY(bead_moving_labels_create(&v->look, strip, v->plot.width / width, &v->labels, msg));
    return bead_moving_labels_count(v->labels, v->place, v->first, v->count, width, BEAD_LABEL_TICK, msg);
}

static enum bead_error profile_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_look *look = &v->look;
    struct bead_rect panel = bead_panel_rect(&v->setup, v->plot);
    double y = v->plot.y + profile_y_of(v, v->base);
    bead_panel_fill(cr, &v->setup, v->plot);
    cairo_set_source_rgba(cr, look->faint.r, look->faint.g, look->faint.b, 0.35);
    cairo_rectangle(cr, panel.x, round(y - 0.5 * look->line), panel.width, look->line);
    cairo_fill(cr);
    if (!v->setup.axes)
        return BEAD_OK;
    const struct bead_field_info *field = bead_chain_field(v->setup.chain, v->setup.field);
    const struct bead_rect bar = {panel.x - v->setup.coloured, panel.y, v->setup.coloured, panel.height};
    bead_colour_axis_draw(cr, look, &v->setup.colours, &v->axis, bar);
    bead_panel_axis(cr, &v->setup, &v->axis, v->plot, false, bead_field_short(field));
    if (v->hold && v->setup.hold)
        bead_panel_remark(cr, &v->setup, &v->axis, v->plot, bead_field_short(field), "faint: peak so far");
    if (v->setup.bead_labels && v->setup.camera)
        return move_labels(v, cr, msg);
    if (v->setup.bead_labels) {
        struct bead_axis beads;
        const struct bead_chain_axis along = profile_along(v);
        if (v->other_count == 0)
            (void)bead_along_axis(&beads, &v->setup, v->plot.width, look->tick, true);
        else
            bead_axis_make(&beads, v->ends[0], v->ends[1], along.unit, BEAD_SCALE_LINEAR, v->plot.width, look->tick, true);
        bead_panel_chain_axis(cr, &v->setup, &beads, v->plot, along.title);
    }
    return BEAD_OK;
}

static enum bead_error profile_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *field = sample->field[v->setup.field];
    if (!field)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a profile of %s needs that field", bead_field_info(v->setup.field)->name);
    bead_latest_feed(&v->latest, sample->time);
    memcpy(v->value[v->latest.newest] + v->fixed, field + v->first, (v->count - (size_t)(2 * v->fixed)) * sizeof(double));
    if (v->hold)
        bead_hold_feed(v->hold, sample->time, field + v->first);
    for (size_t i = 0; v->hold && v->setup.cells && i < v->count; i++)
        v->value[v->latest.newest][i] = bead_hold_passing(v->hold, i);
    return BEAD_OK;
}

static void profile_advance(struct bead_view *v, double time)
{
    double weight = bead_latest_weight(&v->latest, time);
    float *was = v->old_y;
    v->old_y = v->y;
    v->y = was;
    for (size_t i = 0; i < v->count; i++)
        v->y[i] = profile_y_of(v, bead_latest_value(&v->latest, v->value, i, weight));
    was = v->old_held;
    v->old_held = v->held;
    v->held = was;
    for (size_t i = 0; v->hold && v->setup.hold && i < v->count; i++)
        v->held[i] = profile_y_of(v, bead_hold_largest(v->hold, i));
}

/* Finds the curve through the values in the plot. Forces and other values on one side of that at rest stay there. */
static void profile_smooth(struct bead_view *v)
{
    float bottom = profile_y_of(v, v->base),
          lowest = v->axis.low < v->setup.colours.rest || v->axis.scale == BEAD_SCALE_LOG ? INFINITY : bottom;
    v->points = bead_smooth_fill(v->x, v->y, v->count, v->from, v->to, v->parts, v->fixed, -INFINITY, lowest, v->sx, v->sy);
    if (v->count > 1)
        return;
    v->sx[0] = 0; /* a level line */
    v->sx[1] = (float)v->plot.width;
    v->sy[1] = v->sy[0];
    v->points = 2;
}

static struct bead_curve profile_curve_of(const struct bead_view *v)
{
    struct bead_rgb colour = v->setup.own_colour ? bead_look_curve(&v->look, v->setup.chain_index) : v->look.accent;
    return (struct bead_curve){.x = v->sx,
                               .y = v->sy,
                               .count = v->points,
                               .base = profile_y_of(v, v->base),
                               .width = (float)line_width(v),
                               .line = colour,
                               .area = colour,
                               .area_alpha = v->setup.own_colour ? shared_alpha : area_alpha,
                               .dashes = v->setup.own_colour ? bead_look_dashes(v->setup.chain_index % BEAD_DASHES) : NULL,
                               .start = v->x[0]};
}

/* The largest values so far: a thin line, fainter than the curve. */
static struct bead_curve held_curve_of(const struct bead_view *v)
{
    static const double faint = 0.5;
    struct bead_curve curve = profile_curve_of(v);
    const struct bead_rgb *panel = &v->look.panel;
    curve.line = (struct bead_rgb){panel->r + faint * (curve.line.r - panel->r), panel->g + faint * (curve.line.g - panel->g),
                                   panel->b + faint * (curve.line.b - panel->b)};
    curve.x = v->x;
    curve.y = v->held;
    curve.count = v->count;
    curve.width = (float)fmax(1, 0.6 * curve.width);
    curve.area_alpha = 0;
    return curve;
}

static void draw_span(struct bead_view *v, int from, int to, struct bead_frame *frame, const struct bead_frame *background,
                      struct bead_changes *changes)
{
    for (size_t k = 0; k <= v->other_count; k++) {
        const struct bead_view *own = curve_at(v, k);
        struct bead_curve held = held_curve_of(own);
        if (own->hold && own->setup.hold)
            bead_curve_draw(&held, v->plot, from, to, frame, k == 0 ? background : NULL);
    }
    for (size_t k = 0; k <= v->other_count; k++) {
        const struct bead_view *own = curve_at(v, k);
        struct bead_curve curve = profile_curve_of(own);
        bead_curve_draw(&curve, v->plot, from, to, frame, k == 0 && !(own->hold && own->setup.hold) ? background : NULL);
        if (own->dots > 0) {
            curve.x = own->x + own->from + own->fixed;
            curve.y = own->y + own->from + own->fixed;
            curve.count = own->to - own->from - (size_t)(2 * own->fixed);
            bead_curve_dots(&curve, own->dots, v->plot, from, to, frame);
        }
    }
    if (changes)
        bead_changes_add(changes, (struct bead_rect){v->plot.x + from, v->plot.y, to - from, v->plot.height});
}

/* Marks the columns that changed values of the curve influence. */
static void find_changed(const struct bead_view *curve, bool all, uint8_t *changed)
{
    const struct bead_curve drawn = profile_curve_of(curve);
    int reach = bead_curve_reach(&drawn) + (int)ceilf(curve->dots), width = curve->plot.width;
    size_t gaps = curve->parts > 1 ? BEAD_SMOOTH_REACH : 1;
    for (size_t i = 0; i < curve->count; i++) {
        if ((!all && curve->y[i] == curve->old_y[i] && curve->held[i] == curve->old_held[i]) || i + gaps < curve->from ||
            i >= curve->to + gaps)
            continue;
        int a = i <= curve->from + gaps - 1 ? 0 : (int)floorf(curve->x[i - gaps]) - reach;
        int b = i + gaps >= curve->to ? width : (int)ceilf(curve->x[i + gaps]) + reach;
        a = a < 0 ? 0 : a;
        b = b > width ? width : b;
        if (b > a)
            memset(changed + a, 1, (size_t)(b - a));
    }
}

static enum bead_error profile_draw(struct bead_view *v, double time, struct bead_frame *frame, const struct bead_frame *background,
                                    struct bead_changes *changes, struct bead_message *msg)
{
    if (v->latest.fed == 0)
        return BEAD_OK;
    memset(v->changed, 0, (size_t)v->plot.width);
    for (size_t k = 0; k <= v->other_count; k++) {
        struct bead_view *curve = curve_at(v, k);
        profile_advance(curve, time);
        if (curve->setup.camera)
            profile_follow(curve);
        profile_smooth(curve);
        find_changed(curve, !v->drawn || !changes, v->changed);
    }
    size_t spans = 0;
    for (int from = 0, to; from < v->plot.width; from = to) {
        while (from < v->plot.width && !v->changed[from])
            from++;
        to = from;
        for (int x = from; x < v->plot.width && (x <= to + MERGE_GAP || spans >= MOST_SPANS); x++)
            to = v->changed[x] ? x + 1 : to;
        if (to > from)
            draw_span(v, from, to, frame, background, changes);
        spans++;
    }
    v->drawn = true;
    return v->labels ? bead_moving_labels_draw(v->labels, v->left, frame, background, changes, msg) : BEAD_OK;
}

static void set_dashes(cairo_t *cr, const struct bead_curve *curve)
{
    double lengths[6];
    for (int i = 0; curve->dashes && i < curve->dashes->count; i++)
        lengths[i] = curve->width * curve->dashes->lengths[i];
    cairo_set_dash(cr, lengths, curve->dashes ? curve->dashes->count : 0, 0);
}

static enum bead_error profile_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *)
{
    if (v->latest.fed == 0 || v->count == 0)
        return BEAD_OK;
    profile_advance(v, time);
    profile_smooth(v);
    struct bead_curve curve = profile_curve_of(v);
    cairo_save(cr);
    cairo_rectangle(cr, v->plot.x, v->plot.y, v->plot.width, v->plot.height);
    cairo_clip(cr);
    cairo_translate(cr, v->plot.x, v->plot.y);
    cairo_new_path(cr);
    for (size_t i = 0; i < curve.count; i++)
        cairo_line_to(cr, curve.x[i], curve.y[i]);
    cairo_path_t *path = cairo_copy_path(cr);
    cairo_line_to(cr, curve.x[curve.count - 1], curve.base);
    cairo_line_to(cr, curve.x[0], curve.base);
    cairo_close_path(cr);
    cairo_set_source_rgba(cr, curve.area.r, curve.area.g, curve.area.b, curve.area_alpha);
    cairo_fill(cr);
    cairo_append_path(cr, path);
    cairo_path_destroy(path);
    cairo_set_source_rgb(cr, curve.line.r, curve.line.g, curve.line.b);
    cairo_set_line_width(cr, curve.width);
    set_dashes(cr, &curve);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cr);
    for (size_t i = v->fixed; v->dots > 0 && i + v->fixed < v->count; i++) {
        cairo_new_sub_path(cr);
        cairo_arc(cr, v->x[i], v->y[i], v->dots, 0, 2 * M_PI);
    }
    cairo_fill(cr);
    cairo_restore(cr);
    return BEAD_OK;
}

const struct bead_view_type bead_view_profile_type = {
    .info = &bead_view_infos[BEAD_VIEW_PROFILE],
    .fields = profile_fields,
    .create = profile_create,
    .place = profile_place,
    .decorate = profile_decorate,
    .feed = profile_feed,
    .draw = profile_draw,
    .vector = profile_vector,
    .destroy = profile_destroy,
    .overlay = profile_overlay,
};
