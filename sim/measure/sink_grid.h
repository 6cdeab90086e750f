/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sample times, spans and texts shared by all sinks. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"
#include "sim/base/internal.h"

/* The largest of 1, 2, 5 x 10^n that is <= x, for x > 0. */
double bead_round_down(double x);

/* More samples than any output may have? */
bool bead_grid_is_too_fine(const struct bead_grid *grid);

/* The times that `output` asks for: from output->shown.time[0] or 0 to output->shown.time[1] or the end of the run, whichever is
 * earlier; every output->shown.every, or a round time within the run context's resolution. If samples exist only at given times
 * (context->native), `every` becomes the nearest multiple of their spacing. If powers of time are shown, and `every` is not given,
 * the spacing widens. Errors: SCENE (with the output's place). */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sink_grid(const struct bead_output *output, const struct bead_run_context *context,
                                                        struct bead_grid *grid, struct bead_message *msg);

/* Number of beads (or contacts) of `span` in a chain of `count`. */
BEAD_INTERNAL size_t bead_span_rows(const struct bead_span *span, size_t count);

/* A time in a readable unit: "1.5 ms"; with `unit` "" just the number: "1500". */
BEAD_INTERNAL void bead_time_text(double time, const char *unit, char *text, size_t size);
