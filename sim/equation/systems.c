/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of systems. */
#include "sim/equation/equation.h"

static const struct bead_system *const systems[] = {&bead_system_beads, &bead_system_fput, &bead_system_kdv, &bead_system_shock};

const struct bead_system *bead_system_info(size_t index)
{
    return index < sizeof systems / sizeof *systems ? systems[index] : NULL;
}
