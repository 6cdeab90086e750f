/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the orientation of space-time images, and finds their axes and pixels. */
#include "render/view/orientation.h"
#include "sim/kinds/view_kinds.h"

/* Papers have time to the right; below a row of beads it runs down, so that each bead is above its column; bare pixels are arranged
 * like a matrix. */
static enum bead_orientation of_image(const struct bead_views_asked *views)
{
    if (!bead_views_all(views, BEAD_SHOWS_ALL_TIMES))
        return BEAD_TIME_DOWN;
    return !views->axes && views->count == 1 ? BEAD_MATRIX : BEAD_TIME_RIGHT;
}

enum bead_orientation bead_orientation_of(const struct bead_output *output)
{
    static const enum bead_orientation of_kind[BEAD_OUTPUT_KINDS] = {
        [BEAD_OUTPUT_MOVIE] = BEAD_TIME_DOWN, [BEAD_OUTPUT_SHEET] = BEAD_TIME_DOWN};
    if (output->views.orientation != BEAD_ORIENTATION_AUTO)
        return output->views.orientation;
    return of_kind[output->kind] != BEAD_ORIENTATION_AUTO ? of_kind[output->kind] : of_image(&output->views);
}

enum bead_view_across bead_orientation_across(enum bead_orientation orientation, const struct bead_view_info *view)
{
    return view->traits & BEAD_SHOWS_IMAGE && orientation != BEAD_TIME_DOWN ? BEAD_ACROSS_TIME : view->across;
}

struct bead_area_image bead_orientation_image(enum bead_orientation orientation, int places, uint8_t *indices, ptrdiff_t stride)
{
    if (orientation == BEAD_TIME_DOWN)
        return (struct bead_area_image){indices, stride, 1};
    if (orientation == BEAD_MATRIX)
        return (struct bead_area_image){indices, 1, stride};
    return (struct bead_area_image){indices + (places - 1) * stride, 1, -stride};
}
