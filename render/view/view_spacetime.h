/* Space-time stills: their range of colours is known only after the last sample. */
#ifndef BEADREEL_RENDER_VIEW_VIEW_SPACETIME_H
#define BEADREEL_RENDER_VIEW_VIEW_SPACETIME_H

#include "beadreel/view.h"

/* Least and largest pixel; low > high where there is none yet. */
void bead_spacetime_extremes(const struct bead_view *view, double *low, double *high);
/* Other colours, before anything is drawn. */
void bead_spacetime_recolour(struct bead_view *view, const struct bead_colours *colours);
/* With trust: the earliest time at which a pixel of what was drawn differs from the comparison run's, INFINITY where none does. In
 * stills: of all. */
double bead_spacetime_horizon(struct bead_view *view);

#endif
