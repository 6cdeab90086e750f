/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The range of values that a still's colours span: as requested, else from 0 to the largest value, symmetric if values have both
 * signs. */
#ifndef BEADREEL_RENDER_COLOUR_COLOUR_RANGE_H
#define BEADREEL_RENDER_COLOUR_COLOUR_RANGE_H

#include <stdbool.h>

#include "beadreel/chain.h"
#include "beadreel/colormap.h"
#include "beadreel/scene.h"

struct bead_colour_range {
    double low, high;
    bool over, under; /* there are values beyond */
    double hidden;    /* largest magnitude of an event that an automatic range leaves out; 0: none */
};

/* Of the values shown; least > largest: there are none. What exceeds `typical` in size is a short and narrow event, such as the
 * strike; INFINITY: nothing is known of that. */
struct bead_shown_values {
    double least, largest, typical;
};

/* An automatic range leaves the event out where it would take more than half of the colours, and so hide the wave. */
struct bead_colour_range bead_colour_range_find(const struct bead_colours_asked *asked, bool is_signed,
                                                const struct bead_shown_values *values);
/* Which ends of a movie's colour bar are pointed, from the first frame on. Where the scene gives the range, nobody knows yet what
 * lies beyond it: such ends say that values there may be greater, or less where there are values of both signs. */
void bead_colour_range_ends(const struct bead_output *output, const struct bead_chain *chain, const struct bead_colour_range *found,
                            bool *over, bool *under);
/* Checks the requested range. `file` for the message. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_colour_range_check(const struct bead_output *output, const char *file, struct bead_message *msg);

/* Loads the requested colour map; "auto" (or NULL) is inferno in dark pictures and viridis in light ones, or vik for fields of both
 * signs. Errors: SCENE (with the output's place), IO, FORMAT, MEMORY. */
BEAD_CHECK enum bead_error bead_colour_range_map(const struct bead_output *output, const struct bead_chain *chain, bool dark,
                                                 struct bead_colormap *map, struct bead_message *msg);

#endif
