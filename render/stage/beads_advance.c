/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the beads at one time: positions, colours, loads, place of the lens. First step of every draw of the beads view. */
#include <math.h>

#include "render/colour/colour_table.h"
#include "render/stage/beads.h"
#include "sim/chain/chain_internal.h"

/* Distance from the value at rest, along the colour bar, from which a bead no longer shows its material's colour. */
static const double colour_full = 0.3;

static double between(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

double bead_colour_weight(const struct bead_view *v, double value)
{
    double place = bead_colours_place(&v->setup.colours, value),
           zero = bead_colours_place(&v->setup.colours, v->setup.colours.rest);
    double weight = between(fabs(between(place, 0, 1) - between(zero, 0, 1)) / colour_full, 0, 1);
    return weight * weight * (3 - 2 * weight);
}

static void colour_bead(struct bead_view *v, size_t i, double value)
{
    const double *own = bead_chain_colour(v->setup.chain, v->first + i);
    double weight = bead_colour_weight(v, value);
    const uint8_t *force = v->map.rgb[bead_colours_index(&v->setup.colours, value)];
    for (int c = 0; c < 3; c++)
        v->colour[i][c] = (uint8_t)lround((1 - weight) * 255 * between(own[c], 0, 1) + weight * force[c]);
    v->colour[i][3] = 255;
}

static void find_loads(struct bead_view *v)
{
    double unit = v->setup.magnify * v->compression;
    for (size_t i = 0; i < v->count; i++) {
        double next = i + 1 < v->count ? v->shift[i + 1] : v->wall ? 0 : v->shift[i];
        v->load[i] = unit > 0 ? fmax(0, (v->shift[i] - next) / unit) : 0;
    }
}

/* The lens shows the camera's window. */
static void aim(struct bead_view *v, double time)
{
    struct bead_window *lens = &v->lens;
    if (v->camera) {
        bead_camera_advance(v->camera, time);
        /* Whole pixels, so that beads at rest look alike wherever the lens is; encoders find them again. */
        lens->from = v->ends[0] + round((bead_camera_left(v->camera) - v->ends[0]) * lens->scale) / lens->scale;
    } else if (lens->scale > 0) {
        lens->from = bead_camera_left(v->setup.camera);
    }
}

void bead_beads_advance(struct bead_view *v, double time)
{
    const struct bead_latest *l = &v->latest;
    double weight = bead_latest_weight(l, time), span = l->time[l->newest] - l->time[1 - l->newest];
    for (size_t i = 0; i < v->count; i++) {
        v->shift[i] = v->setup.magnify * bead_latest_value(l, v->u, i, weight);
        v->shown[i] = bead_latest_value(l, v->value, i, weight);
        colour_bead(v, i, v->shown[i]);
    }
    v->speed = bead_chain_spec(v->setup.chain)->striker_velocity;
    if (l->fed == 2 && span > 0)
        v->speed = (v->u[l->newest][0] - v->u[1 - l->newest][0]) / span;
    find_loads(v);
    aim(v, time);
}

/* The composed beads as paths, for PDF and SVG. */

static void shade(cairo_pattern_t *pattern, double at, const uint8_t *rgba, double light)
{
    double c[3];
    for (int i = 0; i < 3; i++)
        c[i] = light <= 1 ? light * rgba[i] / 255.0 : 1 - (2 - light) * (1 - rgba[i] / 255.0);
    cairo_pattern_add_color_stop_rgb(pattern, at, c[0], c[1], c[2]);
}

static void draw_ball(const struct bead_ball *b, cairo_t *cr)
{
    double left = fmax(b->x - b->r, b->left), right = fmin(b->x + b->r, b->right);
    cairo_save(cr);
    cairo_rectangle(cr, left, b->y - b->r, right - left, 2 * b->r);
    cairo_clip(cr);
    cairo_pattern_t *pattern = cairo_pattern_create_radial(b->x - 0.3 * b->r, b->y - 0.35 * b->r, 0, b->x, b->y, b->r);
    shade(pattern, 0, b->rgba, 1.25);
    shade(pattern, 0.55, b->rgba, 0.95);
    shade(pattern, 1, b->rgba, 0.5);
    cairo_set_source(cr, pattern);
    cairo_pattern_destroy(pattern);
    cairo_arc(cr, b->x, b->y, b->r, 0, 2 * M_PI);
    cairo_fill(cr);
    cairo_restore(cr);
}

static void draw_rings(const struct bead_drawing *d, cairo_t *cr)
{
    for (size_t i = 0; i < d->now.mark_count; i++) {
        const struct bead_mark *m = &d->now.marks[i];
        if (m->kind != BEAD_MARK_RING)
            continue;
        cairo_set_source_rgb(cr, m->rgba[0] / 255.0, m->rgba[1] / 255.0, m->rgba[2] / 255.0);
        cairo_set_line_width(cr, m->shape[1]);
        cairo_arc(cr, 0.5 * (m->box[0] + m->box[2]), 0.5 * (m->box[1] + m->box[3]), m->shape[0], 0, 2 * M_PI);
        cairo_stroke(cr);
    }
}

void bead_beads_vector(struct bead_view *v, cairo_t *cr)
{
    const struct bead_window *windows[2] = {&v->row, &v->lens};
    const struct bead_drawing *drawings[2] = {&v->row_drawing, &v->lens_drawing};
    cairo_save(cr);
    cairo_translate(cr, v->area.x, v->area.y);
    for (int k = 0; k < 2; k++) {
        const struct bead_rect *r = &windows[k]->rect;
        if (!(windows[k]->scale > 0))
            continue;
        cairo_save(cr);
        cairo_rectangle(cr, r->x, r->y, r->width, r->height);
        cairo_clip(cr);
        for (size_t i = 0; i < drawings[k]->now.count; i++)
            draw_ball(&drawings[k]->now.balls[i], cr);
        draw_rings(drawings[k], cr);
        cairo_restore(cr);
    }
    cairo_restore(cr);
}
