/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of walls, decimals of magnetisms. */
#include "render/draw/names.h"

#include <math.h>
#include <stdio.h>

#include "render/draw/quantity.h"

void bead_wall_name(const struct bead_chain *chain, char *out, size_t size)
{
    enum { MOST = 40 };
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const bool rigid = spec->wall == BEAD_WALL_RIGID;
    const char *name = rigid ? "rigid" : bead_chain_scene(chain)->materials[spec->wall_material].label;
    const size_t length = strcspn(name, ","); /* without the radius, which walls do not have */
    snprintf(out, size, "%.*s wall", (int)(length < MOST ? length : MOST), name);
}

int bead_magnetism_digits(double magnetism)
{
    enum { MOST = 3 };
    int digits = 0;
    while (digits < MOST && fabs(remainder(magnetism, bead_power_of_ten(-digits))) > 1e-9)
        digits++;
    return digits;
}

int bead_magnetism_decimals(const struct bead_chain *const *chains, size_t count)
{
    int most = 0;
    for (size_t c = 0; c < count; c++) {
        const int digits = *bead_chain_spins(chains[c]) ? bead_magnetism_digits(bead_chain_magnetism(chains[c])) : 0;
        most = digits > most ? digits : most;
    }
    return most;
}
