/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "render/stage/camera_steps.h"

#include <math.h>

/* A contact belongs to the wave if its load is at least this part of the largest; the head is this many contacts behind the first.
 * Waves meet within so many. */
static const double part_of_wave = 0.05, least_load = 1e-3;
enum { HEAD = 9, MEETING = 40 };
/* In each frame, the speed moves this part of the way towards that of the head. */
static const double steadiness = 0.1;

double bead_pan_eased(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

/* Is the load of contact k part of what goes this way? 0: either way. */
static bool goes(const struct bead_loads *w, size_t k, int way)
{
    return way == 0 || !w->way || w->way[k] == way;
}

static double largest(const struct bead_loads *w, size_t from, size_t to, int way)
{
    double most = 0;
    for (size_t i = from; i < to; i++)
        most = goes(w, i, way) ? fmax(most, w->load[i]) : most;
    return most;
}

/* Centre of squared loads from..to. */
static double centre(const struct bead_loads *w, size_t from, size_t to, int way, double otherwise)
{
    double sum = 0, weight = 0;
    for (size_t i = from; i < to; i++) {
        const double square = goes(w, i, way) ? w->load[i] * w->load[i] : 0;
        sum += square * (double)i;
        weight += square;
    }
    return weight > least_load * least_load ? sum / weight : otherwise;
}

/* The part of a chain of so many contacts within `reach` of a place. */
static void around(double place, size_t reach, size_t count, size_t *from, size_t *to)
{
    const size_t near = (size_t)fmax(0, round(place));
    *from = near > reach ? near - reach : 0;
    *to = near + reach + 1 < count ? near + reach + 1 : count;
}

/* Before it has been at the end: the foremost contact. A wave that only goes to the left has been there. */
static double find_front(struct bead_step_camera *c, const struct bead_loads *w)
{
    const double all = largest(w, 0, w->count, 0), most = largest(w, 0, w->count, 1);
    size_t front = 0;
    for (size_t i = 0; i < w->count && most > least_load; i++)
        front = goes(w, i, 1) && w->load[i] > part_of_wave * most ? i : front;
    c->arrived = front + 1 >= w->count || (all > least_load && most < part_of_wave * all && c->front == 0);
    c->front = front > c->front ? front : c->front;
    if (most < part_of_wave * all) /* it begins at the right, or is pressed against a wave that meets it */
        return c->arrived ? centre(w, 0, w->count, -1, c->head) : c->head;
    return fmax(c->head, centre(w, front + 1 > HEAD ? front + 1 - HEAD : 0, front + 1, 1, c->head));
}

/* Afterwards: near to where it was. At the ends, where it turns round, all loads are its own. */
static double find_again(struct bead_step_camera *c, const struct bead_loads *w)
{
    size_t from, to;
    around(c->head, HEAD, w->count, &from, &to);
    const bool first = from == 0, last = to == w->count;
    c->way = last ? -1 : first ? 1 : c->way;
    return centre(w, from, to, first || last ? 0 : c->way, c->head);
}

/* Does another wave come to meet it, at least half as strong? Ahead of the front there is nothing else. Where it is then. */
static void find_other(struct bead_step_camera *c, const struct bead_loads *w)
{
    size_t from, to;
    around(c->head, MEETING, w->count, &from, &to);
    const double own = largest(w, from, to, c->way);
    if (w->way && c->way > 0 && !c->arrived && c->front + 1 < to && largest(w, c->front + 1, to, -1) > 0.5 * own &&
        own > least_load)
        c->meets = true;
    if (c->meets)
        c->other = centre(w, from, to, -c->way, c->head);
}

double bead_step_camera_find(struct bead_step_camera *c, struct bead_loads wave)
{
    c->way = c->way ? c->way : 1;
    c->head = c->arrived ? find_again(c, &wave) : find_front(c, &wave);
    find_other(c, &wave);
    return c->head;
}

/* The middle of the window within its ends. */
static double within(const struct bead_step_camera *c, double middle)
{
    const double low = c->ends[0] + 0.5 * c->width, high = c->ends[1] - 0.5 * c->width;
    return high > low ? fmin(high, fmax(low, middle)) : 0.5 * (low + high);
}

/* From the wave's head to the middle of both waves, as far as they fit into the window: all the way, or less the further they are
 * apart. `spread`: half of what is between them, that far. */
static double middle_of_both(const struct bead_step_camera *c, double place, double other, double *spread)
{
    const double apart = fabs(other - place), room = fmax(1, c->width - 2 * c->margin);
    const double part = 1 - bead_pan_eased((apart - room) / (0.5 * room));
    *spread = 0.5 * part * apart;
    return place + copysign(*spread, other - place);
}

void bead_step_camera_advance(struct bead_step_camera *c, double place, double other)
{
    double spread = 0;
    if (c->meets)
        place = middle_of_both(c, place, other, &spread);
    if (!c->begun)
        c->middle = c->goal = within(c, c->last = place);
    c->begun = true;
    c->speed += steadiness * (place - c->last - c->speed);
    c->last = place;
    /* Half of a pan has passed when the head is half a step from the middle. */
    const double off = place + 0.5 * BEAD_PAN_FRAMES * c->speed - c->goal, next = within(c, c->goal + copysign(c->step, off));
    const bool leaves = off * c->speed > 0 && fabs(off) > 0.5 * c->step;
    if (leaves && fabs(next - c->goal) >= 1 && c->pan_count < BEAD_MOST_PANS) {
        c->pans[c->pan_count++] = (struct bead_pan){.by = next - c->goal};
        c->goal = next;
    }
    c->middle = c->goal;
    size_t left = 0;
    for (size_t i = 0; i < c->pan_count; i++) {
        struct bead_pan *pan = &c->pans[i];
        pan->frame++;
        c->middle -= pan->by * (1 - bead_pan_eased((double)pan->frame / BEAD_PAN_FRAMES));
        if (pan->frame < BEAD_PAN_FRAMES)
            c->pans[left++] = *pan;
    }
    c->pan_count = left;
    /* A wave that is in view for only a few frames is faster than pans. */
    const double most = fmax(0, 0.5 * c->width - c->margin - spread);
    c->middle = within(c, fmin(place + most, fmax(place - most, c->middle)));
}
