/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Orientation of space-time images: the default of each kind of output, and the axes and pixels of each orientation. */
#pragma once

#include "beadreel/scene.h"
#include "render/view/area.h"

/* The orientation of an output's images, with `auto` resolved: never AUTO. */
enum bead_orientation bead_orientation_of(const struct bead_output *output);
/* The quantity on a view's horizontal axis in a picture whose images have this orientation. */
enum bead_view_across bead_orientation_across(enum bead_orientation orientation, const struct bead_view_info *view);
/* Places of the pixels of an image with this many places along the chain; `indices` is its top left pixel, and rows are `stride`
 * apart. */
struct bead_area_image bead_orientation_image(enum bead_orientation orientation, int places, uint8_t *indices, ptrdiff_t stride);
