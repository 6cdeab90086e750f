/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sweeps: force against magnetism, and decay along the chain. */
#ifndef BEADREEL_RENDER_PLOT_SWEEP_PLOT_H
#define BEADREEL_RENDER_PLOT_SWEEP_PLOT_H

#include "beadreel/sweep.h"

extern const struct bead_sweep_sink bead_sweep_plot_sink;

#endif
