/* The beads view beyond its table: what layouts must know of it. */
#ifndef BEADREEL_RENDER_VIEW_VIEW_BEADS_H
#define BEADREEL_RENDER_VIEW_VIEW_BEADS_H

#include "beadreel/view.h"

/* How far left and right of its plot rectangle the view draws (the striker flying back; the wall), px. */
void bead_beads_margins(const struct bead_look *look, int *left, int *right);
/* Rows of beads and their lens are never higher than this in a plot of this width, px: more is wasted. */
double bead_beads_most_height(const struct bead_view_setup *setup, double width);

#endif
