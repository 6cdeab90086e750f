/* What pictures call chains and materials: never the identifiers of the scene. */
#ifndef BEADREEL_RENDER_DRAW_NAMES_H
#define BEADREEL_RENDER_DRAW_NAMES_H

#include <string.h>

#include "beadreel/chain.h"

/* "" for an unnamed chain. */
static inline const char *bead_chain_title(const struct bead_chain *chain)
{
    const char *title = bead_chain_spec(chain)->title;
    return title ? title : "";
}

/* Plain text: "brass wall", "rigid wall". */
void bead_wall_name(const struct bead_chain *chain, char *out, size_t size);

#endif
