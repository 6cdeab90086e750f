/* What the beads look like at a time: places, colours, loads, and where the lens is. */
#include <math.h>
#include <string.h>

#include "render/beads.h"

/* A contact counts as reached by the wave when it is loaded by this part of the strongest compression. */
static const double reaching = 0.015;
/* The lens follows the front with this part of the picture's time span as its time constant, twice. */
static const double following = 1.0 / 120;
/* Where the front lies in the lens, from its left. */
static const double front_place = 0.7;
/* Colours are those of the material below, those of the map above this distance from zero along the colour bar. */
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

/* Part of the way from the sample before to the newest. */
static double weight_of(const struct bead_view *v, double time)
{
    double before = v->time[1 - v->newest], span = v->time[v->newest] - before;
    return v->fed < 2 || !(span > 0) ? 1 : between((time - before) / span, 0, 1);
}

static void colour_bead(struct bead_view *v, size_t i, double value, double zero)
{
    const struct bead_scene *scene = bead_chain_scene(v->setup.chain);
    const double *own = scene->materials[bead_chain_material(v->setup.chain)[v->first + i]].colour;
    double place = between(bead_colours_place(&v->setup.colours, value), 0, 1);
    double weight = between(fabs(place - zero) / colour_full, 0, 1);
    weight = weight * weight * (3 - 2 * weight);
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
        v->reached[i] = fmax(v->reached[i], fmin(1, v->load[i] / reaching));
    }
    /* What was passed over between two frames was reached too. */
    double front = 0;
    for (size_t i = v->count; i-- > 0;) {
        if (i + 1 < v->count)
            v->reached[i] = fmax(v->reached[i], v->reached[i + 1]);
        front += v->reached[i];
    }
    v->front = front;
}

/* Two low passes in a row: the lens starts and stops softly. */
static void follow(struct bead_view *v, double time)
{
    double constant = following * (v->setup.time[1] - v->setup.time[0]);
    double part = constant > 0 ? 1 - exp(-fmax(0, time - v->drawn_time) / constant) : 1;
    if (isnan(v->drawn_time))
        part = 1;
    v->follower[0] += part * (v->front - v->follower[0]);
    v->follower[1] += part * (v->follower[0] - v->follower[1]);
    v->drawn_time = time;
}

static void aim(struct bead_view *v)
{
    struct bead_window *lens = &v->lens;
    if (!(lens->scale > 0))
        return;
    double bead = between(v->follower[1], 0, (double)(v->count - 1)), whole = floor(bead);
    size_t i = (size_t)whole, next = i + 1 < v->count ? i + 1 : i;
    double place = v->position[i] + (bead - whole) * (v->position[next] - v->position[i]);
    double width = lens->rect.width / lens->scale;
    double lowest = v->ends[0] - (v->striker ? 2.4 : 0.2) * v->largest;
    double highest = v->ends[1] + (v->wall ? 0.8 : 0.2) * v->largest - width;
    lens->from = fmax(lowest, fmin(highest, place - front_place * width));
}

void bead_beads_advance(struct bead_view *v, double time)
{
    double weight = weight_of(v, time), zero = between(bead_colours_place(&v->setup.colours, 0), 0, 1);
    for (size_t i = 0; i < v->count; i++) {
        v->shift[i] = v->setup.magnify * value_at(v, (const double *const *)v->u, i, weight);
        colour_bead(v, i, value_at(v, (const double *const *)v->value, i, weight), zero);
    }
    double span = v->time[v->newest] - v->time[1 - v->newest];
    v->speed = bead_chain_spec(v->setup.chain)->striker_velocity;
    if (v->fed >= 2 && span > 0)
        v->speed = (v->u[v->newest][0] - v->u[1 - v->newest][0]) / span;
    find_loads(v);
    follow(v, time);
    aim(v);
}
