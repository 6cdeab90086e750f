/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy budget of a chain: kinetic energy, contacts, gravity, and the loss to damped contacts, integrated along with the motion.
 */
#pragma once

#include "beadreel/sample.h"
#include "sim/integrate/dense.h"
#include "sim/integrate/stepper.h"

/* Energy lost to damping in the last step, J. */
double bead_dissipation(const struct bead_stepper *stepper);
/* Energy that an absorbing end has taken in the last step, J. */
double bead_absorption(const struct bead_stepper *stepper);
/* Work of the drive, J, in the last step up to the part `until` of it (with damping always 1, the whole step, and no `dense`). */
double bead_drive_work(const struct bead_stepper *stepper, struct bead_dense *dense, double until);
/* The budget at time t in the last step. Before this step, `dissipated` J were lost, also to an absorbing end; up to t, or with
 * damping up to the start of the step, a drive did the given work. The step is repeated up to t: interpolated samples do not follow
 * a contact that closes. `beads`: room for 3 (beads + 1) numbers, zeros before the first call, which the budget points to. Errors:
 * MEMORY. */
BEAD_CHECK enum bead_error bead_budget_find(const struct bead_stepper *stepper, double t, double dissipated, double work,
                                            double *beads, struct bead_budget *budget, struct bead_message *msg);
