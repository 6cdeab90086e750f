/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A smooth curve through values at beads: the cubic spline with continuous curvature (C. de Boor, A Practical Guide to Splines,
 * 1978, chapter IV), whose peak keeps its height while a pulse passes from bead to bead; a polygon's varies by a tenth. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum {
    BEAD_SMOOTH_MOST = 12, /* parts of a gap */
    BEAD_SMOOTH_REACH = 7  /* gaps on each side in which a value changes the curve: slopes are sums over few neighbours */
};

/* Number of parts of a gap of `pitch` px; 1: values so close that straight lines suffice. */
unsigned bead_smooth_parts(double pitch);
/* The points of the curve from value `from` to value `to` - 1 of `count`, parts * (to - from - 1) + 1 of them, into sx and sy. y
 * points down and stays within `top` and `bottom`. `odd`: beyond its ends the curve continues point-reflected, as a string's does
 * at its fixed ends; else with constant values. */
size_t bead_smooth_fill(const float *x, const float *y, size_t count, size_t from, size_t to, unsigned parts, bool odd, float top,
                        float bottom, float *sx, float *sy);
