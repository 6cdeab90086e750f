/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A smooth curve through values at beads: the cubic spline with continuous curvature (C. de Boor, A Practical Guide to Splines,
 * 1978, chapter IV), whose peak stays as high while a pulse passes from bead to bead; a polygon's goes up and down by a tenth. */
#ifndef BEADREEL_RENDER_DRAW_SMOOTH_CURVE_H
#define BEADREEL_RENDER_DRAW_SMOOTH_CURVE_H

#include <stddef.h>

enum {
    BEAD_SMOOTH_MOST = 12, /* parts of a gap */
    BEAD_SMOOTH_REACH = 7  /* a value changes the curve in so many gaps on each side: slopes are sums over few neighbours */
};

/* Parts that a gap of `pitch` px is cut into; 1: the values lie so close that lines between them are as good. */
unsigned bead_smooth_parts(double pitch);
/* The points of the curve from value `from` to value `to` - 1 of `count`, parts * (to - from - 1) + 1 of them, into sx and sy.
 * y points down and stays within `top` and `bottom`. */
size_t bead_smooth_fill(const float *x, const float *y, size_t count, size_t from, size_t to, unsigned parts, float top,
                        float bottom, float *sx, float *sy);

#endif
