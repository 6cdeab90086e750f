/* Names of walls. */
#include "render/draw/names.h"

#include <stdio.h>

void bead_wall_name(const struct bead_chain *chain, char *out, size_t size)
{
    enum { MOST = 40 };
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const bool rigid = spec->wall == BEAD_WALL_RIGID;
    const char *name = rigid ? "rigid" : bead_chain_scene(chain)->materials[spec->wall_material].label;
    const size_t length = strcspn(name, ","); /* without the radius, which walls do not have */
    snprintf(out, size, "%.*s wall", (int)(length < MOST ? length : MOST), name);
}
