/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sinks of the computing half: one line for each. */
#ifndef BEADREEL_SIM_OUTPUT_DATA_SINKS_H
#define BEADREEL_SIM_OUTPUT_DATA_SINKS_H

#include "beadreel/sink.h"

#define BEAD_DATA_SINKS(SINK) \
    SINK(trajectory)          \
    SINK(table)

#define BEAD_SINK_DECLARED(name) extern const struct bead_sink_type bead_##name##_sink;
BEAD_DATA_SINKS(BEAD_SINK_DECLARED)
#undef BEAD_SINK_DECLARED

#endif
