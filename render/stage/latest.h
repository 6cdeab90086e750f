/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The last two samples fed to a view, and the moments between them. */
#pragma once

#include <math.h>
#include <stddef.h>

struct bead_latest {
    double time[2];
    int fed, newest; /* samples, at most 2; index of the newest */
};

/* Takes a sample at `time`, whose values belong at the new index `newest`. */
static inline void bead_latest_feed(struct bead_latest *l, double time)
{
    l->newest = 1 - l->newest;
    l->fed += l->fed < 2;
    l->time[l->newest] = time;
}

/* Position of `time` from the sample before (0) to the newest (1, also if it is the only one). */
static inline double bead_latest_weight(const struct bead_latest *l, double time)
{
    double before = l->time[1 - l->newest], span = l->time[l->newest] - before;
    return l->fed == 2 && span > 0 ? fmin(1, fmax(0, (time - before) / span)) : 1;
}

/* Value i at that position, of values[newest] and those before. */
static inline double bead_latest_value(const struct bead_latest *l, double *const values[2], size_t i, double weight)
{
    double now = values[l->newest][i], before = values[1 - l->newest][i];
    return weight >= 1 ? now : before + weight * (now - before);
}
