/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The axis along a chain: numbers of beads or contacts, or positions of an equation's points. */
#ifndef BEADREEL_RENDER_DRAW_CHAIN_AXIS_H
#define BEADREEL_RENDER_DRAW_CHAIN_AXIS_H

#include "beadreel/chain.h"
#include "beadreel/look.h"

/* For values first..last, each one unit wide; returns the title. */
const char *bead_axis_along_chain(struct bead_axis *axis, const struct bead_chain *chain, bool of_contacts, size_t first,
                                  size_t last, double length, double em, bool horizontal);

#endif
