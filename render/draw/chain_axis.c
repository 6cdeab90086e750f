/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The axis along a chain, and its title: beads, contacts or positions. */
#include "render/draw/chain_axis.h"

const char *bead_axis_along_chain(struct bead_axis *axis, const struct bead_chain *chain, bool of_contacts, size_t first,
                                  size_t last, double length, double em, bool horizontal)
{
    const struct bead_chain_axis along = bead_chain_axis(chain, of_contacts);
    double low = along.first + ((double)first - 0.5) * along.spacing, high = along.first + ((double)last + 0.5) * along.spacing;
    bead_axis_make(axis, low, high, along.unit, BEAD_SCALE_LINEAR, length, em, horizontal);
    return along.title;
}
