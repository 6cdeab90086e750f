/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View: space-time image in the setup's orientation. Every pixel is the exact mean of the field over its piece of chain and time.
 * With `fill`, only times up to the present are shown, with a line there. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/raster.h"
#include "render/stage/along.h"
#include "render/stage/camera.h"
#include "render/stage/panel.h"
#include "render/view/area.h"
#include "render/view/horizon.h"
#include "render/view/orientation.h"
#include "render/view/theory_line.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/kinds/view_kinds.h"

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;
    struct bead_rect plot;
    struct bead_area *area;
    struct bead_horizon *horizon;    /* NULL: without `trust` */
    struct bead_theory_line *theory; /* NULL: without `theory` */
    int columns, places;             /* pixels along time, along the chain */
    uint8_t *indices;                /* [plot.height][plot.width], colours of the columns (or rows) done */
    int first, done;                 /* time columns first <= c < done have their final colours */
    int shown;                       /* columns up to here are in the frame */
    int mark[2];                     /* places of the camera's window, shown on the cursor */
    bool drawn, finished;
    uint32_t colour[256], ghost[256]; /* as in frames; dimmed */
    struct bead_colour_table table;
};

static unsigned spacetime_fields(const struct bead_view_setup *setup)
{
    return BEAD_FIELD_BIT(setup->field) | (setup->theory ? BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) : 0);
}

static uint32_t pixel_of(struct bead_rgb c)
{
    return 0xff000000u | (uint32_t)lround(c.r * 255) << 16 | (uint32_t)lround(c.g * 255) << 8 | (uint32_t)lround(c.b * 255);
}

/* A colour of the future, which is mostly the panel's. */
static struct bead_rgb dimmed(const struct bead_view *v, const uint8_t rgb[3])
{
    static const double seen = 0.3;
    const struct bead_rgb *p = &v->look.panel;
    return (struct bead_rgb){p->r + seen * (rgb[0] / 255.0 - p->r), p->g + seen * (rgb[1] / 255.0 - p->g),
                             p->b + seen * (rgb[2] / 255.0 - p->b)};
}

static void recolour(struct bead_view *view, const struct bead_colours *colours)
{
    view->setup.colours = *colours;
    bead_colour_table_make(&view->setup.colours, &view->table);
    for (int i = 0; i < 256; i++) {
        const uint8_t *rgb = colours->map->rgb[i];
        view->colour[i] = 0xff000000u | (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
        view->ghost[i] = pixel_of(dimmed(view, rgb));
    }
}

static enum bead_error spacetime_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    if (!(setup->time[1] > setup->time[0]) || setup->beads.last < setup->beads.first)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a space-time image needs a stretch of time and of beads");
    BEAD_TRY(bead_new(view, 1, msg, "a space-time image"));
    struct bead_view *v = *view;
    v->setup = *setup;
    v->look = *setup->look;
    v->setup.look = &v->look;
    recolour(v, &setup->colours);
    return BEAD_OK;
}

static bool down(const struct bead_view *v)
{
    return v->setup.orientation == BEAD_TIME_DOWN;
}

static enum bead_error spacetime_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *, struct bead_message *msg)
{
    if (plot.width < 1 || plot.height < 1)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "there is no room for a space-time image: make the picture larger");
    v->plot = plot;
    v->columns = down(v) ? plot.height : plot.width;
    v->places = down(v) ? plot.width : plot.height;
    return BEAD_OK;
}

/* Pixels belong to the beads drawn above them. */
static enum bead_error divide(struct bead_view *v, struct bead_message *msg)
{
    const size_t values = v->setup.beads.last - v->setup.beads.first + 1;
    BEAD_FREED double *borders = NULL;
    BEAD_TRY(bead_new(&borders, values + 1, msg, "a space-time image"));
    for (size_t j = 0; j <= values; j++)
        borders[j] = bead_along_border(&v->setup, v->setup.beads.first + j);
    bead_area_divide(v->area, borders);
    return BEAD_OK;
}

