/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A curve y(x) with a line of some width and the area below it, pixel by pixel. A column depends only on the points near it, so
 * parts can be redrawn alone. */
#pragma once

#include <stddef.h>

#include "beadreel/view.h"
#include "render/draw/looks.h"

struct bead_curve {
    const float *x, *y; /* points in px of the rectangle, x rising, y downwards */
    size_t count;
    float base;  /* y where the area ends */
    float width; /* of the line, px */
    struct bead_rgb line, area;
    double area_alpha;
    const struct bead_dashes *dashes; /* of the line, without an area; NULL: solid */
    float start;                      /* x where a pattern of dashes begins */
};

/* Reach of a point's influence beyond its neighbours, px. */
int bead_curve_reach(const struct bead_curve *curve);
/* Columns from..to (exclusive, of `rect`) over `background`. */
void bead_curve_draw(const struct bead_curve *curve, struct bead_rect rect, int from, int to, struct bead_frame *frame,
                     const struct bead_frame *background);
/* Discs of radius `r` px at the curve's points, in the line's colour. */
void bead_curve_dots(const struct bead_curve *curve, float r, struct bead_rect rect, int from, int to, struct bead_frame *frame);
