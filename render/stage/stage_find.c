/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds things currently on the stage, for notes that point at them. */
#include <math.h>

#include "render/stage/stage_view.h"

/* m: the place of a thing on the floor at rest, its current displacement, and its radius. */
struct thing {
    double place, shift, radius;
};

static bool find_contact(const struct bead_view *v, size_t i, struct thing *thing)
{
    if (i >= v->contacts)
        return false;
    *thing = (struct thing){v->ends[1], 0, v->radius[v->count - 1]};
    if (i + 1 < v->count) {
        thing->place = 0.5 * (v->place[i] + v->radius[i] + v->place[i + 1] - v->radius[i + 1]);
        thing->shift = 0.5 * (v->shift[i] + v->shift[i + 1]);
        thing->radius = fmin(v->radius[i], v->radius[i + 1]);
    }
    return true;
}

static bool find_thing(const struct bead_view *v, enum bead_note_of of, size_t number, struct thing *thing)
{
    const size_t i = number - v->first;
    switch (of) {
    case BEAD_NOTE_FRONT:
        *thing = (struct thing){bead_stage_between(v, v->camera.head), 0, v->largest};
        return v->camera.head > 0 || v->load[0] > 0;
    case BEAD_NOTE_WALL:
        *thing = (struct thing){v->ends[1], 0, v->radius[v->count - 1]};
        return v->wall;
    case BEAD_NOTE_CONTACT:
        return number >= v->first && find_contact(v, i, thing);
    case BEAD_NOTE_BEAD:
        if (number < v->first || i >= v->count)
            return false;
        *thing = (struct thing){v->place[i], v->shift[i], v->radius[i]};
        return true;
    }
    return false;
}

bool bead_stage_find(struct bead_view *v, enum bead_note_of of, size_t number, struct bead_spot *spot)
{
    struct thing thing = {0};
    if (v->latest.fed == 0 || !find_thing(v, of, number, &thing))
        return false;
    const double x = v->scale * (thing.place + thing.shift) - v->left, r = v->scale * thing.radius;
    *spot = (struct bead_spot){.x = v->strip.x + x,
                               .y = v->strip.y + v->stage.centre / v->stage.fine +
                                    BEAD_STAGE_COSINE * (v->stage.unit / v->stage.fine - r),
                               .r = r,
                               .front = (double)v->camera.front,
                               .arrived = v->camera.arrived,
                               .stage = {v->strip.x, v->strip.y + v->head, v->strip.width, v->strip.height - v->head}};
    if (v->row.height > 0 && (x < 0.5 * r || x > v->strip.width - 0.5 * r)) {
        spot->below = true;
        spot->x = v->row.x + bead_stage_row_x(v, thing.place);
        spot->y = v->row.y + 0.5 * v->row.height;
        spot->r = 0.5 * v->row.height;
        spot->row = v->row;
        v->drawn = false; /* the row is painted again, without the note */
    }
    return true;
}
