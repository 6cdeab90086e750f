/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sinks of this room: session/data_sinks.c lists them. */
#pragma once

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_trajectory_sink, bead_table_sink;
