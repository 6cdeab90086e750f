/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schedules samples: finds the next time that any consumer wants, and delivers the sample to those that want it. */
#include "sim/session/driver.h"

#include <math.h>

/* Times of two grids closer than this part of a spacing are the same: grids start and step in decimal units. */
static const double same_time = 1e-6;

void bead_driver_start(const struct bead_driver *driver)
{
    for (size_t i = 0; i < driver->consumer_count; i++) {
        struct bead_consumer *c = &driver->consumers[i];
        c->next = 0;
        c->count = c->needs.fields ? bead_grid_count(&c->needs.grid) : 0;
    }
}

static bool wants(const struct bead_consumer *c, double time)
{
    return c->next < c->count && bead_grid_time(&c->needs.grid, c->next) <= time + same_time * c->needs.grid.every;
}

bool bead_driver_due(const struct bead_driver *driver, struct bead_due *due)
{
    due->time = INFINITY;
    for (size_t i = 0; i < driver->consumer_count; i++) {
        const struct bead_consumer *c = &driver->consumers[i];
        if (c->next < c->count)
            due->time = fmin(due->time, bead_grid_time(&c->needs.grid, c->next));
    }
    if (due->time == INFINITY)
        return false;
    double earliest = due->time;
    due->fields = due->comparison = 0;
    due->span = (struct bead_span){SIZE_MAX, 0};
    for (size_t i = 0; i < driver->consumer_count; i++) {
        const struct bead_consumer *c = &driver->consumers[i];
        if (!wants(c, earliest))
            continue;
        if (c->exact)
            due->time = bead_grid_time(&c->needs.grid, c->next);
        due->fields |= c->needs.fields;
        due->comparison |= c->needs.comparison;
        due->span.first = c->needs.beads.first < due->span.first ? c->needs.beads.first : due->span.first;
        due->span.last = c->needs.beads.last > due->span.last ? c->needs.beads.last : due->span.last;
    }
    return true;
}

enum bead_error bead_driver_deliver(const struct bead_driver *driver, const struct bead_due *due, struct bead_sample *sample,
                                    bool last, struct bead_message *msg)
{
    for (size_t i = 0; i < driver->consumer_count; i++) {
        struct bead_consumer *c = &driver->consumers[i];
        if (!wants(c, due->time))
            continue;
        sample->index = c->next;
        enum bead_error err = c->take(c, sample, msg);
        if (err)
            return err;
        c->next += last;
    }
    return BEAD_OK;
}

enum bead_error bead_consumer_scout(struct bead_consumer *c, const struct bead_sample *sample, struct bead_message *msg)
{
    (void)msg;
    const double *value = sample->field[c->needs.range_field];
    if (!value)
        return BEAD_OK;
    size_t last = c->needs.beads.last < sample->active ? c->needs.beads.last + 1 : sample->active;
    for (size_t j = c->needs.beads.first; j < last; j++) {
        c->range.low = value[j] < c->range.low ? value[j] : c->range.low;
        c->range.high = value[j] > c->range.high ? value[j] : c->range.high;
    }
    return BEAD_OK;
}
