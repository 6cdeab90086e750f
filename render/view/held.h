/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples for pictures further apart than the pulses of forces: each has the largest forces since the previous one, so that no
 * impact falls between two of them.
 *
 *   bead_held_create -> bead_held_feed, for each picture bead_held_take -> bead_held_destroy */
#pragma once

#include "beadreel/chain.h"
#include "beadreel/sample.h"

struct bead_held;

/* Does the field show pulses, so that its largest values are held? */
bool bead_held_shows(enum bead_field field);
/* The spacing, s, of samples that miss no pulse. `resolution`: as in bead_run_context. */
double bead_held_spacing(double resolution);
/* Do pictures this far apart, s, miss pulses of one of these fields (BEAD_FIELD_BITs)? */
bool bead_held_is_needed(const struct bead_chain *chain, unsigned fields, double every, double resolution);
/* For these fields of a chain's beads, and as many contacts. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_held_create(const struct bead_chain *chain, unsigned fields, struct bead_span beads,
                                            struct bead_held **held, struct bead_message *msg);
void bead_held_destroy(struct bead_held *held);
void bead_held_feed(struct bead_held *held, const struct bead_sample *sample);
/* The last sample fed, with the forces furthest from zero since the last call; valid until the next feed. NULL: nothing has been
 * fed since. */
const struct bead_sample *bead_held_take(struct bead_held *held);
