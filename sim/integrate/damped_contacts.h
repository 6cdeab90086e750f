/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts with damping, whose force jumps when they close.
 *
 * gamma |D|^a acts from the first touch on, so the force jumps, which reduces a method for smooth forces to order 1. Beads do not
 * stick, so the force ends, with a kink, when the damping of separating beads exceeds their elastic force. Therefore a contact
 * remains closed or open for a whole step, and a step in which one changes is repeated so that it ends at the change. */
#pragma once

#include "sim/integrate/stepper.h"

/* A contact that opens or closes within a step. */
struct bead_damped_contact {
    double at; /* in steps; 1: there is none */
    size_t contact;
};

/* The first in the last step. */
struct bead_damped_contact bead_damped_contacts_first(const struct bead_stepper *stepper);
/* How much longer the last step should be, in units of itself, to end where contact k opens or closes; 0: close enough, no velocity
 * changes by more than the tolerance of events. */
double bead_damped_contacts_miss(const struct bead_stepper *stepper, size_t contact);
/* Force, N, of a contact with damping within the last step, at compression d that grows by `change` m/s: 0 if it is open or would
 * have to stick. */
double bead_damped_contacts_within(const struct bead_stepper *stepper, size_t contact, double d, double change);
/* Sets stepper->closed to the states of all contacts at the end of the last step. */
void bead_damped_contacts_update(struct bead_stepper *stepper);