/* Makes sums and indices, with the first sample: a view that only draws decorations needs neither. */
static enum bead_error spacetime_prepare(struct bead_view *v, struct bead_message *msg)
{
    struct bead_area_setup setup = {
        v->setup.beads, {v->setup.time[0], v->setup.time[1]}, v->places, v->columns, BEAD_SAMPLING_AREA};
    struct bead_area_setup sampled = setup; /* the horizon always compares means */
    sampled.sampling = v->setup.sampling;
    BEAD_TRY(bead_area_create(&sampled, &v->area, msg));
    BEAD_TRY(v->setup.trust ? bead_horizon_create(&setup, &v->horizon, msg) : BEAD_OK);
    BEAD_TRY(v->setup.theory ? bead_theory_line_create(&v->setup, &v->theory, msg) : BEAD_OK);
    BEAD_TRY(bead_along_uneven(&v->setup, v->places) ? divide(v, msg) : BEAD_OK);
    v->indices = bead_large_take((size_t)v->plot.width * (size_t)v->plot.height);
    return v->indices ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a space-time image");
}

/* On dark pages the panel itself is visible. */
static void draw_frame(const struct bead_view *v, cairo_t *cr)
{
    if (v->setup.axes && !v->look.dark)
        bead_box_draw(cr, &v->look, bead_panel_rect(&v->setup, v->plot));
}

static enum bead_error spacetime_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *)
{
    const struct bead_view_setup *s = &v->setup;
    bead_panel_fill(cr, s, v->plot);
    if (!s->axes)
        return BEAD_OK;
    struct bead_axis time, beads;
    const char *unit = bead_chain_time_unit(s->chain);
    bead_axis_make(&time, s->time[0], s->time[1], unit, BEAD_SCALE_LINEAR, v->columns, v->look.tick, !down(v));
    const char *name = bead_along_axis(&beads, s, v->places, v->look.tick, down(v));
    draw_frame(v, cr);
    if (down(v)) {
        bead_panel_axis(cr, s, &time, v->plot, true, "time");
        bead_panel_chain_axis(cr, s, &beads, v->plot, s->bead_labels ? name : NULL);
    } else {
        char both[128];
        bead_panel_time_axis(cr, s, &time, v->plot);
        if (s->against) {
            const size_t used = strlen(beads.unit); /* a power of ten at the most */
            snprintf(both, sizeof both, BEAD_PANEL_AGAINST, name);
            snprintf(beads.unit + used, sizeof beads.unit - used, used > 0 ? "; %s" : "%s", time.unit);
        }
        bead_panel_axis(cr, s, &beads, v->plot, false, s->against ? both : name);
    }
    return BEAD_OK;
}

static enum bead_error spacetime_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    if (!sample->field[v->setup.field])
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no %s", bead_field_info(v->setup.field)->title);
    const double *values = sample->field[v->setup.field], *comparison = sample->comparison[v->setup.field];
    if (v->setup.trust && !comparison)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the samples have no comparison run");
    BEAD_TRY(v->area ? BEAD_OK : spacetime_prepare(v, msg));
    bead_area_feed(v->area, sample->time, values, sample->active);
    if (v->theory)
        bead_theory_line_feed(v->theory, sample);
    if (v->horizon)
        bead_horizon_feed(v->horizon, sample->time, values, comparison,
                          sample->active > sample->comparison_active ? sample->active : sample->comparison_active);
    return BEAD_OK;
}

/* Finds the colours of columns v->done .. to - 1, if there is a sample. Columns without samples occur only at the ends and are
 * skipped. */
static enum bead_error colour_columns(struct bead_view *v, int to, struct bead_message *msg)
{
    if (!v->area)
        return BEAD_OK;
    const struct bead_area_image image = bead_orientation_image(v->setup.orientation, v->places, v->indices, v->plot.width);
    bool before = true; /* the first sample */
    while (before && v->done < to) {
        BEAD_TRY(bead_area_colour(v->area, &v->table, v->done, to, &image, &v->done, msg));
        before = v->done == v->first && v->done < to;
        if (before)
            v->first = ++v->done;
    }
    return BEAD_OK;
}

