/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the arguments of painting functions; the back end of the canvas paints (paint_gl.c, paint_plain.c). */
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
