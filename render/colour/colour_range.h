/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The range of values that a picture's colours span: as requested, else from 0 to the largest value, symmetric if values have both
 * signs. Of chains that are pressed together, and whose contacts stay closed, forces have as much room below the static force as
 * above: from 0, a small wave on a large force would not be seen. */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "beadreel/chain.h"
#include "beadreel/render.h"
#include "beadreel/scene.h"

struct bead_colour_range {
    double low, high;
    bool over, under; /* values lie beyond this end */
    double hidden;    /* largest magnitude of an event that an automatic range leaves out; 0: none */
    double rest;      /* the static force in the middle of the range; 0: it begins or ends at 0, or is symmetric about it */
};

/* Statistics of the values shown; least > largest: no values. Anything larger than `typical` is a short and narrow event, such as
 * the strike; INFINITY: unknown. */
struct bead_shown_values {
    double least, largest, typical;
    double peak;               /* the largest magnitude of a sample, larger than means over pixels and times; 0: unknown */
    double rest;               /* the static force of all contacts; 0: none, or not shown */
    double away, usually_away; /* from `rest`: the largest distance of a value, and that which only events exceed */
};
#define BEAD_NOTHING_SHOWN                                            \
    {                                                                 \
        .least = INFINITY, .largest = -INFINITY, .typical = -INFINITY \
    }

/* The static force that all contacts of these chains have, if the field is a force; else 0. */
double bead_colour_range_rest(const struct bead_chain *const *chains, size_t count, enum bead_field field);

/* Can the output's values be negative? Standard deviations cannot. */
bool bead_colour_range_signed(const struct bead_output *output, const struct bead_chain *chain);
/* An automatic range leaves out an event that would take more than half of the colours and so hide the wave. */
struct bead_colour_range bead_colour_range_find(const struct bead_colours_asked *asked, bool is_signed,
                                                const struct bead_shown_values *values);
/* Finds the ends of a movie's colour bar that are pointed from the first frame. If the scene gives the range, values beyond it are
 * not known yet: such ends show that values may be greater, or less if they have both signs. */
void bead_colour_range_ends(const struct bead_output *output, const struct bead_chain *chain, const struct bead_colour_range *found,
                            bool *over, bool *under);
/* Checks the requested colour map; ranges are checked where scenes are read. Errors: SCENE (with the output's place), those of
 * bead_colormap_load. */
BEAD_CHECK enum bead_error bead_colour_range_check(const struct bead_output *output, struct bead_message *msg);

/* The colours of such a range: linear about a static force, else on the requested scale. */
struct bead_colours bead_colour_range_colours(const struct bead_output *output, const struct bead_colour_range *range,
                                              const struct bead_colormap *map);

/* Loads the requested colour map; "auto" (or NULL) is inferno in dark pictures and ember in light ones, dusk and dawn for fields of
 * both signs and for ranges about a static force. Errors: SCENE (with the output's place), IO, FORMAT, MEMORY. */
BEAD_CHECK enum bead_error bead_colour_range_map(const struct bead_output *output, const struct bead_chain *chain, bool dark,
                                                 bool about_rest, struct bead_colormap *map, struct bead_message *msg);
