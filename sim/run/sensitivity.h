/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensitivities: the derivatives of peak forces by the mass, radius and modulus of every bead, and by the striker's velocity.
 *
 * The chain is run once more, with steps of its own, and its states are kept; each peak then takes one sweep back over them
 * (adjoint.h). */
#ifndef BEADREEL_SIM_RUN_SENSITIVITY_H
#define BEADREEL_SIM_RUN_SENSITIVITY_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"
#include "sim/integrate/kernels.h"

/* Whose: the force of a contact, or of a bead, at the time of its peak. */
struct bead_sensitive {
    bool of_bead;
    size_t index;
    const struct bead_peak *peak;
};

/* The contacts meant where none are named: both of each bead with a sensor; without sensors the last whose force has had a maximum,
 * or the last of all. Into list[2 sensors + 1], rising; returns how many. */
size_t bead_sensitive_contacts(const struct bead_chain *chain, const struct bead_peak *peaks, size_t *list);

/* What they are found with. */
struct bead_sensitivity_run {
    const struct bead_chain *chain;
    const struct bead_kernels *kernels;
    const volatile sig_atomic_t *stop; /* NULL: nobody stops it */
    double accuracy;                   /* asked for; what is found here may take more, or less */
    bool passage;                      /* the run has ended by itself, at no time that is given */
};

/* Derivatives of all these peaks, each with arrays of its own (bead_sensitivity_free). A peak that the chain has at rest, and one
 * that is the force at the end of the run, where it still rises, have the derivatives of the force at that time; of the latter
 * there are none (NaN) where the front's arrival has ended the run, for that has another time in another chain. Errors: MEMORY,
 * NUMBERS, STOPPED. */
BEAD_CHECK enum bead_error bead_sensitivities_find(const struct bead_sensitivity_run *run, const struct bead_sensitive *peaks,
                                                   size_t count, struct bead_sensitivity *found, struct bead_message *msg);
/* Standard deviations of all these peaks, N, to first order: beads of a material with tolerances differ from one another, each on
 * its own, in radius, with the mass that follows from the density, and in modulus; so does a wall, in modulus. Errors: as above. */
BEAD_CHECK enum bead_error bead_deviations_find(const struct bead_sensitivity_run *run, const struct bead_sensitive *peaks,
                                                size_t count, double *deviation, struct bead_message *msg);
void bead_sensitivity_free(struct bead_sensitivity *sensitivity);

#endif
