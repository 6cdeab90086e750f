/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values known at points of a plane, as an image for graphs: each point has the box that ends half-way to its neighbours. */
#pragma once

#include "render/plot/graph.h"

struct bead_plane_point {
    double x, y, value;
};

/* Sorts the points. Columns are the points of equal x, each with its own values of y. Half-way is measured along the axes, whose
 * scales are linear or logarithmic; `ends` [x and y][2] are those of the boxes. image->values are to be freed; its title and unit
 * are the caller's. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_plane_make(struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                           struct bead_graph_image *image, double ends[2][2], struct bead_message *msg);
