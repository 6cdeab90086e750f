/* Stills: one finished picture a file, as PNG, PDF or SVG. */
#ifndef BEADREEL_RENDER_FIGURE_STILL_H
#define BEADREEL_RENDER_FIGURE_STILL_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_image_sink, bead_plot_sink;

#endif
