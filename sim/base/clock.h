/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Seconds of a clock that only runs forward. */
#pragma once

#include <time.h>

static inline double bead_clock(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
