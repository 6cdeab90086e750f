/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the beads at one time: positions, colours, loads, and where the lens is. First step of every draw of the beads view.
 */
#include <math.h>
#include <string.h>

#include "render/view/beads.h"

/* Below the first distance from zero, along the colour bar, a bead has its material's colour; above the second, the map's. */
static const double colour_full = 0.3;

static double between(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

static double value_at(const struct bead_view *v, const double *const data[2], size_t i, double weight)
{
    double newest = data[v->newest][i];
    return weight >= 1 ? newest : data[1 - v->newest][i] + weight * (newest - data[1 - v->newest][i]);
}

/* How far `time` is from the previous sample to the newest, 0..1. */
static double beads_weight_of(const struct bead_view *v, double time)
{
    double before = v->time[1 - v->newest], span = v->time[v->newest] - before;
    return v->fed < 2 || !(span > 0) ? 1 : between((time - before) / span, 0, 1);
}

static double weight_from(double place, double zero)
{
    double weight = between(fabs(between(place, 0, 1) - zero) / colour_full, 0, 1);
    return weight * weight * (3 - 2 * weight);
}

double bead_colour_weight(const struct bead_view *v, double value)
{
    return weight_from(bead_colours_place(&v->setup.colours, value), between(bead_colours_place(&v->setup.colours, 0), 0, 1));
}

static void colour_bead(struct bead_view *v, size_t i, double value, double zero)
{
    const double *own = bead_chain_colour(v->setup.chain, v->first + i);
    double weight = weight_from(bead_colours_place(&v->setup.colours, value), zero);
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
    v->front = bead_front_find(v->reached, v->load, v->count);
}

/* The lens goes where the camera goes, or follows the front. */
static void aim(struct bead_view *v, double time)
{
    struct bead_window *lens = &v->lens;
    if (!(lens->scale > 0))
        return;
    if (v->setup.camera) {
        lens->from = bead_camera_left(v->setup.camera);
        return;
    }
    double bead = between(v->front, 0, (double)(v->count - 1)), whole = floor(bead);
    size_t i = (size_t)whole, next = i + 1 < v->count ? i + 1 : i;
    double place = v->position[i] + (bead - whole) * (v->position[next] - v->position[i]);
    double width = lens->rect.width / lens->scale;
    double lowest = v->ends[0] - (v->striker ? 2.4 : 0.2) * v->largest;
    double highest = v->ends[1] + (v->wall ? 0.8 : 0.2) * v->largest - width;
    double left = bead_window_left(bead_follower_advance(&v->follower, place, time), width, lowest, highest);
    /* Whole pixels, so that beads at rest look the same wherever the lens is; encoders find them again. */
    lens->from = v->ends[0] + round((left - v->ends[0]) * lens->scale) / lens->scale;
}

void bead_beads_advance(struct bead_view *v, double time)
{
    double weight = beads_weight_of(v, time), zero = between(bead_colours_place(&v->setup.colours, 0), 0, 1);
    for (size_t i = 0; i < v->count; i++) {
        v->shift[i] = v->setup.magnify * value_at(v, (const double *const *)v->u, i, weight);
        v->shown[i] = value_at(v, (const double *const *)v->value, i, weight);
        colour_bead(v, i, v->shown[i], zero);
    }
    double span = v->time[v->newest] - v->time[1 - v->newest];
    v->speed = bead_chain_spec(v->setup.chain)->striker_velocity;
    if (v->fed >= 2 && span > 0)
        v->speed = (v->u[v->newest][0] - v->u[1 - v->newest][0]) / span;
    find_loads(v);
    aim(v, time);
}
