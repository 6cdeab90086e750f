/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the front, smooths its motion and moves a chain's window with it. */
#include "render/stage/camera.h"

#include <math.h>
#include <stdlib.h>

#include "render/stage/latest.h"
#include "render/stage/magnify.h"

/* The wave has reached a contact loaded by this part of the strongest compression. */
static const double reaching = 0.015;
/* In widths of the window: position of the front, from the left edge; distance in which the window speeds up or slows down. */
static const double front_place = 0.7, easing = 0.2;
/* The window extends this many radii beyond the chain: room for a rebounding striker and for a wall. */
static const double before_striker = 2.4, beyond_wall = 0.8, beyond_rest = 0.2;

/* The length of chain that the wave has reached, in beads from the first. `load`: compression of each contact, in units of a strong
 * one; `reached` keeps the largest so far, up to where the contact counts as reached. */
static double find_front(double *reached, const double *load, size_t count)
{
    /* The wave also reached contacts that it passed between two frames. */
    double front = 0, beyond = 0;
    for (size_t i = count; i-- > 0;) {
        reached[i] = fmax(beyond, fmax(reached[i], fmin(1, load[i] / reaching)));
        beyond = reached[i];
        front += reached[i];
    }
    return front;
}

/* Smooths the front, which jumps from bead to bead, over a tenth of the window, at least two beads, at the speed of a front that
 * takes the whole picture to cross the chain. */
struct bead_follower bead_follower_make(double width, double length, size_t beads, double span)
{
    double smooth = fmax(width / 10, 2 * length / fmax(1, (double)beads));
    return (struct bead_follower){.constant = span * fmin(1.0 / 20, length > 0 ? smooth / length : 0)};
}

double bead_follower_advance(struct bead_follower *f, double target, double time)
{
    double part = f->constant > 0 && f->begun ? 1 - exp(-fmax(0, time - f->time) / f->constant) : 1;
    for (int k = 0; k < 3; k++)
        f->context[k] += part * ((k ? f->context[k - 1] : target) - f->context[k]);
    f->time = time;
    f->begun = true;
    return 3 * f->context[1] - 2 * f->context[2]; /* ahead by the lag of the third stage */
}

double bead_window_left(double front, double width, double low, double high)
{
    double x = front - front_place * width;
    if (!(high > low))
        return low;
    double soft = fmin(easing * width, 0.5 * (high - low));
    if (x < low + soft)
        return x <= low - soft ? low : low + (x - low + soft) * (x - low + soft) / (4 * soft);
    if (x > high - soft)
        return x >= high + soft ? high : high - (high + soft - x) * (high + soft - x) / (4 * soft);
    return x;
}

double bead_chain_spacing(const struct bead_chain *chain, struct bead_span beads, double *radius)
{
    const double *r = bead_chain_radius(chain);
    double sum = 0;
    *radius = 0;
    for (size_t i = beads.first; i <= beads.last && i < bead_chain_beads(chain); i++) {
        sum += 2 * r[i];
        *radius = fmax(*radius, r[i]);
    }
    return sum / (double)(beads.last - beads.first + 1);
}

struct bead_camera {
    const double *position; /* m, of the first bead shown on */
    size_t first, count;
    bool wall;             /* a contact follows the last bead */
    double unit;           /* m: the compression that counts as strong */
    double width, ends[2]; /* m: of the window; edges that it may have */
    double *u[2];          /* of the last two samples; u[0] owns the memory of all arrays */
    struct bead_latest latest;
    double *load, *reached;
    struct bead_follower follower;
    double left;
};

enum bead_error bead_camera_create(const struct bead_chain *chain, struct bead_span beads, double width, const double time[2],
                                   struct bead_camera **camera, struct bead_message *msg)
{
    struct bead_camera *c = *camera = calloc(1, sizeof *c);
    size_t all = bead_chain_beads(chain), last = beads.last < all ? beads.last : all - 1;
    if (!c)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a camera");
    c->first = beads.first < last ? beads.first : last;
    c->count = last - c->first + 1;
    c->position = bead_chain_position(chain) + c->first;
    c->wall = last + 1 == all && bead_chain_spec(chain)->wall != BEAD_WALL_NONE;
    c->unit = bead_compression_scale(chain);
    c->u[0] = calloc(4 * c->count, sizeof *c->u[0]);
    c->u[1] = c->u[0] + c->count;
    c->load = c->u[1] + c->count;
    c->reached = c->load + c->count;
    if (!c->u[0]) {
        bead_camera_destroy(c);
        *camera = NULL;
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a camera");
    }
    double radius, spacing = bead_chain_spacing(chain, (struct bead_span){c->first, last}, &radius);
    const double *r = bead_chain_radius(chain);
    c->width = width;
    c->ends[0] = c->position[0] - r[c->first] - (c->first == 0 ? before_striker : beyond_rest) * radius;
    c->ends[1] = c->position[c->count - 1] + r[last] + (c->wall ? beyond_wall : beyond_rest) * radius;
    c->follower = bead_follower_make(width, spacing * (double)c->count, c->count, time[1] - time[0]);
    c->left = c->ends[0];
    return BEAD_OK;
}

void bead_camera_destroy(struct bead_camera *c)
{
    if (!c)
        return;
    free(c->u[0]);
    free(c);
}

enum bead_error bead_camera_feed(struct bead_camera *c, const struct bead_sample *sample, struct bead_message *msg)
{
    const double *u = sample->field[BEAD_FIELD_DISPLACEMENT];
    if (!u)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "a camera needs displacements");
    bead_latest_feed(&c->latest, sample->time);
    memcpy(c->u[c->latest.newest], u + c->first, c->count * sizeof *u);
    return BEAD_OK;
}

/* Position along the chain, m, of a place in beads from the first. */
static double camera_place_of(const struct bead_camera *c, double bead)
{
    double within = fmin(fmax(bead, 0), (double)(c->count - 1)), whole = floor(within);
    size_t i = (size_t)whole, next = i + 1 < c->count ? i + 1 : i;
    return c->position[i] + (within - whole) * (c->position[next] - c->position[i]);
}

void bead_camera_advance(struct bead_camera *c, double time)
{
    double weight = bead_latest_weight(&c->latest, time), here = bead_latest_value(&c->latest, c->u, 0, weight);
    for (size_t i = 0; i < c->count; i++) {
        bool last = i + 1 == c->count;
        double next = last ? (c->wall ? 0 : here) : bead_latest_value(&c->latest, c->u, i + 1, weight);
        c->load[i] = c->unit > 0 ? fmax(0, (here - next) / c->unit) : 0;
        here = next;
    }
    double front = camera_place_of(c, find_front(c->reached, c->load, c->count));
    front = bead_follower_advance(&c->follower, front, time);
    c->left = fmax(c->left, bead_window_left(front, c->width, c->ends[0], c->ends[1] - c->width));
}

double bead_camera_left(const struct bead_camera *c)
{
    return c->left;
}

double bead_camera_width(const struct bead_camera *c)
{
    return c->width;
}
