/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures: numbers that describe the run of one chain: speed, width, energy of the leading pulse, decay, transmission ...
 *
 *   err = bead_measures_create(chain, false, &measures, &msg);
 *   err = bead_measures_feed(measures, sample, &msg);      every sample of this chain, in order, equally spaced
 *   count = bead_measures_read(measures, outcome, found, room);
 *   bead_measures_destroy(measures);
 *
 * Everything is measured at contacts, from forces less their static part. The leading pulse is the first: it lasts until the force
 * of the contact has fallen below a tenth of its maximum. Integrals over it end where the contact opens, or at the first minimum
 * below a twentieth, and at the latest three times its rise after its maximum. It is measured at the probe, a contact far enough
 * from the end of the chain not to be disturbed by it, and, if the chain repeats itself there (uniform, dimers, ...), over one
 * whole cell. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/sink.h"
#include "sim/base/internal.h"

/* A measure of chains, and its method: row `index`, NULL after the last. */
struct bead_measure_info {
    const char *name, *unit; /* unit "": a number */
    const char *help;        /* definition, with its source unless it is this project's */
};
BEAD_INTERNAL const struct bead_measure_info *bead_measure_info(size_t index);

/* Largest distance of samples, in units of the spacing that shows every oscillation: polynomials through seven of them follow a
 * pulse to six digits. */
#define BEAD_MEASURE_SPACING 2.0
/* A pulse ends when the force falls to this part of its maximum, or of the next pulse's. */
#define BEAD_PULSE_END 0.1
/* Fields that samples must have, of all beads. */
#define BEAD_MEASURE_FIELDS \
    (BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) | BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT))

struct bead_measures;

/* Runs the clean wave, more accurately for measures of a check run. The chain must outlive the measures. Errors: MEMORY. On failure
 * *measures is NULL. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_measures_create(const struct bead_chain *chain, bool of_check,
                                                              struct bead_measures **measures, struct bead_message *msg);
/* The samples that measures of check runs need for each of the run's, so that their difference tells the errors of curves through
 * samples, too. */
BEAD_INTERNAL size_t bead_measures_each(const struct bead_chain *const *chains, size_t count);
BEAD_INTERNAL void bead_measures_destroy(struct bead_measures *measures);
/* Errors: MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_measures_feed(struct bead_measures *measures, const struct bead_sample *sample,
                                                            struct bead_message *msg);
/* Call it after the last sample. Finds the measures that this run has, in the order of bead_measure_info; `outcome` may be NULL.
 * Returns how many there are; fills at most `room`. */
BEAD_INTERNAL size_t bead_measures_read(struct bead_measures *measures, const struct bead_outcome *outcome,
                                        struct bead_measure *found, size_t room);
/* The uncertainty of a measure, from those of a check run; NaN: that run does not have it. */
BEAD_INTERNAL double bead_measure_uncertainty(const struct bead_measure *measure, const struct bead_measure *checks, size_t count);
