/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A record of steps: the states between them, kept so that a stepper can be set to any step again, such as for a sweep backwards.
 */
#ifndef BEADREEL_SIM_ADJOINT_RECORD_H
#define BEADREEL_SIM_ADJOINT_RECORD_H

#include <stddef.h>

#include "sim/integrate/stepper.h"

/* A state between two steps. */
struct bead_recorded {
    double time;   /* s */
    size_t active; /* beads kept: the others are at rest */
    size_t at;     /* where its u, v and a begin in `values` */
};

struct bead_record {
    struct bead_recorded *state; /* [steps + 1], the first at time 0 */
    size_t steps, room;
    double *values;
    size_t used, size;
};

/* Add the step just made; the first one with its start. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_record_add(struct bead_record *record, const struct bead_stepper *stepper,
                                           struct bead_message *msg);
/* Set a stepper of the same chain to step `step` (from 0 on) of the record: its start, end and times are those, and beads behind
 * its window are at rest. Forces are not kept. */
void bead_record_load(const struct bead_record *record, size_t step, struct bead_stepper *stepper);
void bead_record_free(struct bead_record *record);

#endif
