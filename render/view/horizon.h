/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Horizon: the time until which a picture can be trusted.
 *
 * Two runs of the same chain with different accuracy agree at first. Where the motion is chaotic, their difference grows until the
 * details of both are arbitrary. The horizon of a bead is the first time at which the two pictures' pixels differ by more than a
 * threshold there. The line passes through the horizons of all beads, each the earliest of its own and its neighbours' (about 2 %
 * of the chain on both sides): no pixel before the line differs by more. */
#pragma once

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/sink.h"
#include "render/draw/axis.h"
#include "render/view/area.h"

/* Two pictures differ if their values differ by more than this part of the range. */
#define BEAD_HORIZON_PART 0.01

struct bead_horizon;

/* For an image of these pixels. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_horizon_create(const struct bead_area_setup *setup, struct bead_horizon **horizon,
                                               struct bead_message *msg);
void bead_horizon_destroy(struct bead_horizon *horizon);
/* Values of all beads of both runs at `time`; beads >= active are at rest in both. */
void bead_horizon_feed(struct bead_horizon *horizon, double time, const double *first, const double *second, size_t active);
/* Examines the time columns up to `to`, which must be final; earlier results stay. Returns the first column where the line has
 * changed, INT_MAX if it has not. */
int bead_horizon_find(struct bead_horizon *horizon, double threshold, int to);
/* The earliest of all beads found so far, s: the beginning of its pixel. INFINITY: none. */
double bead_horizon_time(const struct bead_horizon *horizon);
/* Draws the line over the image in `plot`, which has this orientation. `closed`: the line runs along the end of time for beads
 * without a horizon. */
void bead_horizon_draw(const struct bead_horizon *horizon, cairo_t *cr, const struct bead_look *look, struct bead_rect plot,
                       enum bead_orientation orientation, bool closed);
/* Half the width of the line, px. */
double bead_horizon_reach(const struct bead_look *look);
/* Strokes the current path in the style of a horizon, visible on every colour of a map. */
void bead_horizon_stroke(cairo_t *cr, const struct bead_look *look);

/* One line of text about the horizon of a picture. */

/* The words of the line. */
struct bead_trust {
    double from;          /* s: beginning of the picture */
    double until;         /* s: the horizon; INFINITY: none */
    const char *chain;    /* name of the horizon's chain if there are several, else "" */
    bool bold;            /* the verdict in bold type */
    bool steps;           /* the runs differ by their steps, not their accuracy */
    double first, second; /* s, or relative */
    const char *unit;     /* of times */
};

/* The two runs of a scene. */
struct bead_trust bead_trust_make(const struct bead_chain *chain, double tolerance_factor);
/* Draws as many words as fit into `rect`, aligned left or right. */
void bead_trust_draw(cairo_t *cr, const struct bead_look *look, const struct bead_trust *trust, struct bead_rect rect, bool right);
/* The markup of the line, from all words (0) to the verdict alone (3). */
void bead_trust_say(const struct bead_trust *trust, int shorter, char *markup, size_t size);
