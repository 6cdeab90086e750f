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
