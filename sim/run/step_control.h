/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Step control: how long the next step may be.
 *
 * The step is theta/omega. omega bounds the frequencies of the chain: at first from the energy put in, then every few steps from
 * the current compressions, so that steps grow as amplitudes decay, and by the frequency of a drive. theta follows from the
 * requested accuracy by a law measured for each method. Steps depend on the state only, never on the outputs. */
#pragma once

#include "sim/integrate/stepper.h"

/* A force A d^p + gamma |D|^a d^c has branch points where a contact closes or opens, d = 0, or turns, D = 0: parts of it are
 * x^power, with x the time since or until then, which methods integrate badly. In units of the force at the end of a step: `within`
 * is the largest error of a step with the point in it (0: there is no such point), `beside` the factor of the error of a step away
 * from it. */
enum { BEAD_BRANCH_ELASTIC, BEAD_BRANCH_COMPRESSION, BEAD_BRANCH_RATE, BEAD_BRANCHES };
struct bead_branch {
    double power, within, beside;
    bool steep; /* its slope is infinite, also for the stages of a step */
};

struct bead_step_control {
    double theta;        /* step in units of 1/omega */
    double static_omega; /* rad/s, of the whole chain at rest, including the part ahead of the window */
    double longest;      /* s */
    double h;            /* s: the current step */
    struct bead_branch branch[BEAD_BRANCHES];
};

/* omega: upper bound of the frequencies from the chain's energy. */
struct bead_step_control bead_step_control_start(const struct bead_stepper *stepper, double theta, double omega);
/* Shortens all further steps, because the energy drifts. */
void bead_step_control_shorten(struct bead_step_control *control);
/* Length of the next step, s. */
double bead_step_control_next(struct bead_step_control *control, const struct bead_stepper *stepper);
/* Length of the next step of a chain with damping, s: h, or less if velocities decay faster than beads vibrate. */
double bead_step_control_damped(const struct bead_step_control *control, const struct bead_stepper *stepper, double h);
/* ... and less before and after branch points of forces, so that their quadrature errors are below the tolerance of events. */
double bead_step_control_graded(const struct bead_step_control *control, const struct bead_stepper *stepper, double h);
