/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images of sweeps: mean, median or standard deviation of a field over all configurations, in space and time. */
#pragma once

#include "beadreel/sink.h"

extern const struct bead_sink_type bead_sweep_image_sink;
