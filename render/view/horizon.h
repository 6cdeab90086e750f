/* Horizon: up to when a picture can be trusted.
 *
 * Two runs of the same chain to different accuracy agree at first; where the motion is chaotic their difference grows, until the
 * details of either are an accident. The horizon of a bead is the first time at which the two pictures' pixels differ by more
 * than a threshold there. Drawn as a line through all beads' horizons, each the earliest of its own and its neighbours' (some 2 %
 * of the chain to both sides): on its near side no pixel differs by more. */
#ifndef BEADREEL_RENDER_VIEW_HORIZON_H
#define BEADREEL_RENDER_VIEW_HORIZON_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/look.h"
#include "render/view/area.h"

/* Pictures differ where they do by more than this part of their range. */
#define BEAD_HORIZON_PART 0.01

struct bead_horizon;

/* For an image of these pixels. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_horizon_create(const struct bead_area_setup *setup, struct bead_horizon **horizon,
                                               struct bead_message *msg);
void bead_horizon_destroy(struct bead_horizon *horizon);
/* Values of all beads of both runs at `time`; beads >= active are at rest in both. */
void bead_horizon_feed(struct bead_horizon *horizon, double time, const double *first, const double *second, size_t active);
/* Looks at time columns up to `to`, which are final; those looked at before stay as found. Returns the first column in which the
 * line is another than before, INT_MAX where it is the same. */
int bead_horizon_find(struct bead_horizon *horizon, double threshold, int to);
/* The earliest of all beads found so far, s: the beginning of its pixel. INFINITY: none. */
double bead_horizon_time(const struct bead_horizon *horizon);
/* The line over the image in `plot`; time runs down and beads to the right, or time to the right and beads up. `closed`: beads
 * without horizon have theirs at the end. */
void bead_horizon_draw(const struct bead_horizon *horizon, cairo_t *cr, const struct bead_look *look, struct bead_rect plot,
                       bool time_down, bool closed);
/* px that the line covers on both sides of its path. */
double bead_horizon_reach(const struct bead_look *look);
/* Strokes the current path as a horizon: seen on every colour of a map. */
void bead_horizon_stroke(cairo_t *cr, const struct bead_look *look);

#endif
