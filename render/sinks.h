/* The sinks that draw; bead_render_sinks() lists them. */
#ifndef BEADREEL_RENDER_SINKS_H
#define BEADREEL_RENDER_SINKS_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_image_sink, bead_plot_sink, bead_movie_sink, bead_modes_plot_sink, bead_profiles_plot_sink;

struct bead_sweep_sink;
extern const struct bead_sweep_sink bead_contact_sheet_sink;

#endif
