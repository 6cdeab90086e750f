/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Painting without OpenGL, straight into the frame. It has no state of its own. */

#include "render/paint/canvas_private.h"

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
