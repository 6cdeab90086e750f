/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which way space-time images lie: the default of each kind of output, and what follows for axes and pixels. */
#ifndef BEADREEL_RENDER_VIEW_ORIENTATION_H
#define BEADREEL_RENDER_VIEW_ORIENTATION_H

#include "beadreel/scene.h"
#include "render/view/area_colours.h"

/* Of an output's images, `auto` resolved: never AUTO. */
enum bead_orientation bead_orientation_of(const struct bead_output *output);
/* What the horizontal axis of a view counts in a picture whose images lie so. */
enum bead_view_across bead_orientation_across(enum bead_orientation orientation, const struct bead_view_info *view);
/* Where the pixels of an image go that has so many places along the chain; `indices` is its top left pixel, `stride` from row to
 * row.
 */
struct bead_area_image bead_orientation_image(enum bead_orientation orientation, int places, uint8_t *indices, ptrdiff_t stride);

#endif
