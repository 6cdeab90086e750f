/* Step control: how long the next steps may be. */
#ifndef BEADREEL_SIM_CONTROL_H
#define BEADREEL_SIM_CONTROL_H

#include "sim/stepper.h"

/* Bound of the frequencies that the chain can show within about `ahead` seconds from the end of the step just made, rad/s:
 * Gershgorin's circles for the stiffnesses at the compressions to be expected, those of now and what the beads' velocities add. */
double bead_control_omega(const struct bead_stepper *stepper, double ahead);

#endif
