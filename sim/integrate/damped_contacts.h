/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with damping, whose force jumps when they close.
 *
 * gamma |D|^a acts from the first touch on, so the force jumps, and a method for smooth forces falls to order 1 there. Beads
 * do not stick, so the force ends, with a kink, where the damping of the parting beads exceeds their elastic force. Therefore a
 * contact stays closed or open for a whole step, and a step in which one changes is repeated so that it ends at the change. */
#ifndef BEADREEL_SIM_INTEGRATE_DAMPED_CONTACTS_H
#define BEADREEL_SIM_INTEGRATE_DAMPED_CONTACTS_H

#include "sim/integrate/stepper.h"

/* A contact that changes its state within a step. */
struct bead_damped_contact {
    double at; /* part of the step; 1: none does */
    size_t contact;
};

/* The first in the step just made. */
struct bead_damped_contact bead_damped_contacts_first(const struct bead_stepper *stepper);
/* Force of a closed contact with damping at compression d that grows by `change` m/s, N; negative where it would have to stick. */
double bead_damped_contacts_force(const struct bead_stepper *stepper, size_t contact, double d, double change);
/* The same of any contact within the step just made: 0 where it is open, or would have to stick. */
double bead_damped_contacts_within(const struct bead_stepper *stepper, size_t contact, double d, double change);
/* States of all contacts at the end of the last step, the start of the next, into stepper->closed. */
void bead_damped_contacts_update(struct bead_stepper *stepper);

#endif
