/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The key of a stage: materials and the scale of its light; and the room that a film leaves for its numbers. */
#pragma once

#include "beadreel/view.h"

/* The parts of the key that other stages have, if chains are below each other: materials are named where they first occur; the
 * light's scale is at the last chain that names none, which has more room for its label, else at the first. */
unsigned bead_stage_key_elsewhere(const struct bead_chain *const *chains, size_t count, size_t chain);
/* Room, px, that the key of a stage takes at the right of its headroom. */
double bead_stage_key_room(const struct bead_view_setup *setup);
/* Draws one key for the stages of several chains, which ends at `right` px, or with `cr` NULL measures it; returns its width.
 * `setup`: of the first chain. */
double bead_stage_draw_key_of(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_chain *const *chains,
                              size_t count, double right, double middle, double size);

/* The line of numbers below a stage, in units of the ticks' font size. */
#define BEAD_STAGE_NUMBERS 1.45
