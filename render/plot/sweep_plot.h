/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#pragma once

#include "beadreel/sweep.h"

extern const struct bead_sink_type bead_sweep_plot_sink;
