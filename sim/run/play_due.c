/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schedules samples: finds the next time that any consumer wants, and delivers the sample to all that want it. */
#include <float.h>
#include <math.h>

#include "sim/run/play.h"

/* Times of two grids are equal if they differ by rounding only: of a unit, a product and a sum in each. */
static const double same_time = 8 * DBL_EPSILON;

void bead_due_start(const struct bead_play *play)
{
    for (size_t i = 0; i < play->consumer_count; i++) {
        struct bead_consumer *c = &play->consumers[i];
        c->next = 0;
        c->count = !c->needs.fields ? 0 : isinf(c->needs.grid.end) ? SIZE_MAX : bead_grid_count(&c->needs.grid);
    }
}

static bool wants(const struct bead_consumer *c, double time)
{
    return c->next < c->count && bead_grid_time(&c->needs.grid, c->next) <= time * (1 + same_time);
}

bool bead_due_next(const struct bead_play *play, struct bead_due *due)
{
    due->time = INFINITY;
    for (size_t i = 0; i < play->consumer_count; i++) {
        const struct bead_consumer *c = &play->consumers[i];
        if (c->next < c->count)
            due->time = fmin(due->time, bead_grid_time(&c->needs.grid, c->next));
    }
    if (due->time == INFINITY)
        return false;
    double earliest = due->time;
    due->fields = due->comparison = due->checked = 0;
    due->span = (struct bead_span){SIZE_MAX, 0};
    for (size_t i = 0; i < play->consumer_count; i++) {
        const struct bead_consumer *c = &play->consumers[i];
        if (!wants(c, earliest))
            continue;
        if (c->exact)
            due->time = bead_grid_time(&c->needs.grid, c->next);
        due->fields |= c->needs.each > 1 && c->next % c->needs.each > 0 ? 0 : c->needs.fields;
        due->comparison |= c->needs.comparison;
        due->checked |= c->needs.checked ? c->needs.fields : 0;
        due->span.first = c->needs.beads.first < due->span.first ? c->needs.beads.first : due->span.first;
        due->span.last = c->needs.beads.last > due->span.last ? c->needs.beads.last : due->span.last;
    }
    return true;
}

enum bead_error bead_due_deliver(const struct bead_play *play, const struct bead_due *due, struct bead_sample *sample,
                                 struct bead_message *msg)
{
    for (size_t i = 0; i < play->consumer_count; i++) {
        const struct bead_consumer *c = &play->consumers[i];
        sample->index = c->next;
        if (wants(c, due->time))
            BEAD_TRY(c->take(c, sample, msg));
    }
    return BEAD_OK;
}

void bead_due_pass(const struct bead_play *play, const struct bead_due *due)
{
    for (size_t i = 0; i < play->consumer_count; i++)
        play->consumers[i].next += wants(&play->consumers[i], due->time);
}