/* Writes the pixels of `rect`, a part of the plot. */
static void put_pixels(const struct bead_view *v, const uint32_t colour[256], struct bead_rect rect, uint8_t *row, size_t stride)
{
    const uint8_t *index = v->indices + (size_t)(rect.y - v->plot.y) * (size_t)v->plot.width + (size_t)(rect.x - v->plot.x);
    for (int y = 0; y < rect.height; y++, row += stride, index += v->plot.width)
        for (int x = 0; x < rect.width; x++)
            memcpy(row + 4 * x, &colour[index[x]], 4);
}

/* The bead number, with fraction, at a position along the chain (m). As in the image, bead j covers j - 1/2 to j + 1/2. */
static double bead_at(const struct bead_view *v, double place)
{
    const double *position = bead_chain_position(v->setup.chain);
    size_t low = v->setup.beads.first, high = v->setup.beads.last, most = bead_chain_beads(v->setup.chain) - 1;
    high = high < most ? high : most;
    if (place <= position[low] || low == high)
        return (double)low - 0.5;
    if (place >= position[high])
        return (double)v->setup.beads.last + 0.5;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (position[middle] <= place)
            low = middle;
        else
            high = middle;
    }
    return (double)low + (place - position[low]) / (position[high] - position[low]);
}

/* Finds the places of the camera's window; true if it has moved. */
static bool find_mark(struct bead_view *v)
{
    int mark[2] = {0, 0};
    if (!v->setup.camera || !v->setup.fill)
        return false;
    double left = bead_camera_left(v->setup.camera), ends[2] = {left, left + bead_camera_width(v->setup.camera)};
    for (int k = 0; k < 2; k++) {
        double part = (bead_at(v, ends[k]) - (double)v->setup.beads.first + 0.5) /
                      ((double)v->setup.beads.last - (double)v->setup.beads.first + 1);
        mark[k] = (int)lround(v->places * fmin(1, fmax(0, part)));
    }
    bool moved = memcmp(mark, v->mark, sizeof mark) != 0;
    memcpy(v->mark, mark, sizeof mark);
    return moved;
}

static void draw_cursor(const struct bead_view *v, int at, int thickness, struct bead_frame *frame)
{
    uint32_t ink = pixel_of(v->look.ink), accent = pixel_of(v->look.accent);
    int width = down(v) ? v->plot.width : thickness, height = down(v) ? thickness : v->plot.height;
    int left = v->plot.x + (down(v) ? 0 : at), top = v->plot.y + (down(v) ? at : 0);
    for (int y = top; y < top + height; y++) {
        for (int x = left; x < left + width; x++) {
            int along = down(v) ? x - v->plot.x : y - v->plot.y, last = v->places - 1;
            int place = down(v) || v->setup.orientation == BEAD_MATRIX ? along : last - along;
            bool marked = place >= v->mark[0] && place < v->mark[1];
            memcpy(frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x, marked ? &accent : &ink, 4);
        }
    }
}

/* Compares both runs' columns up to `to`; returns the first column where the horizon has changed, INT_MAX if it has not. */
static int find_horizon(struct bead_view *v, int to)
{
    double range = v->setup.colours.high - v->setup.colours.low;
    return v->horizon ? bead_horizon_find(v->horizon, BEAD_HORIZON_PART * range, to) : INT_MAX;
}

/* The earliest time at which a pixel (in movies: one drawn so far) differs from the comparison run's. */
static double spacetime_horizon(struct bead_view *view)
{
    if (!view->setup.fill)
        find_horizon(view, view->columns);
    return view->horizon ? bead_horizon_time(view->horizon) : INFINITY;
}

