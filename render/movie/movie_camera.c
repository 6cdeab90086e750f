/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a movie that follows the front: windows of one length, and the widths of the plots that show them. Part of
 * creating a composer. */
#include <math.h>
#include <stdlib.h>

#include "render/movie/composer_private.h"
#include "render/view/camera.h"

struct bead_span bead_composer_beads(const struct bead_composer *c, size_t chain)
{
    size_t last = bead_chain_beads(c->setup.chains[chain]) - 1;
    struct bead_span span = c->setup.output->shown.beads;
    span.last = span.last < last ? span.last : last;
    span.first = span.first < span.last ? span.first : span.last;
    return span;
}

/* The width, px, that windows of `width` m can have: beads with radii up to `largest` m must not be higher than their rows. */
static double window_room(const struct bead_composer *c, double width, double largest)
{
    double room = c->layout.chains[0].plot[0].width;
    for (size_t v = 0; v < c->wants.view_count; v++) {
        const struct bead_rect *plot = &c->layout.chains[0].plot[v];
        bool named = c->wants.sensors || c->layout.chains[0].labels[v];
        double names = named && plot->height > 2.6 * c->look.tick ? 1.35 * c->look.tick : 0;
        if (bead_view_has(c->wants.views[v], BEAD_SHOWS_BEADS))
            room = fmin(room, floor(0.9 * (plot->height - names) * width / (2 * largest)));
    }
    return room;
}

/* Makes views that follow the front no wider than `room`. */
static void narrow_moving(struct bead_composer *c, double room)
{
    for (size_t i = 0; i < c->wants.chain_count * c->wants.view_count; i++) {
        size_t view = i % c->wants.view_count;
        struct bead_rect *plot = &c->layout.chains[i / c->wants.view_count].plot[view];
        if (bead_view_has(c->wants.views[view], BEAD_FOLLOWS_FRONT))
            plot->width = (int)fmin(plot->width, fmax(room, 1));
    }
}

/* All windows have one length, so that all beads are drawn to one scale. If the beads would be higher than their rows, the windows
 * take less of the frame's width. */
enum bead_error bead_composer_cameras(struct bead_composer *c, struct bead_message *msg)
{
    size_t count = c->wants.chain_count;
    double width = 0, longest = 0, radius, largest = 0;
    c->cameras = calloc(count, sizeof(struct bead_camera *));
    if (!c->cameras)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for cameras");
    for (size_t i = 0; i < count; i++) {
        struct bead_span beads = bead_composer_beads(c, i);
        double spacing = bead_chain_spacing(c->setup.chains[i], beads, &radius);
        width = fmax(width, spacing * (double)c->setup.output->movie.window);
        longest = fmax(longest, spacing * (double)(beads.last - beads.first + 1) + 3.2 * radius); /* with what is at the ends */
        largest = fmax(largest, radius);
    }
    width = fmin(width, longest);
    narrow_moving(c, window_room(c, width, largest));
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < count; i++)
        err = bead_camera_create(c->setup.chains[i], bead_composer_beads(c, i), width, c->setup.time, &c->cameras[i], msg);
    return err;
}
