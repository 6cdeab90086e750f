/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View: beads as actors. Large beads in their materials' colours on a floor, with light at each contact for its force; a camera
 * follows the wave, and a row of all beads shows its place. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/stage/stage_view.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/system.h"
#include "sim/kinds/view_kinds.h"

static bool contacts_of(const struct bead_chain *chain)
{
    return bead_chain_spec(chain)->system->has_contacts;
}

static unsigned stage_fields(const struct bead_view_setup *setup)
{
    return BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(bead_stage_field(setup));
}

static void stage_destroy(struct bead_view *v)
{
    if (!v)
        return;
    bead_stage_close(&v->stage);
    bead_backdrop_destroy(v->canvas, v->backdrop);
    bead_frame_free(&v->on_grey);
    free(v->numbers);
    free(v->balls);
    free(v->way);
    free(v);
}

/* On a floor, two balls meet above one between them that is smaller than a quarter of both: they are drawn apart, with air around
 * it. */
static void part_from_others(struct bead_view *v, size_t i)
{
    for (size_t j = i - 1; j-- > 0 && v->place[i] - v->place[j] < 2 * v->largest;) {
        const double apart = v->place[i] - v->place[j], least = 2 * sqrt(v->radius[i] * v->radius[j]);
        for (size_t k = j + 1; apart < least && k <= i; k++)
            v->place[k] = v->place[j] + (v->place[k] - v->place[j]) * least / apart;
    }
}

/* Beads rest on the floor: along it, the centres of touching neighbours of different radii are closer than the sum of the radii. */
static void place_beads(struct bead_view *v)
{
    v->ends[0] = INFINITY;
    v->ends[1] = -INFINITY;
    for (size_t i = 0; i < v->count; i++) {
        if (i > 0) {
            const double along = v->position[i] - v->position[i - 1], rise = v->radius[i] - v->radius[i - 1];
            v->place[i] = v->place[i - 1] + sqrt(fmax(0.01 * along * along, along * along - rise * rise));
        }
        v->largest = fmax(v->largest, v->radius[i]);
        if (i > 1)
            part_from_others(v, i);
        v->ends[0] = fmin(v->ends[0], v->place[i] - v->radius[i]);
        v->ends[1] = fmax(v->ends[1], v->place[i] + v->radius[i]);
    }
}

static enum bead_error make_arrays(struct bead_view *v, struct bead_message *msg)
{
    const size_t n = v->count, k = v->contacts;
    BEAD_TRY(bead_new(&v->numbers, 4 * n + 4 * k + 1, msg, "a stage"));
    BEAD_TRY(bead_new(&v->balls, 2 * n, msg, "a stage"));
    BEAD_TRY(bead_new(&v->way, k + 1, msg, "a stage"));
    v->old_balls = v->balls + n;
    v->u[0] = v->numbers;
    v->u[1] = v->u[0] + n;
    v->shift = v->u[1] + n;
    v->place = v->shift + n;
    v->force[0] = v->place + n;
    v->force[1] = v->force[0] + k;
    v->load = v->force[1] + k;
    v->excess = v->load + k;
    return BEAD_OK;
}

static enum bead_error stage_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    BEAD_TRY(bead_new(view, 1, msg, "a stage"));
    struct bead_view *v = *view;
    const struct bead_chain *chain = setup->chain;
    const size_t beads = bead_chain_beads(chain), last = setup->beads.last < beads ? setup->beads.last : beads - 1;
    v->setup = *setup;
    v->look = *setup->look;
    v->setup.look = &v->look;
    v->first = setup->beads.first < last ? setup->beads.first : last;
    v->count = last - v->first + 1;
    v->position = bead_chain_position(chain) + v->first;
    v->radius = bead_chain_radius(chain) + v->first;
    v->has_contacts = contacts_of(chain);
    v->wall = last + 1 == beads && bead_chain_spec(chain)->wall != BEAD_WALL_NONE;
    v->contacts = v->has_contacts ? v->count - 1 + v->wall : v->count;
    v->full = bead_stage_full(setup);
    BEAD_TRY(make_arrays(v, msg));
    place_beads(v);
    return BEAD_OK;
}