/* Marks the moment that other views show with a light line with dark edges, visible on any colour. */
static void stroke_mark(const struct bead_view *v, cairo_t *cr)
{
    double place = (v->setup.mark - v->setup.time[0]) / (v->setup.time[1] - v->setup.time[0]), line = v->look.line;
    if (!v->setup.marked || v->setup.fill || !(place > 0 && place < 1))
        return;
    bool across = down(v);
    double at = round((across ? v->plot.y + place * v->plot.height : v->plot.x + place * v->plot.width) - line / 2) + line / 2;
    for (int pass = 0; pass < 2; pass++) {
        cairo_new_path(cr);
        cairo_move_to(cr, across ? v->plot.x : at, across ? at : v->plot.y);
        cairo_rel_line_to(cr, across ? v->plot.width : 0, across ? 0 : v->plot.height);
        cairo_set_source_rgba(cr, pass, pass, pass, pass ? 1 : 0.6);
        cairo_set_line_width(cr, pass ? line : 3 * line);
        cairo_stroke(cr);
    }
}

/* Draws horizon, theory and mark in a part of the frame. */
static enum bead_error spacetime_draw_lines(const struct bead_view *v, struct bead_rect part, struct bead_frame *frame,
                                            struct bead_message *msg)
{
    if ((!v->horizon && !v->theory && !v->setup.marked) || part.width < 1 || part.height < 1)
        return BEAD_OK;
    cairo_t *cr = bead_raster_begin(frame);
    cairo_rectangle(cr, part.x, part.y, part.width, part.height);
    cairo_clip(cr);
    if (v->horizon)
        bead_horizon_draw(v->horizon, cr, &v->look, v->plot, v->setup.orientation, !v->setup.fill);
    if (v->theory)
        bead_theory_line_draw(v->theory, &v->look, v->plot, part, cr);
    stroke_mark(v, cr);
    return bead_raster_end(cr, "horizon", msg);
}

/* The number of time columns that are final at `time`; in stills, all. */
static int columns_until(const struct bead_view *v, double time)
{
    double place = (time - v->setup.time[0]) / (v->setup.time[1] - v->setup.time[0]) * v->columns;
    if (!v->setup.fill)
        return v->columns;
    return place > 0 ? (int)fmin(floor(place + 1e-6), v->columns) : 0;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Columns as a rectangle of the frame. */
static struct bead_rect columns_rect(const struct bead_view *v, int from, int to)
{
    return down(v) ? (struct bead_rect){v->plot.x, v->plot.y + from, v->plot.width, to - from}
                   : (struct bead_rect){v->plot.x + from, v->plot.y, to - from, v->plot.height};
}

static void draw_future(const struct bead_view *v, int from, struct bead_frame *frame, struct bead_changes *changes)
{
    struct bead_rect rect = columns_rect(v, from > v->first ? from : v->first, v->done);
    if (rect.width < 1 || rect.height < 1)
        return;
    put_pixels(v, v->ghost, rect, frame->pixels + (size_t)rect.y * frame->stride + 4 * (size_t)rect.x, frame->stride);
    bead_changes_add(changes, rect);
}

static enum bead_error spacetime_draw(struct bead_view *v, double time, struct bead_frame *frame,
                                      const struct bead_frame *background, struct bead_changes *changes, struct bead_message *msg)
{
    int line_width = (int)v->look.line * (v->setup.camera ? 2 : 1); /* wide enough to distinguish its two colours */
    int until = columns_until(v, time), thickness = smaller(line_width, v->columns), last = v->columns - thickness;
    bool cursor = v->setup.fill && time < v->setup.time[1], moved = find_mark(v);
    if (v->drawn && until == v->shown && ((cursor && !moved) || v->finished))
        return BEAD_OK;
    BEAD_TRY(colour_columns(v, v->setup.ghost ? v->columns : until, msg));
    if (v->setup.ghost && v->area && !v->drawn)
        draw_future(v, until, frame, changes);
    /* From the cursor's last place, or from the first change of the horizon. */
    double reach = ceil(bead_horizon_reach(&v->look)) + 1;
    int from = v->drawn ? smaller(v->shown, last) : 0, end = until, line = find_horizon(v, until);
    if (v->theory) /* its line turns as the force of the pulse changes */
        from = 0;
    from = smaller(from, line > (int)reach ? line - (int)reach : 0);
    if (v->setup.fill && background)
        bead_frame_copy(frame, background, columns_rect(v, from, until));
    int first = from < v->first ? v->first : from, to = smaller(v->done, until);
    struct bead_rect rect = columns_rect(v, first, to);
    if (to > first)
        put_pixels(v, v->colour, rect, frame->pixels + (size_t)rect.y * frame->stride + 4 * (size_t)rect.x, frame->stride);
    enum bead_error err = spacetime_draw_lines(v, rect, frame, msg);
    if (cursor) {
        int at = smaller(until, last);
        draw_cursor(v, at, thickness, frame);
        end = at + thickness > end ? at + thickness : end;
    }
    bead_changes_add(changes, columns_rect(v, from, end));
    v->shown = until;
    v->drawn = true;
    v->finished = !cursor;
    return err;
}

static void spacetime_set_range(struct bead_view *view, const struct bead_colours *colours, const double[2])
{
    recolour(view, colours);
}

static void spacetime_extremes(const struct bead_view *view, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    if (view->area)
        bead_area_extremes(view->area, low, high);
}

static double spacetime_typical(const struct bead_view *view, double rest, double *largest)
{
    *largest = 0;
    return view->area ? bead_area_typical(view->area, rest, largest) : INFINITY;
}

/* Draws the pixels of `rect` as an embedded image. */
static cairo_status_t embed(const struct bead_view *v, struct bead_rect rect, cairo_t *cr)
{
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, rect.width, rect.height);
    cairo_status_t status = cairo_surface_status(image);
    if (!status) {
        put_pixels(v, v->colour, rect, cairo_image_surface_get_data(image), (size_t)cairo_image_surface_get_stride(image));
        cairo_surface_mark_dirty(image);
        cairo_set_source_surface(cr, image, rect.x, rect.y);
        cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
        cairo_paint(cr);
        status = cairo_status(cr);
    }
    cairo_surface_destroy(image);
    return status;
}

