/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing half's outputs: images, plots, movies. Hand this list and bead_data_sinks() to a job (session.h). */
#ifndef BEADREEL_RENDER_H
#define BEADREEL_RENDER_H

#include "beadreel/sink.h"

BEAD_BEGIN

/* NULL-terminated. */
BEAD_API const struct bead_sink_type *const *bead_render_sinks(void);

BEAD_END

#endif
