/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sample times, spans and words that all sinks of data share. */
#ifndef BEADREEL_SIM_OUTPUT_SINK_GRID_H
#define BEADREEL_SIM_OUTPUT_SINK_GRID_H

#include <stddef.h>

#include "beadreel/sink.h"

/* The largest of 1, 2, 5 x 10^n that is <= x, for x > 0. */
double bead_round_down(double x);

/* The times that `output` asks for: from output->shown.time[0] or 0 to output->shown.time[1] or the end of the run, never beyond
 * it; every output->shown.every, or a round time within the run context's resolution. Where there are only samples at given times
 * (stage->native), the nearest multiple of their spacing. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_sink_grid(const struct bead_output *output, const struct bead_run_context *context,
                                          struct bead_grid *grid, struct bead_message *msg);

/* Part of `span` that a chain of `count` beads (or contacts) has: first row and number of rows. */
size_t bead_span_rows(const struct bead_span *span, size_t count);

/* A time for people: "1.5 ms"; of a chain whose times have the unit "": "1500". */
void bead_time_text(double time, const char *unit, char *text, size_t size);

#endif
