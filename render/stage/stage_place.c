/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places the stage and the row of all beads in the view's rectangle, and draws the parts that never change. */
#include <math.h>

#include "render/stage/stage_key.h"
#include "render/stage/stage_view.h"
#include "sim/chain/chain_internal.h"

/* In radii of the largest bead, from the row of its centre: how far light reaches above, and most of it; the floor with its images,
 * and the same if there is room. */
static const double light_above = 1.28, least_above = 1.15, least_below = 1.75, roomy_below = 2.2;
/* Beads side by side: more are in view if the stage is low, fewer only if there are no more. */
static const double least_across = 14.5, best_across = 16;
/* In bare pictures, where only the stage shows what happens: a pulse of five beads and two on both sides. */
static const double bare_across = 9;
/* For small stages side by side, whose beads have half the width: a pulse of five beads and three on both sides. */
static const double small_across = 11;
/* Beyond the beads at rest at the ends, in radii of the largest: for a striker that flies back; a wall; a last bead that moves
 * on. */
static const double before_striker = 1.6, beyond_wall = 1.3, beyond_rest = 0.8;
/* Along and across a pixel of a fine stage. */
static const int rays = 3;
/* Beads that a pulse needs to stay whole in the window; the camera moves on by the others. */
static const double pulse = 5;

/* Height for the key, and for a heading at its left. */
static double headroom(const struct bead_view *v)
{
    return ceil(1.5 * v->look.label);
}

static double length_of(const struct bead_view *v, double ends[2])
{
    const bool striker = v->first == 0 && bead_chain_spec(v->setup.chain)->striker_velocity > 0;
    const double swing = v->setup.magnify * bead_chain_swing(v->setup.chain);
    ends[0] = v->ends[0] - fmax(swing, (striker ? before_striker : beyond_rest) * v->largest);
    ends[1] = v->ends[1] + (v->wall ? beyond_wall * v->largest : fmax(swing, beyond_rest * v->largest));
    return ends[1] - ends[0];
}

static double largest_radius(double height)
{
    return height / (least_above + least_below);
}

static double across(const struct bead_view *v)
{
    return !v->setup.axes ? bare_across : v->setup.small ? small_across : least_across;
}

/* All beads are on the stage if they can be nearly as large as a few above a row of all, and if there is no wave to follow. For a
 * cradle, where a wave takes a few microseconds and a swing a second, half as large: empirical, so that twenty balls that swing by
 * twelve radii are in view; rows that are longer, or swing further, have a camera, which does not follow swings. */
static bool shows_all(const struct bead_view *v, double width, double height, double length)
{
    const double wanted = fmin(largest_radius(height), width / (2 * (v->setup.small ? small_across : best_across)));
    const double part = bead_chain_spec(v->setup.chain)->cradle > 0 ? 0.4 : 0.8;
    return !v->setup.camera && (!v->has_contacts || width * v->largest / length >= part * wanted);
}

/* The radius of the largest beads, px. */
static double choose_radius(const struct bead_view *v, double width, double height, double length, bool all)
{
    if (v->setup.camera) /* other views also show its window */
        return v->largest * v->plot.width / bead_camera_width(v->setup.camera);
    const double r = fmin(largest_radius(height), all ? width * v->largest / length : width / (2 * across(v)));
    return fmax(1, floor(2 * r) / 2);
}

double bead_stage_height(double width)
{
    return (light_above + roomy_below) * width / (2 * least_across);
}

static void set_camera(struct bead_view *v, const double ends[2])
{
    const double spacing = v->count > 1 ? (v->place[v->count - 1] - v->place[0]) / (double)(v->count - 1) : 2 * v->largest;
    const double across = v->strip.width / (spacing * v->scale), beads = floor(fmax(across - pulse, 0.5 * across));
    v->camera = (struct bead_step_camera){.width = v->strip.width,
                                          .step = round(beads * spacing * v->scale),
                                          .margin = fmin(0.5 * pulse * spacing * v->scale, 0.25 * v->strip.width),
                                          .ends = {ends[0] * v->scale, ends[1] * v->scale}};
}

