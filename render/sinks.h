/* The sinks that draw; bead_render_sinks() lists them. */
#ifndef BEADREEL_RENDER_SINKS_H
#define BEADREEL_RENDER_SINKS_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_image_sink, bead_plot_sink, bead_movie_sink;
extern const char *const bead_still_extensions[]; /* of pictures, NULL-terminated */

struct bead_sweep_sink;
extern const struct bead_sweep_sink bead_contact_sheet_sink;

#endif