static enum bead_error stage_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *canvas, struct bead_message *msg)
{
    v->plot = plot;
    v->canvas = canvas;
    return bead_stage_divide(v, msg);
}

static enum bead_error stage_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *u = sample->field[BEAD_FIELD_DISPLACEMENT];
    const double *value = sample->field[bead_stage_field(&v->setup)];
    if (!u || !value)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a stage needs displacements and forces of contacts");
    bead_latest_feed(&v->latest, sample->time);
    memcpy(v->u[v->latest.newest], u + v->first, v->count * sizeof *u);
    memcpy(v->force[v->latest.newest], value + v->first, v->contacts * sizeof *value);
    return BEAD_OK;
}

static enum bead_error paint_row(struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                                 struct bead_changes *changes, struct bead_message *msg)
{
    bead_stage_compose_row(v);
    const bool same = v->drawn && changes && memcmp(v->balls, v->old_balls, v->count * sizeof *v->balls) == 0 &&
                      memcmp(v->window, v->old_window, sizeof v->window) == 0;
    if (same)
        return BEAD_OK;
    memcpy(v->old_balls, v->balls, v->count * sizeof *v->balls);
    memcpy(v->old_window, v->window, sizeof v->window);
    BEAD_TRY(v->backdrop ? BEAD_OK : bead_backdrop_create(v->canvas, background, v->row, &v->backdrop, msg));
    BEAD_TRY(bead_paint_begin(v->canvas, v->backdrop, frame, (struct bead_rect){0, 0, v->row.width, v->row.height}, msg));
    bead_paint_balls(v->canvas, v->balls, v->count);
    bead_paint_marks(v->canvas, v->window, sizeof v->window / sizeof *v->window);
    if (changes)
        bead_changes_add(changes, v->row);
    return bead_paint_end(v->canvas, msg);
}

static enum bead_error prepare(struct bead_view *v, double time, struct bead_message *msg)
{
    bead_stage_advance(v, time);
    bead_stage_compose(v);
    return bead_stage_prepare(&v->stage, msg);
}

static enum bead_error stage_draw(struct bead_view *v, double time, struct bead_frame *frame, const struct bead_frame *background,
                                  struct bead_changes *changes, struct bead_message *msg)
{
    if (!v->canvas)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a stage needs a canvas to be painted on");
    if (v->latest.fed == 0)
        return BEAD_OK;
    BEAD_TRY(prepare(v, time, msg));
    BEAD_TRY(bead_stage_paint(v, v->canvas, v->strip, frame, msg));
    if (changes)
        bead_changes_add(changes, (struct bead_rect){v->strip.x, v->strip.y + v->head, v->strip.width, v->strip.height - v->head});
    if (v->row.height > 0)
        BEAD_TRY(paint_row(v, frame, background, changes, msg));
    v->drawn = true;
    return BEAD_OK;
}

/* The camera also follows the wave in frames that are not drawn. */
static void stage_pass(struct bead_view *v, double time)
{
    if (v->latest.fed > 0)
        bead_stage_advance(v, time);
}

static void draw_row(struct bead_view *v, cairo_t *cr)
{
    bead_stage_compose_row(v);
    for (size_t i = 0; i < v->count; i++) {
        const struct bead_ball *ball = &v->balls[i];
        cairo_set_source_rgb(cr, ball->rgba[0] / 255.0, ball->rgba[1] / 255.0, ball->rgba[2] / 255.0);
        cairo_arc(cr, v->row.x + ball->x, v->row.y + ball->y, ball->r, 0, 2 * M_PI);
        cairo_fill(cr);
    }
    cairo_set_source_rgb(cr, v->look.accent.r, v->look.accent.g, v->look.accent.b);
    for (size_t k = 0; k < sizeof v->window / sizeof *v->window; k++) {
        const float *box = v->window[k].box;
        cairo_rectangle(cr, v->row.x + box[0], v->row.y + box[1], box[2] - box[0], box[3] - box[1]);
        cairo_fill(cr);
    }
}

