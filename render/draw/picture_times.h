/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The span of time that a picture shows, and its sampling grid. */
#pragma once

#include "beadreel/sink.h"

/* The times at which an output's picture begins and ends. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_picture_times(const struct bead_output *output, const struct bead_run_context *context,
                                              double time[2], struct bead_message *msg);
/* The sampling grid of a picture with `pixels` along `time`: at least two samples per pixel, and enough for every oscillation; of a
 * context with its own grid, that one. */
struct bead_grid bead_picture_grid(const struct bead_run_context *context, const struct bead_shown *shown, const double time[2],
                                   double pixels);
