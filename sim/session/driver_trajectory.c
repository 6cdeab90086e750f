/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Delivers the samples stored in a trajectory to their consumers. */
#include <math.h>

#include "sim/base/stop.h"
#include "sim/session/driver.h"

/* Index of the stored sample at `time`, which must be one of them. */
static enum bead_error find_sample(const struct bead_trajectory *trajectory, double time, size_t *index, struct bead_message *msg)
{
    const struct bead_grid *grid = bead_trajectory_grid(trajectory);
    double place = grid->every > 0 ? (time - grid->start) / grid->every : 0, nearest = floor(place + 0.5);
    if (nearest < 0 || fabs(place - nearest) > 1e-3)
        return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "the trajectory has no sample at %.9g s", time);
    *index = (size_t)nearest;
    return BEAD_OK;
}

static enum bead_error give(const struct bead_driver *driver, struct bead_trajectory *trajectory, const struct bead_due *due,
                            struct bead_message *msg)
{
    size_t index = 0;
    enum bead_error err = find_sample(trajectory, due->time, &index, msg);
    for (size_t i = 0; !err && i < driver->chain_count; i++) {
        struct bead_sample sample = {.chain = i};
        err = bead_trajectory_read(trajectory, index, i, due->fields, &sample, msg);
        sample.chain = i;
        if (!err)
            err = bead_driver_deliver(driver, due, &sample, i + 1 == driver->chain_count, msg);
    }
    return err;
}

/* Now and then: pictures are drawn from thousands of samples a second, frames of movies from hundreds. */
static void tell(const struct bead_driver *driver, double time, uint64_t samples)
{
    if (!driver->progress || samples % 16 != 0)
        return;
    const struct bead_progress progress = {
        .what = driver->what, .done = driver->needed > 0 ? fmin(time / driver->needed, 1) : 0, .time = time};
    driver->progress(driver->progress_context, &progress);
}

enum bead_error bead_drive_trajectory(const struct bead_driver *driver, struct bead_trajectory *trajectory,
                                      struct bead_counts *counts, struct bead_message *msg)
{
    struct bead_due due;
    enum bead_error err = BEAD_OK;
    size_t stored = bead_grid_count(bead_trajectory_grid(trajectory));
    double last = stored > 0 ? bead_grid_time(bead_trajectory_grid(trajectory), stored - 1) : -INFINITY;
    bead_driver_start(driver);
    while (!err && bead_driver_due(driver, &due)) {
        if (due.time > last + 1e-6 * bead_trajectory_grid(trajectory)->every)
            break; /* its run was stopped before */
        if (bead_stop_is_asked(driver->stop))
            return bead_fail(msg, BEAD_ERROR_STOPPED, "stopped at %.4g s", due.time);
        err = give(driver, trajectory, &due, msg);
        counts->samples += driver->chain_count;
        tell(driver, due.time, counts->samples);
    }
    return err;
}
