/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Step control: how long the next step may be.
 *
 * The step is theta/omega. omega bounds the frequencies of the chain: at first from the energy put in, then every few steps from
 * the current compressions, so that steps grow as amplitudes decay, and by the frequency of a drive. theta follows from the
 * requested accuracy by a law measured for each method. Steps depend on the state only, never on the outputs. */
#pragma once

#include "sim/integrate/stepper.h"

struct bead_step_control {
    double theta;        /* step in units of 1/omega */
    double static_omega; /* rad/s, of the whole chain at rest, including the part ahead of the window */
    double longest;      /* s */
    double h;            /* s: the current step */
};

/* omega: upper bound of the frequencies from the chain's energy. */
struct bead_step_control bead_step_control_start(const struct bead_stepper *stepper, double theta, double omega);
/* Shortens all further steps, because the energy drifts. */
void bead_step_control_shorten(struct bead_step_control *control);
/* Length of the next step, s. */
double bead_step_control_next(struct bead_step_control *control, const struct bead_stepper *stepper);
/* Length of the next step of a chain with damping, s: h, or less if velocities decay faster than beads vibrate. */
double bead_step_control_damped(const struct bead_stepper *stepper, double accuracy, double h);