static enum bead_error spacetime_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *msg)
{
    int until = columns_until(v, time);
    BEAD_TRY(colour_columns(v, until, msg));
    int to = smaller(v->done, until);
    if (to <= v->first)
        return BEAD_OK;
    cairo_status_t status = embed(v, columns_rect(v, v->first, to), cr);
    find_horizon(v, until);
    if (v->horizon && !status) {
        bead_horizon_draw(v->horizon, cr, &v->look, v->plot, v->setup.orientation, !v->setup.fill);
        status = cairo_status(cr);
    }
    if (v->theory)
        bead_theory_line_draw(v->theory, &v->look, v->plot, columns_rect(v, v->first, to), cr);
    stroke_mark(v, cr);
    draw_frame(v, cr); /* again, because viewers stretch the image to whole pixels of theirs, over its frame */
    return status ? bead_fail(msg, BEAD_ERROR_MEMORY, "space-time image: %s", cairo_status_to_string(status)) : BEAD_OK;
}

static void spacetime_destroy(struct bead_view *v)
{
    if (!v)
        return;
    bead_area_destroy(v->area);
    bead_horizon_destroy(v->horizon);
    bead_theory_line_destroy(v->theory);
    free(v->indices);
    free(v);
}

const struct bead_view_type bead_view_spacetime_type = {
    .info = &bead_view_infos[BEAD_VIEW_SPACETIME],
    .fields = spacetime_fields,
    .create = spacetime_create,
    .place = spacetime_place,
    .decorate = spacetime_decorate,
    .feed = spacetime_feed,
    .draw = spacetime_draw,
    .vector = spacetime_vector,
    .destroy = spacetime_destroy,
    .extremes = spacetime_extremes,
    .typical = spacetime_typical,
    .set_range = spacetime_set_range,
    .horizon = spacetime_horizon,
};
