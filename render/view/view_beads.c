/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View: the chain's beads as spheres. If they are small, a lens below the row shows those at the front. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/paint/canvas_private.h"
#include "render/paint/pixel_kernels.h"
#include "render/stage/along.h"
#include "render/stage/beads.h"
#include "render/stage/magnify.h"
#include "render/view/views.h"
#include "sim/base/memory.h"
#include "sim/chain/system.h"
#include "sim/kinds/view_kinds.h"

static unsigned beads_fields(const struct bead_view_setup *setup)
{
    return BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(setup->field);
}

static void free_composed(struct bead_composed *c)
{
    free(c->balls);
    free(c->glow);
    free(c->marks);
}

static void beads_destroy(struct bead_view *v)
{
    if (!v)
        return;
    free(v->numbers);
    free(v->base);
    free(v->colour);
    bead_camera_destroy(v->camera);
    bead_moving_labels_destroy(v->labels);
    free_composed(&v->row_drawing.now);
    free_composed(&v->row_drawing.old);
    free_composed(&v->lens_drawing.now);
    free_composed(&v->lens_drawing.old);
    bead_backdrop_destroy(v->canvas, v->backdrop);
    free(v);
}

static enum bead_error make_composed(struct bead_composed *c, size_t balls, size_t marks, struct bead_message *msg)
{
    BEAD_TRY(bead_new(&c->balls, balls, msg, "a view of beads"));
    BEAD_TRY(bead_new(&c->glow, balls, msg, "a view of beads"));
    return bead_new(&c->marks, marks, msg, "a view of beads");
}

static enum bead_error make_arrays(struct bead_view *v, struct bead_message *msg)
{
    struct bead_composed *const composed[] = {&v->row_drawing.now, &v->row_drawing.old, &v->lens_drawing.now, &v->lens_drawing.old};
    size_t n = v->count, sensors;
    (void)bead_chain_sensors(v->setup.chain, &sensors);
    BEAD_TRY(bead_new(&v->colour, n, msg, "a view of beads"));
    BEAD_TRY(bead_new(&v->numbers, 7 * n, msg, "a view of beads"));
    for (size_t k = 0; k < 2; k++) {
        v->u[k] = v->numbers + k * n;
        v->value[k] = v->numbers + (2 + k) * n;
    }
    v->shift = v->numbers + 4 * n;
    v->shown = v->numbers + 5 * n;
    v->load = v->numbers + 6 * n;
    for (size_t k = 0; k < 4; k++)
        BEAD_TRY(make_composed(composed[k], n, n + sensors + 8, msg));
    return BEAD_OK;
}

static void beads_measure(struct bead_view *v)
{
    const struct bead_chain *chain = v->setup.chain;
    size_t beads = bead_chain_beads(chain), last = v->setup.beads.last < beads ? v->setup.beads.last : beads - 1;
    v->first = v->setup.beads.first < last ? v->setup.beads.first : last;
    v->count = last - v->first + 1;
    v->position = bead_chain_position(chain) + v->first;
    v->radius = bead_chain_radius(chain) + v->first;
    v->ends[0] = INFINITY;
    v->ends[1] = -INFINITY;
    for (size_t i = 0; i < v->count; i++) {
        v->largest = fmax(v->largest, v->radius[i]);
        v->ends[0] = fmin(v->ends[0], v->position[i] - v->radius[i]);
        v->ends[1] = fmax(v->ends[1], v->position[i] + v->radius[i]);
    }
    if (!bead_chain_spec(chain)->system->has_contacts) {
        v->ends[0] = bead_along_border(&v->setup, v->first);
        v->ends[1] = bead_along_border(&v->setup, v->first + v->count);
    }
    v->compression = bead_compression_scale(chain);
    v->striker = v->first == 0 && bead_chain_spec(chain)->system->has_striker;
    v->wall = last + 1 == beads && bead_chain_spec(chain)->wall != BEAD_WALL_NONE;
}

static enum bead_error beads_create(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg)
{
    BEAD_TRY(bead_new(view, 1, msg, "a view of beads"));
    struct bead_view *v = *view;
    v->setup = *setup;
    v->look = *setup->look;
    v->map = *setup->colours.map;
    v->setup.look = &v->look;
    v->setup.colours.map = &v->map;
    beads_measure(v);
    return make_arrays(v, msg);
}

static enum bead_error beads_place(struct bead_view *v, struct bead_rect plot, struct bead_canvas *canvas, struct bead_message *msg)
{
    int left = v->setup.beyond[0], right = v->setup.beyond[1];
    if (v->setup.axes && v->setup.titles == BEAD_TITLES_BESIDE)
        bead_beads_margins(&v->look, &left, &right);
    left = left < plot.x ? left : plot.x;
    v->plot = plot;
    v->area = (struct bead_rect){plot.x - left, plot.y, plot.width + left + right, plot.height};
    v->canvas = canvas;
    if (canvas && (v->area.width > canvas->width || v->area.height > canvas->height))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "beads need a canvas of %d x %d pixels", v->area.width, v->area.height);
    BEAD_TRY(bead_beads_divide(v, msg));
    return v->strip && !bead_beads_prepare_strip(v)
               ? bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a strip of %zu beads", v->count)
               : BEAD_OK;
}

