/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "render/stage/camera_steps.h"

#include <math.h>

/* A contact belongs to the wave if its load is at least this part of the largest; the head is this many contacts behind the first.
 * Waves meet within this many. */
static const double part_of_wave = 0.05, least_load = 1e-3;
enum { HEAD = 9, MEETING = 40 };
/* In each frame, the speed moves this part of the way towards that of the head. */
static const double steadiness = 0.1;
/* A window within this part of a step of the place where waves meet stays there. A choice: less makes one more short pan, more lets
 * them meet beside the middle. */
static const double negligible = 0.1;

double bead_pan_eased(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

/* Does the load of contact k go this way? 0: either way. */
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

/* The part of a chain of `count` contacts within `reach` of a place. */
static void around(double place, size_t reach, size_t count, size_t *from, size_t *to)
{
    const size_t near = (size_t)fmax(0, round(place));
    *from = near > reach ? near - reach : 0;
    *to = near + reach + 1 < count ? near + reach + 1 : count;
}

/* Before the wave has reached the end: the foremost contact. A wave that only goes to the left has been there. */
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

/* Afterwards: near the previous place. At the ends, where the wave turns round, all loads belong to it. */
static double find_again(struct bead_step_camera *c, const struct bead_loads *w)
{
    size_t from, to;
    around(c->head, HEAD, w->count, &from, &to);
    const bool first = from == 0, last = to == w->count;
    c->way = last ? -1 : first ? 1 : c->way;
    return centre(w, from, to, first || last ? 0 : c->way, c->head);
}

/* Does another wave, at least half as strong, come to meet it? Ahead of the front there is nothing else. Finds that wave, also
 * after they have met. */
static void find_other(struct bead_step_camera *c, const struct bead_loads *w)
{
    size_t from, to;
    around(c->head, MEETING, w->count, &from, &to);
    const double own = largest(w, from, to, c->way);
    const bool comes = w->way && c->way > 0 && !c->arrived && c->front + 1 < to && own > least_load &&
                       largest(w, c->front + 1, to, -1) > 0.5 * own;
    c->meets = c->meets || comes;
    c->other = c->meets ? centre(w, comes ? c->front + 1 : from, to, -c->way, c->head) : c->head;
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

/* How far the window is from where the waves will meet. */
static double to_meeting(const struct bead_step_camera *c, double place, double other, double way)
{
    return way * (0.5 * (place + other) - c->goal);
}

/* How far the next pan goes; 0: none is due. Half of it has passed when the head is half a step from the middle. Pans end where
 * waves meet, the last one as early as possible; the window stays there until they have passed through each other and no longer fit
 * into it. */
static double next_pan(const struct bead_step_camera *c, double place, double other, double most)
{
    const double way = copysign(1, c->speed), off = way * (place - c->goal), takes = BEAD_PAN_FRAMES * fabs(c->speed);
    const bool passed = way * (other - place) <= 0;
    if (c->meets && passed)
        return off > most ? way * c->step : 0;
    const double left = c->meets ? to_meeting(c, place, other, way) : 0, count = ceil(left / c->step - negligible);
    const double step = !c->meets ? c->step : count > 0 ? left / count : 0;
    const bool due = c->meets && count == 1 ? off + takes > step - most : off + 0.5 * takes > 0.5 * step;
    return due ? way * step : 0;
}

void bead_step_camera_advance(struct bead_step_camera *c, double place, double other)
{
    if (!c->begun)
        c->middle = c->goal = within(c, c->last = place);
    c->begun = true;
    c->speed += steadiness * (place - c->last - c->speed);
    c->last = place;
    const double most = fmax(0, 0.5 * c->width - c->margin), by = next_pan(c, place, other, most), next = within(c, c->goal + by);
    if (fabs(next - c->goal) >= 1 && c->pan_count < BEAD_MOST_PANS) {
        c->meets = c->meets && (other - place) * c->speed > 0;
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
    c->middle = within(c, fmin(place + most, fmax(place - most, c->middle)));
}
