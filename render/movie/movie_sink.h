/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sink that makes movies. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_SINK_H
#define BEADREEL_RENDER_MOVIE_MOVIE_SINK_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_movie_sink, bead_frame_sink;

#endif
