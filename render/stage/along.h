/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of beads or contacts along a plot. All are equally wide, unless beads of unlike radii are drawn above or below: then each
 * is as wide there as on the plot, and every number is under its bead. */
#pragma once

#include "beadreel/view.h"
#include "render/draw/axis.h"

/* Would beads drawn over equally wide places be more than half a radius away from theirs, with the narrowest at least two pixels
 * wide if all take `length` px? Reads arrays of the chain if `over_beads` is set. */
bool bead_along_uneven(const struct bead_view_setup *setup, double length);
/* Is a whole string shown between its fixed ends? Its plots extend to these, one spacing beyond the masses. */
bool bead_along_fixed(const struct bead_view_setup *setup);
/* m along the chain: the left border of a bead or contact, from the first shown to one after the last. Gaps are halved. */
double bead_along_border(const struct bead_view_setup *setup, size_t number);
/* The place, 0..1, of a number with fraction, along plots with uneven places. */
double bead_along_place(const struct bead_view_setup *setup, double number);
/* Do both have the same numbers and, if beads are drawn beside these, each within half a radius of the same place? */
bool bead_along_alike(const struct bead_view_setup *setup, const struct bead_view_setup *other);
/* The axis: see bead_axis_along_chain. Its ticks are at their beads. Returns the title. */
const char *bead_along_axis(struct bead_axis *axis, const struct bead_view_setup *setup, double length, double em, bool horizontal);
