/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy budget of a chain: what it has where, what gravity gave, and what damped contacts took, integrated along with the
 * motion.
 */
#ifndef BEADREEL_SIM_RUN_BUDGET_H
#define BEADREEL_SIM_RUN_BUDGET_H

#include "beadreel/sample.h"
#include "sim/integrate/stepper.h"

/* J: lost to damping in the step just made. */
double bead_dissipation(const struct bead_stepper *stepper);
/* The budget at time t of the step just made, before which `dissipated` J were lost. The part of the step up to t is made again:
 * between steps samples are interpolated, which follows no contact as it closes. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_budget_find(const struct bead_stepper *stepper, double t, double dissipated,
                                            struct bead_budget *budget, struct bead_message *msg);

#endif
