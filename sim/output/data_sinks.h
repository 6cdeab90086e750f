/* The sinks of the computing half, one for each file that makes one. */
#ifndef BEADREEL_SIM_OUTPUT_DATA_SINKS_H
#define BEADREEL_SIM_OUTPUT_DATA_SINKS_H

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_trajectory_sink;
extern const struct bead_sink_type bead_table_sink;

#endif
