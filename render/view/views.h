/* The views there are; bead_view_find looks among these. */
#ifndef BEADREEL_RENDER_VIEW_VIEWS_H
#define BEADREEL_RENDER_VIEW_VIEWS_H

#include "beadreel/view.h"

extern const struct bead_view_type bead_view_beads_type, bead_view_profile_type;
extern const struct bead_view_type bead_view_spacetime_type, bead_view_sensors_type, bead_view_modes_type;

#endif
