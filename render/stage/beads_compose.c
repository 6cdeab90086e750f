/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns positions and colours into balls and marks for the canvas to paint. Second step of every draw of the beads view. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/stage/beads.h"

/* Positions are rounded to this fraction of a pixel: motion is smooth, and a bead at rest is not redrawn. */
static const double steps_per_pixel = 64;

static float on_grid(double x)
{
    return (float)(round(x * steps_per_pixel) / steps_per_pixel);
}

double bead_window_x(const struct bead_window *window, double position)
{
    return window->left + (position - window->from) * window->scale;
}

static double bead_x(const struct bead_view *v, const struct bead_window *w, size_t i)
{
    return bead_window_x(w, v->position[i] + v->shift[i]);
}

/* The range of beads that may extend into the window. */
static void find_visible(const struct bead_view *v, const struct bead_window *w, size_t *first, size_t *count)
{
    double from = w->rect.x - 2.0, to = w->rect.x + w->rect.width + 2.0;
    size_t begin = v->count, end = 0;
    for (size_t i = 0; i < v->count; i++) {
        double x = bead_x(v, w, i), r = v->radius[i] * w->scale;
        if (x + r < from || x - r > to)
            continue;
        begin = i < begin ? i : begin;
        end = i + 1;
    }
    *first = begin < end ? begin : 0;
    *count = begin < end ? end - begin : 0;
}

static void set_ball(const struct bead_view *v, const struct bead_window *w, size_t i, struct bead_ball *ball)
{
    double r = v->radius[i] * w->scale;
    float x = on_grid(bead_x(v, w, i));
    /* The soft edge adds 1/12 to the squared radius; subtracting it keeps the area. */
    float soft = (float)sqrt(fmax(r * r - 1.0 / 12, 0.04));
    *ball = (struct bead_ball){.x = x, .y = (float)w->middle, .r = soft, .left = x - soft - 2, .right = x + soft + 2};
    memcpy(ball->rgba, v->colour[i], sizeof ball->rgba);
}

/* Two beads that overlap meet in a plane. */
static void flatten(struct bead_ball *a, struct bead_ball *b)
{
    float distance = b->x - a->x;
    if (distance >= a->r + b->r || distance <= 0)
        return;
    a->right = b->left = a->x + distance * a->r / (a->r + b->r);
}

static uint8_t glow_of(const struct bead_view *v, const struct bead_window *w, size_t i)
{
    double load = fmin(1, v->load[i] * 1.1);
    return v->radius[i] * w->scale < 3 ? 0 : (uint8_t)lround(255 * load * sqrt(load));
}

static struct bead_mark *add_mark(struct bead_drawing *d, enum bead_mark_kind kind, double x0, double y0, double x1, double y1)
{
    struct bead_mark *mark = &d->now.marks[d->now.mark_count++];
    *mark = (struct bead_mark){.box = {(float)x0, (float)y0, (float)x1, (float)y1}, .kind = (float)kind};
    return mark;
}

static void paint_mark(struct bead_mark *mark, struct bead_rgb colour, double alpha)
{
    const double rgba[4] = {colour.r, colour.g, colour.b, alpha};
    for (int c = 0; c < 4; c++)
        mark->rgba[c] = (uint8_t)lround(255 * fmin(1, fmax(0, rgba[c])));
}

static void ring(const struct bead_view *v, const struct bead_window *w, struct bead_drawing *d, size_t i, struct bead_rgb colour)
{
    /* As wide as lines of axes, but for what a small bead has room for. */
    double r = v->radius[i] * w->scale, width = fmax(0.07 * r, fmin(fmax(1.2, v->look.line), 0.4 * r));
    if (r < 3 || i < d->now.first || i >= d->now.first + d->now.count)
        return;
    double x = d->now.balls[i - d->now.first].x; /* moves only with its ball */
    struct bead_mark *mark = add_mark(d, BEAD_MARK_RING, x - r - 1, w->middle - r - 1, x + r + 1, w->middle + r + 1);
    mark->shape[0] = (float)(r - 0.5 * width);
    mark->shape[1] = (float)width;
    paint_mark(mark, colour, 1);
}