/* Light has no paths: in vector files the stage is an image. The file keeps the surface, which must therefore own its pixels. */
static enum bead_error draw_stage(struct bead_view *v, cairo_t *cr, struct bead_message *msg)
{
    const struct bead_rect all = {0, 0, v->strip.width, v->strip.height};
    const cairo_format_t format = v->look.clear ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24;
    cairo_surface_t *surface = cairo_image_surface_create(format, all.width, all.height);
    struct bead_frame frame = {all.width, all.height, (size_t)cairo_image_surface_get_stride(surface),
                               cairo_image_surface_get_data(surface), v->look.clear};
    struct bead_canvas *canvas = NULL;
    enum bead_error err = frame.pixels ? bead_canvas_create("plain", all.width, all.height, &canvas, msg)
                                       : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a stage");
    if (!err)
        err = bead_stage_paint(v, canvas, all, &frame, msg);
    if (!err) {
        cairo_surface_mark_dirty(surface);
        cairo_set_source_surface(cr, surface, v->strip.x, v->strip.y);
        cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
        cairo_rectangle(cr, v->strip.x, v->strip.y + v->head, all.width, all.height - v->head);
        cairo_fill(cr);
    }
    bead_canvas_destroy(canvas);
    cairo_surface_destroy(surface);
    return err;
}

static enum bead_error stage_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *msg)
{
    if (v->latest.fed == 0)
        return BEAD_OK;
    BEAD_TRY(prepare(v, time, msg));
    BEAD_TRY(draw_stage(v, cr, msg));
    if (v->row.height > 0)
        draw_row(v, cr);
    return BEAD_OK;
}

enum bead_error bead_stage_at_rest(const struct bead_view_setup *setup, struct bead_rect rect, cairo_t *cr,
                                   struct bead_message *msg)
{
    const enum bead_field field = bead_stage_field(setup);
    const double *rest = contacts_of(setup->chain) ? bead_chain_static_force(setup->chain) : NULL;
    struct bead_sample sample = {.active = bead_chain_beads(setup->chain)};
    struct bead_view *v = NULL;
    BEAD_FREED double *zeros = NULL;
    BEAD_TRY(bead_new(&zeros, sample.active + 1, msg, "a stage"));
    sample.field[BEAD_FIELD_DISPLACEMENT] = zeros;
    sample.field[field] = rest ? rest : zeros;
    enum bead_error err = stage_create(setup, &v, msg);
    if (!err)
        err = stage_place(v, rect, NULL, msg);
    if (!err)
        err = bead_stage_decorate(v, cr, msg);
    if (!err)
        err = stage_feed(v, &sample, msg);
    if (!err)
        err = stage_vector(v, 0, cr, msg);
    stage_destroy(v);
    return err;
}

/* Natural height of a plot of this width: with beads as large as possible, and the parts above and below. */
static double stage_most_height(const struct bead_view_setup *setup, double width)
{
    const double em = setup->look->tick;
    return ceil(bead_stage_height(width) + 1.5 * setup->look->label + 2.3 * em);
}

const struct bead_view_type bead_view_stage_type = {
    .info = &bead_view_infos[BEAD_VIEW_STAGE],
    .fields = stage_fields,
    .create = stage_create,
    .place = stage_place,
    .decorate = bead_stage_decorate,
    .feed = stage_feed,
    .draw = stage_draw,
    .pass = stage_pass,
    .find = bead_stage_find,
    .vector = stage_vector,
    .destroy = stage_destroy,
    .most_height = stage_most_height,
};
