/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The composed beads as paths, for PDF and SVG. */
#include <math.h>

#include "render/stage/beads.h"

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
