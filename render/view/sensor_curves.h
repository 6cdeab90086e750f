/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves over time, such as force at sensors, with no more points than a row of pixels can show. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"

struct bead_point {
    double time, value; /* s, N */
};

/* First, smallest, largest and last point within a short stretch of time. Drawn in time order, they cover the same pixels as all
 * points would. */
struct bead_stretch {
    struct bead_point first, low, high, last;
};

struct bead_curves {
    size_t curves;  /* sensors */
    double time[2]; /* s */
    size_t count, room;
    long last_slot;
    struct bead_stretch *stretch; /* [count][curves] */
    double low, high;             /* N: of all values added; low > high: none yet */
};

void bead_curves_init(struct bead_curves *curves, size_t count, const double time[2]);
void bead_curves_free(struct bead_curves *curves);
/* Room for one more time. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_curves_reserve(struct bead_curves *curves, struct bead_message *msg);
/* Values of all curves at `time`, in time order; after reserve. */
void bead_curves_add(struct bead_curves *curves, double time, const double *values);
/* The points of stretch `s` of curve `k` in time order, without duplicates; returns their number. */
size_t bead_curves_points(const struct bead_curves *curves, size_t s, size_t k, struct bead_point points[4]);