/* The striker's speed, as an arrow behind it. */
static void arrow(const struct bead_view *v, const struct bead_window *w, struct bead_drawing *d)
{
    double full = fabs(bead_chain_spec(v->setup.chain)->striker_velocity);
    double r = v->radius[0] * w->scale, part = full > 0 ? v->speed / full : 0;
    double length = on_grid(2 * r * fmin(1.2, part)), tip = on_grid(bead_x(v, w, 0) - 1.25 * r);
    if (r < 3 || length < 3 || d->now.first > 0 || d->now.count == 0)
        return;
    paint_mark(add_mark(d, BEAD_MARK_ARROW, tip - length, w->middle - 0.55 * r, tip, w->middle + 0.55 * r), v->look.accent, 1);
}

static void wall_mark(const struct bead_view *v, const struct bead_window *w, struct bead_drawing *d)
{
    const struct bead_chain_spec *spec = bead_chain_spec(v->setup.chain);
    double x = bead_window_x(w, v->ends[1]), y = w->rect.y;
    if (x > w->rect.x + w->rect.width + 2)
        return;
    bool rigid = spec->wall == BEAD_WALL_RIGID;
    struct bead_mark *mark =
        add_mark(d, rigid ? BEAD_MARK_HATCHED : BEAD_MARK_BOX, x, y, x + 2 * v->largest * w->scale, y + w->rect.height);
    struct bead_rgb colour = v->look.faint;
    if (!rigid) {
        const double *own = bead_chain_scene(v->setup.chain)->materials[spec->wall_material].colour;
        colour = (struct bead_rgb){own[0], own[1], own[2]};
    }
    mark->shape[0] = (float)fmax(6, 0.35 * v->largest * w->scale);
    paint_mark(mark, colour, 1);
}

static void glow_marks(const struct bead_view *v, const struct bead_window *w, struct bead_drawing *d)
{
    for (size_t i = 0; i < d->now.count; i++) {
        if (d->now.glow[i] == 0)
            continue;
        const struct bead_ball *ball = &d->now.balls[i];
        double least = i + 1 < d->now.count ? fminf(ball->r, d->now.balls[i + 1].r) : ball->r;
        double x = fminf(ball->right, ball->x + ball->r), half = 0.8 * least, wide = 0.34 * least;
        struct bead_mark *mark = add_mark(d, BEAD_MARK_GLOW, x - wide, w->middle - half, x + wide, w->middle + half);
        struct bead_rgb white = {1, 0.97, 0.9}, ink = v->look.ink;
        paint_mark(mark, v->look.dark ? white : ink, 0.65 * d->now.glow[i] / 255.0);
    }
}

static void swap(struct bead_drawing *d)
{
    struct bead_composed spare = d->old;
    d->old = d->now;
    d->now = spare;
    d->now.count = d->now.mark_count = 0;
}

void bead_beads_compose(struct bead_view *v, const struct bead_window *w, struct bead_drawing *d)
{
    swap(d);
    find_visible(v, w, &d->now.first, &d->now.count);
    for (size_t i = 0; i < d->now.count; i++) {
        set_ball(v, w, d->now.first + i, &d->now.balls[i]);
        d->now.glow[i] = glow_of(v, w, d->now.first + i);
        if (i > 0)
            flatten(&d->now.balls[i - 1], &d->now.balls[i]);
    }
    bool at_wall = v->wall && d->now.count > 0 && d->now.first + d->now.count == v->count;
    if (at_wall)
        d->now.balls[d->now.count - 1].right = fminf(d->now.balls[d->now.count - 1].right, (float)bead_window_x(w, v->ends[1]));
    if (v->striker) {
        arrow(v, w, d);
        ring(v, w, d, 0, v->look.accent);
    }
    size_t sensors;
    const struct bead_sensor *sensor = bead_chain_sensors(v->setup.chain, &sensors);
    for (size_t s = 0; s < sensors; s++) {
        if (sensor[s].bead >= v->first && sensor[s].bead < v->first + v->count)
            ring(v, w, d, sensor[s].bead - v->first, v->look.ink);
    }
    if (w == &v->lens && v->wall)
        wall_mark(v, w, d);
    glow_marks(v, w, d);
}