/* For a field of contacts, a bead shows the mean of its two contacts. */
static double value_of(const struct bead_view *v, const double *field, size_t bead)
{
    if (!bead_field_info(v->setup.field)->of_contacts)
        return field[bead];
    size_t contacts = bead_chain_contacts(v->setup.chain);
    bool left = bead > v->setup.beads.first, right = bead < contacts && bead <= v->setup.beads.last;
    double sum = (left ? field[bead - 1] : 0) + (right ? field[bead] : 0);
    return left && right ? 0.5 * sum : sum;
}

static enum bead_error beads_feed(struct bead_view *v, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *u = sample->field[BEAD_FIELD_DISPLACEMENT], *field = sample->field[v->setup.field];
    if (!u || !field)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a view of beads needs displacement and %s",
                         bead_field_info(v->setup.field)->name);
    bead_latest_feed(&v->latest, sample->time);
    for (size_t i = 0; i < v->count; i++) {
        v->u[v->latest.newest][i] = u[v->first + i];
        v->value[v->latest.newest][i] = value_of(v, field, v->first + i);
    }
    return v->camera ? bead_camera_feed(v->camera, sample, msg) : BEAD_OK;
}

/* Paints a drawing within `rect` of the area. */
static enum bead_error beads_paint(struct bead_view *v, const struct bead_drawing *d, struct bead_rect rect,
                                   struct bead_frame *frame, struct bead_changes *changes, struct bead_message *msg)
{
    size_t first = d->now.count, end = 0;
    for (size_t i = 0; i < d->now.count; i++) {
        if (d->now.balls[i].x + d->now.balls[i].r + 2 < rect.x || d->now.balls[i].x - d->now.balls[i].r - 2 > rect.x + rect.width)
            continue;
        first = i < first ? i : first;
        end = i + 1;
    }
    BEAD_TRY(bead_paint_begin(v->canvas, v->backdrop, frame, rect, msg));
    if (first < end)
        bead_paint_balls(v->canvas, d->now.balls + first, end - first);
    bead_paint_marks(v->canvas, d->now.marks, d->now.mark_count);
    enum bead_error err = bead_paint_end(v->canvas, msg);
    if (changes)
        bead_changes_add(changes, (struct bead_rect){v->area.x + rect.x, v->area.y + rect.y, rect.width, rect.height});
    return err;
}

static enum bead_error paint_spans(struct bead_view *v, const struct bead_drawing *d, const struct bead_rect *limits,
                                   const struct bead_spans *spans, struct bead_frame *frame, struct bead_changes *changes,
                                   struct bead_message *msg)
{
    for (size_t i = 0; i < spans->count; i++) {
        struct bead_rect rect = {spans->from[i], limits->y, spans->to[i] - spans->from[i], limits->height};
        BEAD_TRY(beads_paint(v, d, rect, frame, changes, msg));
    }
    return BEAD_OK;
}

static enum bead_error paint_row(struct bead_view *v, struct bead_frame *frame, struct bead_changes *changes,
                                 struct bead_message *msg)
{
    const struct bead_spans spans = bead_beads_row_changes(v);
    return paint_spans(v, &v->row_drawing, &v->row.rect, &spans, frame, changes, msg);
}

/* Marks the lens's window on the row and the connection down to the lens. */
static void compose_zoom(struct bead_view *v)
{
    if (v->zoom.height == 0)
        return;
    double from = fmax(0, bead_window_x(&v->row, v->lens.from));
    double to = fmin(v->area.width, bead_window_x(&v->row, v->lens.from + v->lens.rect.width / v->lens.scale));
    double wider = fmax(0, 0.5 * (4 - (to - from))); /* in a row of thousands */
    from -= wider;
    to += wider;
    const struct bead_rect *z = &v->zoom;
    v->old_zoom_mark = v->zoom_mark;
    v->zoom_mark = (struct bead_mark){
        .box = {(float)(z->x - v->look.gap), (float)z->y, (float)(z->x + z->width + v->look.gap), (float)(z->y + z->height)},
        .shape = {(float)from, (float)to, (float)z->x, (float)(z->x + z->width)}};
    const double rgb[3] = {v->look.accent.r, v->look.accent.g, v->look.accent.b};
    for (int c = 0; c < 3; c++)
        v->zoom_mark.rgba[c] = (uint8_t)lround(255 * rgb[c]);
    v->zoom_mark.rgba[3] = 190;
}

static bool lens_changed(const struct bead_view *v)
{
    const struct bead_drawing *d = &v->lens_drawing;
    return !v->drawn || d->now.first != d->old.first || d->now.count != d->old.count || d->now.mark_count != d->old.mark_count ||
           memcmp(d->now.balls, d->old.balls, d->now.count * sizeof *d->now.balls) != 0 ||
           memcmp(d->now.marks, d->old.marks, d->now.mark_count * sizeof *d->now.marks) != 0;
}

