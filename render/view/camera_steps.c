/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "render/view/camera_steps.h"

#include <math.h>

/* A contact belongs to the wave if its load is at least this part of the largest; the head is this many contacts behind the first.
 */
static const double part_of_wave = 0.05, least_load = 1e-3;
enum { HEAD = 9 };
/* In each frame, the speed moves this part of the way towards that of the head. */
static const double steadiness = 0.1;

double bead_pan_eased(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

static double largest(const double *load, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, load[i]);
    return most;
}

/* Centre of squared loads from..to. */
static double centre(const double *load, size_t from, size_t to, double otherwise)
{
    double sum = 0, weight = 0;
    for (size_t i = from; i < to; i++) {
        sum += load[i] * load[i] * (double)i;
        weight += load[i] * load[i];
    }
    return weight > least_load * least_load ? sum / weight : otherwise;
}

double bead_step_camera_find(struct bead_step_camera *c, const double *load, size_t count)
{
    const double most = largest(load, count);
    size_t front = 0;
    for (size_t i = 0; i < count && most > least_load; i++)
        front = load[i] > part_of_wave * most ? i : front;
    size_t from, to;
    c->front = c->arrived ? count : front > c->front ? front : c->front;
    if (!c->arrived) {
        c->arrived = front + 1 >= count;
        to = front + 1;
        from = to > HEAD ? to - HEAD : 0;
    } else {
        const size_t near = (size_t)fmax(0, round(c->head));
        from = near > HEAD ? near - HEAD : 0;
        to = near + HEAD + 1 < count ? near + HEAD + 1 : count;
    }
    const double found = centre(load, from, to, c->head);
    c->head = c->arrived ? found : fmax(c->head, found);
    return c->head;
}

/* The middle of the window within its ends. */
static double within(const struct bead_step_camera *c, double middle)
{
    const double low = c->ends[0] + 0.5 * c->width, high = c->ends[1] - 0.5 * c->width;
    return high > low ? fmin(high, fmax(low, middle)) : 0.5 * (low + high);
}

void bead_step_camera_advance(struct bead_step_camera *c, double place)
{
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
    const double most = fmax(0, 0.5 * c->width - c->margin);
    c->middle = within(c, fmin(place + most, fmax(place - most, c->middle)));
}
