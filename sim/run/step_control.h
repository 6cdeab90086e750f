/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Step control: how long the next step may be.
 *
 * The step is theta/omega. omega bounds the frequencies the chain can show: at first from the energy put in, then again every few
 * steps from the compressions as they are, so that the step grows as amplitudes decay. theta follows from the accuracy asked
 * by a law measured for each method. Only the state decides, never the outputs. */
#ifndef BEADREEL_SIM_RUN_STEP_CONTROL_H
#define BEADREEL_SIM_RUN_STEP_CONTROL_H

#include "sim/integrate/stepper.h"

struct bead_step_control {
    double theta;        /* step in units of 1/omega */
    double static_omega; /* rad/s, of the whole chain at rest: what lies ahead of the window counts as well */
    double longest;      /* s */
    double h;            /* s: the step now */
};

/* For a chain whose energy bounds its frequencies by omega. */
struct bead_step_control bead_step_control_start(const struct bead_stepper *stepper, double theta, double omega);
/* From now on take shorter steps: the energy drifts. */
void bead_step_control_shorten(struct bead_step_control *control);
/* Length of the next step, s. */
double bead_step_control_next(struct bead_step_control *control, const struct bead_stepper *stepper);
/* Length of the next step of a chain with damping, s: h, or less where damping is so strong that velocities decay faster than beads
 * vibrate. */
double bead_step_control_damped(const struct bead_stepper *stepper, double accuracy, double h);

#endif
