/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates a step's error from its own numbers. */
#ifndef BEADREEL_SIM_RUN_ESTIMATE_H
#define BEADREEL_SIM_RUN_ESTIMATE_H

#include "sim/integrate/stepper.h"

/* Largest |h sum bpe_i a_i| of the step just made, m/s: velocities against those of the embedded method of lower order, so an upper
 * bound of the step's own error where forces are smooth. Beads at contacts that open or close are left out: there the quadrature is
 * replaced, see events.h. 0 for methods without an embedded one. */
double bead_estimate_embedded(const struct bead_stepper *stepper);

#endif
