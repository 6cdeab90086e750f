/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensitivities: the derivatives of peak forces with respect to the mass, radius and modulus of every bead and the striker's
 * velocity.
 *
 * The chain is run again, with other steps, and its states are recorded; each peak then takes one sweep backwards over them
 * (adjoint.h). */
#pragma once

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sink.h"
#include "sim/integrate/kernels.h"

/* A peak: the force of a contact, or of a bead, at its time. */
struct bead_sensitive {
    bool of_bead;
    size_t index;
    const struct bead_peak *peak;
    const struct bead_peak *rival; /* for deviations: another maximum (peaks.h); NULL, or time NaN: none */
};

/* The default contacts: both of each bead with a sensor; without sensors the last one whose force had a maximum, else the last of
 * all. Fills list[2 sensors + 1] in ascending order and returns the count. */
size_t bead_sensitive_contacts(const struct bead_chain *chain, const struct bead_peak *peaks, size_t *list);

struct bead_sensitivity_run {
    const struct bead_chain *chain;
    const struct bead_kernels *kernels;
    const volatile sig_atomic_t *stop; /* NULL: never stopped */
    double accuracy;                   /* requested; derivatives may need a smaller one */
    double refinement;                 /* of a check run: factor of the accuracy that they need, and of `heavy`; 0: 1 */
    bool passage;                      /* the passage ended the run */
};

/* Derivatives of all these peaks, each with its own arrays (bead_sensitivity_free). A peak of the chain at rest, and a force still
 * rising at the end of the run, have the derivatives of the force at that time; the latter has none (NaN) if the front's arrival
 * ended the run, because that time differs from chain to chain. Errors: MEMORY, NUMBERS, STOPPED. */
BEAD_CHECK enum bead_error bead_sensitivities_find(const struct bead_sensitivity_run *run, const struct bead_sensitive *peaks,
                                                   size_t count, struct bead_sensitivity *found, struct bead_message *msg);
/* Standard deviations of all these peaks, N, to first order, of the larger of a peak and its rival if it has one: beads of a
 * material with tolerances vary independently in radius, with the mass that follows from the density, and in modulus; a wall varies
 * in modulus. rivalled: either may be the highest (out). Errors: as above. */
BEAD_CHECK enum bead_error bead_deviations_find(const struct bead_sensitivity_run *run, const struct bead_sensitive *peaks,
                                                size_t count, double *deviation, bool *rivalled, struct bead_message *msg);
void bead_sensitivity_free(struct bead_sensitivity *sensitivity);