/* Pixels that only move with the lens are moved in the frame; others are painted. */
static enum bead_error paint_lens_beads(struct bead_view *v, struct bead_frame *frame, struct bead_changes *changes,
                                        struct bead_message *msg)
{
    const struct bead_rect *r = &v->lens.rect;
    const int by = bead_beads_lens_moves(v);
    const struct bead_spans spans = bead_beads_lens_changes(v, by);
    bead_beads_move(v, &spans, by, frame);
    if (by && changes)
        bead_changes_add(changes, (struct bead_rect){v->area.x + r->x, v->area.y + r->y, r->width, r->height});
    return paint_spans(v, &v->lens_drawing, r, &spans, frame, by ? NULL : changes, msg);
}

/* Not on the canvas: OpenGL takes seven times as long for a wide, low strip, and the strip contains no bead. */
static void paint_zoom(const struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                       struct bead_changes *changes)
{
    const int left = v->zoom.x < (int)v->look.gap ? v->zoom.x : (int)v->look.gap;
    const struct bead_rect rect = {v->zoom.x - left, v->zoom.y, v->zoom.width + left, v->zoom.height};
    const struct bead_rect place = {v->area.x + rect.x, v->area.y + rect.y, rect.width, rect.height};
    const struct bead_ground ground = {frame->pixels, frame->stride, {v->area.x, v->area.y}, rect};
    bead_frame_copy(frame, background, place);
    bead_pixel_kernels_find(NULL)->zoom(&ground, &v->zoom_mark);
    if (changes)
        bead_changes_add(changes, place);
}

static enum bead_error paint_lens(struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                                  struct bead_changes *changes, struct bead_message *msg)
{
    if (v->zoom.height > 0 && (!v->drawn || memcmp(&v->zoom_mark, &v->old_zoom_mark, sizeof v->zoom_mark) != 0))
        paint_zoom(v, frame, background, changes);
    return lens_changed(v) ? paint_lens_beads(v, frame, changes, msg) : BEAD_OK;
}

static enum bead_error beads_draw(struct bead_view *v, double time, struct bead_frame *frame, const struct bead_frame *background,
                                  struct bead_changes *changes, struct bead_message *msg)
{
    if (!v->canvas)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "beads need a canvas to be drawn on");
    enum bead_error err = BEAD_OK;
    if (!v->backdrop) {
        v->area.width = v->area.width < background->width - v->area.x ? v->area.width : background->width - v->area.x;
        v->row.rect.width = v->row.rect.width < v->area.width ? v->row.rect.width : v->area.width;
        err = bead_backdrop_create(v->canvas, background, v->area, &v->backdrop, msg);
        v->plain = bead_beads_lens_is_plain(v, background);
    }
    if (err || v->latest.fed == 0)
        return err;
    v->drawn = v->drawn && changes;
    bead_beads_advance(v, time);
    if (v->strip) {
        struct bead_changes own = {0};
        bead_beads_strip(v, frame, background, changes ? changes : &own);
    } else if (v->row.scale > 0) {
        bead_beads_compose(v, &v->row, &v->row_drawing);
        err = paint_row(v, frame, changes, msg);
    }
    if (!err && v->lens.scale > 0) {
        bead_beads_compose(v, &v->lens, &v->lens_drawing);
        compose_zoom(v);
        err = paint_lens(v, frame, background, changes, msg);
        v->lens_drawn = v->lens.from;
    }
    if (!err && v->labels)
        err = bead_moving_labels_draw(v->labels, v->lens.from, frame, background, changes, msg);
    v->drawn = !err;
    return err;
}

/* The lens also follows the front in frames that are not drawn. */
static void beads_pass(struct bead_view *v, double time)
{
    if (v->latest.fed > 0)
        bead_beads_advance(v, time);
}

static enum bead_error beads_vector(struct bead_view *v, double time, cairo_t *cr, struct bead_message *)
{
    if (v->latest.fed == 0)
        return BEAD_OK;
    bead_beads_advance(v, time);
    if (v->row.scale > 0)
        bead_beads_compose(v, &v->row, &v->row_drawing);
    if (v->lens.scale > 0)
        bead_beads_compose(v, &v->lens, &v->lens_drawing);
    bead_beads_vector(v, cr);
    return BEAD_OK;
}

const struct bead_view_type bead_view_beads_type = {
    .info = &bead_view_infos[BEAD_VIEW_BEADS],
    .fields = beads_fields,
    .create = beads_create,
    .place = beads_place,
    .decorate = bead_beads_decorate,
    .feed = beads_feed,
    .draw = beads_draw,
    .pass = beads_pass,
    .vector = beads_vector,
    .destroy = beads_destroy,
    .margins = bead_beads_margins,
    .most_height = bead_beads_most_height,
    .most_width = bead_beads_most_width,
};