static void set_row(struct bead_view *v, int height)
{
    const double length = v->position[v->count - 1] - v->position[0] + v->radius[0] + v->radius[v->count - 1];
    v->row = (struct bead_rect){v->strip.x, v->strip.y + v->strip.height, v->strip.width, height};
    v->row_scale = v->plot.width / length;
    v->row_left = v->plot.x - v->strip.x + v->radius[0] * v->row_scale;
}

enum bead_error bead_stage_divide(struct bead_view *v, struct bead_message *msg)
{
    const struct bead_look *look = &v->look;
    const int *beyond = v->setup.beyond;
    double ends[2];
    const double length = length_of(v, ends), em = look->tick, width = v->plot.width + beyond[0] + beyond[1];
    const bool film = v->setup.fill, tall = v->plot.height > 9 * em;
    const double head = film ? v->setup.head : v->setup.axes && tall ? headroom(v) : 0;
    const double numbers = v->setup.axes && v->setup.bead_labels && (film || tall) ? ceil(BEAD_STAGE_NUMBERS * em) : 0;
    const double row = v->setup.axes ? ceil(fmax(6, 0.8 * em)) : 0;
    const bool all = shows_all(v, width, v->plot.height - head - numbers - row, length);
    double below = numbers + (all ? 0 : row);
    const double r = choose_radius(v, width, v->plot.height - head - below, length, all);
    const bool rowless =
        all || !v->setup.axes || (v->plot.height - below < 2.6 * r && numbers == 0); /* the large beads come first */
    below = numbers + (rowless ? 0 : row);
    v->strip = (struct bead_rect){v->plot.x - beyond[0], v->plot.y, (int)width, (int)(v->plot.height - below)};
    v->scale = r / v->largest;
    if (all)
        v->left = floor(0.5 * ((ends[0] + ends[1]) * v->scale - width));
    else
        set_camera(v, ends);
    if (rowless)
        v->row = (struct bead_rect){v->strip.x, v->strip.y + v->strip.height, v->strip.width, 0};
    else
        set_row(v, (int)row);
    /* Spare height goes below first; missing height is taken from the image in the floor rather than from the beads. */
    const double spare = v->strip.height - head - (least_above + least_below) * r;
    const double more = spare > 0 ? 0.5 * fmax(0, spare - (roomy_below - least_below) * r) : 0.2 * spare;
    const double centre = ceil(head + least_above * r + more);
    v->head = (int)fmax(fmax(0, head), floor(centre - light_above * r));
    v->stage.theme = look->dark ? &bead_stage_dark : &bead_stage_light;
    const int fine = v->stage.fine = v->setup.fine ? rays : 1;
    v->stage.width = fine * v->strip.width;
    v->stage.height = fine * v->strip.height;
    v->stage.unit = (float)(fine * r);
    v->stage.centre = (float)(fine * centre);
    v->stage.room = v->count;
    return bead_stage_open(&v->stage, msg);
}

/* ---- what never changes ---- */

static void draw_backdrop(const struct bead_view *v, cairo_t *cr)
{
    for (int y = 0; y < v->strip.height; y++) {
        float base[3];
        bead_stage_base(&v->stage, (float)v->stage.fine * ((float)y + 0.5f), base);
        cairo_set_source_rgb(cr, bead_stage_shown(base[0]), bead_stage_shown(base[1]), bead_stage_shown(base[2]));
        cairo_rectangle(cr, v->strip.x, v->strip.y + y, v->strip.width, 1);
        cairo_fill(cr);
    }
}

enum bead_error bead_stage_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *)
{
    if (!v->look.clear)
        draw_backdrop(v, cr);
    bead_stage_draw_names(v, cr);
    if (v->setup.axes && v->head >= headroom(v))
        bead_stage_draw_key(v, cr);
    return BEAD_OK;
}
