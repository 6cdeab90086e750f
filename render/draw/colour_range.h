/* Which values the colours of a still span: those asked for, else 0 (or as far below as above) to the largest. */
#ifndef BEADREEL_RENDER_DRAW_COLOUR_RANGE_H
#define BEADREEL_RENDER_DRAW_COLOUR_RANGE_H

#include <stdbool.h>

#include "beadreel/chain.h"
#include "beadreel/colormap.h"
#include "beadreel/scene.h"

struct bead_colour_range {
    double low, high;
    bool over, under; /* there are values beyond */
};

/* `least` and `largest`: of what is shown; least > largest: nothing is. is_signed: the field has both signs (bead_chain_signed). */
struct bead_colour_range bead_colour_range_find(const struct bead_colours_asked *asked, bool is_signed, double least,
                                                double largest);
/* A range that makes no sense as asked. `file` for the message. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_colour_range_check(const struct bead_output *output, const char *file, struct bead_message *msg);

/* The colour map asked for; "auto" (or NULL) is `plain`, and vik for fields of both signs. Errors: SCENE (with the output's place),
 * IO, FORMAT, MEMORY. */
BEAD_CHECK enum bead_error bead_colour_range_map(const struct bead_output *output, const struct bead_chain *chain,
                                                 const char *plain, struct bead_colormap *map, struct bead_message *msg);

#endif
