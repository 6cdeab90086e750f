/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recorded curves: all values of some curves over time, and interpolation between them. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

/* Begins as zeros, except for `curves`. */
struct bead_recorded {
    size_t curves, count, room[2];
    double *times, *values; /* [count], rising; [count][curves] */
};

/* Adds the values of all curves at a later time. Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_recorded_add(struct bead_recorded *recorded, double time, const double *values,
                                                           struct bead_message *msg);
/* The cubic through the four samples around that time; before the first and after the last sample, the value of that one. */
BEAD_INTERNAL double bead_recorded_at(const struct bead_recorded *recorded, size_t curve, double time);
BEAD_INTERNAL void bead_recorded_free(struct bead_recorded *recorded);
