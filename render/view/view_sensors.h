/* Sensors in stills: the axis is known only after the last sample. */
#ifndef BEADREEL_RENDER_VIEW_VIEW_SENSORS_H
#define BEADREEL_RENDER_VIEW_VIEW_SENSORS_H

#include "beadreel/view.h"

/* Least and largest force seen, N; low > high where there was none yet. */
void bead_sensors_extremes(const struct bead_view *view, double *low, double *high);
/* Axis of forces, before decorate; without it the range of the setup's colours. */
void bead_sensors_set_range(struct bead_view *view, double low, double high);
/* With trust: the first time at which a force differs from the comparison run's by more than a hundredth of the axis's range, as
 * far as samples came; INFINITY where none does. */
double bead_sensors_horizon(const struct bead_view *view);

#endif
