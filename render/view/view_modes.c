/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View: energies of the linear modes of an equation, a bar for each. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/axis.h"
#include "render/draw/raster.h"
#include "render/stage/latest.h"
#include "render/stage/panel.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"
#include "sim/kinds/view_kinds.h"

/* Width of a bar as a part of its room; end of the axis, in units of the initial energy. */
static const double fullness = 0.62, high = 1.04;

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;
    size_t modes;
    double energies[2][BEAD_MODES], *energy[2];
    struct bead_latest latest;
    double whole; /* energy of all modes shown in the first sample: 1 on the axis */
    struct bead_axis axis;
    struct bead_rect plot;
    int top[BEAD_MODES]; /* of the bars as last drawn, in px / steps */
    bool drawn;
};

/* Heights are rounded to this fraction of a pixel. */
static const double steps = 16;

static unsigned modes_fields(const struct bead_view_setup *setup)
{
    return bead_chain_mode_fields(setup->chain);
}

static void modes_destroy(struct bead_view *v)
{
    free(v);
}

static enum bead_error modes_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    *view = NULL;
    if (!bead_chain_mode_fields(setup->chain))
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a view of modes needs an equation with linear modes");
    BEAD_TRY(bead_new(view, 1, msg, "a view of modes"));
    struct bead_view *v = *view;
    v->setup = *setup;
    v->look = *setup->look;
    v->setup.look = &v->look;
    v->modes = setup->modes;
    v->energy[0] = v->energies[0];
    v->energy[1] = v->energies[1];
    return BEAD_OK;
}

static enum bead_error modes_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *, struct bead_message *)
{
    v->plot = plot;
    bead_axis_make(&v->axis, 0, high, "", BEAD_SCALE_LINEAR, plot.height, v->look.tick, false);
    return BEAD_OK;
}

static double middle_of(const struct bead_view *v, size_t k)
{
    return v->plot.x + ((double)k + 0.5) * v->plot.width / (double)v->modes;
}

static enum bead_error modes_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *)
{
    struct bead_axis numbers;
    bead_panel_fill(cr, &v->setup, v->plot);
    if (!v->setup.axes)
        return BEAD_OK;
    if (!v->look.dark)
        bead_box_draw(cr, &v->look, v->plot);
    bead_panel_axis(cr, &v->setup, &v->axis, v->plot, false, "energy share");
    bead_axis_make(&numbers, 0.5, (double)v->modes + 0.5, "1", BEAD_SCALE_LINEAR, v->plot.width, v->look.tick, true);
    bead_panel_chain_axis(cr, &v->setup, &numbers, v->plot, v->setup.bead_labels ? "mode" : NULL);
    return BEAD_OK;
}

static enum bead_error modes_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    unsigned needed = bead_chain_mode_fields(v->setup.chain);
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        if (needed & BEAD_FIELD_BIT(f) && !sample->field[f])
            return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "energies of modes need the field %s", bead_field_info(f)->name);
    }
    bead_latest_feed(&v->latest, sample->time);
    bead_chain_mode_energies(v->setup.chain, sample->field, v->modes, v->energy[v->latest.newest]);
    for (size_t k = 0; v->latest.fed == 1 && k < v->modes; k++)
        v->whole += v->energy[v->latest.newest][k];
    v->whole = v->whole > 0 ? v->whole : 1;
    return BEAD_OK;
}

static double energy_at(const struct bead_view *v, size_t k, double time)
{
    return bead_latest_value(&v->latest, v->energy, k, bead_latest_weight(&v->latest, time));
}

/* Distance of a bar's top from the plot's, px. */
static double top_of(const struct bead_view *v, double energy)
{
    return round((1 - fmin(1, fmax(0, energy / (high * v->whole)))) * v->plot.height * steps) / steps;
}

static void modes_draw_bar(const struct bead_view *v, cairo_t *cr, size_t k, double top)
{
    double width = fullness * v->plot.width / (double)v->modes;
    struct bead_rgb colour = bead_look_curve(&v->look, k);
    cairo_set_source_rgb(cr, colour.r, colour.g, colour.b);
    cairo_rectangle(cr, round(middle_of(v, k) - 0.5 * width), v->plot.y + top, round(width), v->plot.height - top);
    cairo_fill(cr);
}

/* Draws the bars whose height has changed. */
static enum bead_error modes_draw(struct bead_view *v, double time, struct bead_frame *frame, const struct bead_frame *background,
                                  struct bead_changes *changes, struct bead_message *msg)
{
    if (v->latest.fed == 0)
        return BEAD_OK;
    cairo_t *cr = bead_raster_begin(frame);
    for (size_t k = 0; k < v->modes; k++) {
        double top = top_of(v, energy_at(v, k, time));
        if (v->drawn && changes && v->top[k] == (int)lround(top * steps))
            continue;
        double half = 0.5 * v->plot.width / (double)v->modes;
        int left = (int)fmax(v->plot.x, floor(middle_of(v, k) - half));
        int right = (int)fmin(v->plot.x + v->plot.width, ceil(middle_of(v, k) + half));
        struct bead_rect rect = {left, v->plot.y, right - left, v->plot.height};
        cairo_surface_flush(cairo_get_target(cr));
        if (background)
            bead_frame_copy(frame, background, rect);
        cairo_surface_mark_dirty(cairo_get_target(cr));
        modes_draw_bar(v, cr, k, top);
        v->top[k] = (int)lround(top * steps);
        if (changes)
            bead_changes_add(changes, rect);
    }
    v->drawn = true;
    return bead_raster_end(cr, "bars of modes", msg);
}

static enum bead_error modes_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *)
{
    for (size_t k = 0; v->latest.fed > 0 && k < v->modes; k++)
        modes_draw_bar(v, cr, k, top_of(v, energy_at(v, k, time)));
    return BEAD_OK;
}

const struct bead_view_type bead_view_modes_type = {
    .info = &bead_view_infos[BEAD_VIEW_MODES],
    .fields = modes_fields,
    .create = modes_create,
    .place = modes_place,
    .decorate = modes_decorate,
    .feed = modes_feed,
    .draw = modes_draw,
    .vector = modes_vector,
    .destroy = modes_destroy,
};
