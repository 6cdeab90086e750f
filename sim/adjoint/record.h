/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A record of steps: the states between them, so that a stepper can return to any step, as in a sweep backwards. */
#pragma once

#include <stddef.h>

#include "sim/integrate/stepper.h"

/* A state between two steps. */
struct bead_recorded {
    double time;   /* s */
    size_t active; /* beads recorded: the others are at rest */
    size_t at;     /* index of its u, v and a in `values` */
};

struct bead_record {
    struct bead_recorded *state; /* [steps + 1], the first at time 0 */
    size_t steps, room;
    double *values;
    size_t used, size;
};

/* Adds the last step; the first one with its start. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_record_add(struct bead_record *record, const struct bead_stepper *stepper,
                                           struct bead_message *msg);
/* Sets a stepper of the same chain to step `step` (from 0) of the record: start, end and times; beads outside its window are at
 * rest. Forces are not recorded. */
void bead_record_load(const struct bead_record *record, size_t step, struct bead_stepper *stepper);
void bead_record_free(struct bead_record *record);
