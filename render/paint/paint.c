/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the arguments of painting functions; the back end of the canvas paints (paint_gl.c, and plain pixels below). */
#include "render/paint/paint.h"

#include <stdlib.h>

#include "render/paint/canvas_private.h"
#include "sim/base/memory.h"

static bool inside(struct bead_rect rect, int width, int height)
{
    return rect.x >= 0 && rect.y >= 0 && rect.width <= width - rect.x && rect.height <= height - rect.y;
}

enum bead_error bead_backdrop_create(struct bead_canvas *canvas, const struct bead_frame *frame, struct bead_rect place,
                                     struct bead_backdrop **backdrop, struct bead_message *msg)
{
    const struct bead_painting *painting = canvas->driver->painting;
    *backdrop = NULL;
    if (place.width < 1 || place.height < 1 || !inside(place, frame->width, frame->height))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "a backdrop of %d x %d pixels at %d, %d is outside its frame", place.width,
                         place.height, place.x, place.y);
    struct bead_backdrop *b;
    BEAD_TRY(bead_new(&b, 1, msg, "a backdrop"));
    b->place = place;
    enum bead_error err = painting->keep(canvas, b, frame, msg);
    if (err)
        bead_backdrop_destroy(canvas, b);
    else
        *backdrop = b;
    return err;
}

void bead_backdrop_destroy(struct bead_canvas *canvas, struct bead_backdrop *backdrop)
{
    if (!backdrop)
        return;
    canvas->driver->painting->forget(canvas, backdrop);
    free(backdrop);
}

enum bead_error bead_paint_begin(struct bead_canvas *canvas, const struct bead_backdrop *backdrop, struct bead_frame *frame,
                                 struct bead_rect rect, struct bead_message *msg)
{
    canvas->frame = NULL;
    if (rect.width <= 0 || rect.height <= 0)
        return BEAD_OK;
    if (!inside(rect, backdrop->place.width, backdrop->place.height) || !inside(rect, canvas->width, canvas->height) ||
        !inside(backdrop->place, frame->width, frame->height))
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "painting %d x %d pixels at %d, %d: outside backdrop, canvas or frame",
                         rect.width, rect.height, rect.x, rect.y);
    canvas->backdrop = backdrop;
    canvas->frame = frame;
    canvas->rect = rect;
    enum bead_error err = canvas->driver->painting->begin(canvas, msg);
    if (err)
        canvas->frame = NULL;
    return err;
}

void bead_paint_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count)
{
    if (canvas->frame && count > 0)
        canvas->driver->painting->balls(canvas, balls, count);
}

void bead_paint_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count)
{
    if (canvas->frame && count > 0)
        canvas->driver->painting->marks(canvas, marks, count);
}

enum bead_error bead_paint_end(struct bead_canvas *canvas, struct bead_message *msg)
{
    enum bead_error err = canvas->frame ? canvas->driver->painting->end(canvas, msg) : BEAD_OK;
    canvas->frame = NULL;
    return err;
}

enum bead_error bead_paint_stage(struct bead_canvas *canvas, const struct bead_stage *stage, struct bead_rect place, int skip,
                                 struct bead_frame *frame, struct bead_message *msg)
{
    const struct bead_rect clip = {0, skip, place.width, place.height - skip};
    if (clip.width <= 0 || clip.height <= 0)
        return BEAD_OK;
    const int fine = bead_stage_fine(stage);
    if (!inside(place, frame->width, frame->height) || place.width * fine > stage->width || place.height * fine > stage->height)
        return bead_fail(msg, BEAD_ERROR_GRAPHICS, "painting a stage of %d x %d pixels at %d, %d: outside its frame", place.width,
                         place.height, place.x, place.y);
    const struct bead_ground ground = {frame->pixels, frame->stride, {place.x, place.y}, clip};
    const struct bead_painting *painting = fine > 1 ? &bead_painting_plain : canvas->driver->painting; /* the others are alike */
    return painting->stage(canvas, stage, &ground, msg);
}

/* Painting without OpenGL, straight into the frame. It has no state of its own. */

static enum bead_error plain_open(struct bead_canvas *canvas, struct bead_message *)
{
    const char *set = bead_pixel_kernels_find(NULL)->name;
    snprintf(canvas->description, sizeof canvas->description, "%s, %s", canvas->driver->info.name, set);
    snprintf(canvas->credit, sizeof canvas->credit, "%s (%s)", canvas->driver->title, set);
    return BEAD_OK;
}

static void plain_close(struct bead_canvas *) {}

static void copy(struct bead_frame *to, int to_x, int to_y, const struct bead_frame *from, struct bead_rect rect)
{
    for (int y = 0; y < rect.height; y++)
        memcpy(to->pixels + (size_t)(to_y + y) * to->stride + 4 * (size_t)to_x,
               from->pixels + (size_t)(rect.y + y) * from->stride + 4 * (size_t)rect.x, 4 * (size_t)rect.width);
}

static enum bead_error plain_keep(struct bead_canvas *, struct bead_backdrop *backdrop, const struct bead_frame *frame,
                                  struct bead_message *msg)
{
    enum bead_error err = bead_frame_create(backdrop->place.width, backdrop->place.height, &backdrop->copy, msg);
    if (!err)
        copy(&backdrop->copy, 0, 0, frame, backdrop->place);
    return err;
}

static void plain_forget(struct bead_canvas *, struct bead_backdrop *backdrop)
{
    bead_frame_free(&backdrop->copy);
}

static enum bead_error plain_begin(struct bead_canvas *canvas, struct bead_message *)
{
    const struct bead_rect rect = canvas->rect, *place = &canvas->backdrop->place;
    copy(canvas->frame, place->x + rect.x, place->y + rect.y, &canvas->backdrop->copy, rect);
    return BEAD_OK;
}

static struct bead_ground ground_of(const struct bead_canvas *canvas)
{
    const struct bead_rect *place = &canvas->backdrop->place;
    return (struct bead_ground){
        .pixels = canvas->frame->pixels, .stride = canvas->frame->stride, .origin = {place->x, place->y}, .clip = canvas->rect};
}

static void plain_balls(struct bead_canvas *canvas, const struct bead_ball *balls, size_t count)
{
    const struct bead_ground ground = ground_of(canvas);
    bead_pixel_kernels_find(NULL)->balls(&ground, balls, count);
}

static void plain_marks(struct bead_canvas *canvas, const struct bead_mark *marks, size_t count)
{
    const struct bead_ground ground = ground_of(canvas);
    bead_pixel_kernels_find(NULL)->marks(&ground, marks, count);
}

static enum bead_error plain_end(struct bead_canvas *, struct bead_message *)
{
    return BEAD_OK;
}

static enum bead_error plain_stage(struct bead_canvas *, const struct bead_stage *stage, const struct bead_ground *ground,
                                   struct bead_message *)
{
    const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(NULL);
    kernels->stage_floor(stage);
    kernels->stage(ground, stage);
    return BEAD_OK;
}

const struct bead_painting bead_painting_plain = {
    .open = plain_open,
    .close = plain_close,
    .keep = plain_keep,
    .forget = plain_forget,
    .begin = plain_begin,
    .balls = plain_balls,
    .marks = plain_marks,
    .end = plain_end,
    .stage = plain_stage,
};
