/* The span of time that a picture shows, and the samples it wants of it. */
#ifndef BEADREEL_RENDER_DRAW_PICTURE_TIMES_H
#define BEADREEL_RENDER_DRAW_PICTURE_TIMES_H

#include "beadreel/sink.h"

/* From when to when an output shows the run. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_picture_times(const struct bead_output *output, const struct bead_run_context *context,
                                              double time[2], struct bead_message *msg);
/* Times at which a picture with `pixels` along `time` wants samples: two or more a pixel, and every oscillation; those there are
 * where the run context has given ones. */
struct bead_grid bead_picture_grid(const struct bead_run_context *context, const struct bead_shown *shown, const double time[2],
                                   double pixels);

#endif
