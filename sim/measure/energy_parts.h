/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a chain's energy over time, for tables and plots: by form, or by place along the chain.
 *
 * By place, a bead has its kinetic energy, its springs' energy, and its shares of its contacts'. It is `reflected` if it passes
 * energy back: its velocity times the force on it (less the static one) is below 0. Of the others, those from the last deep minimum
 * of the contact forces on are the `front`, up to where the first pulse ends; the rest are `behind`. The front keeps its last bead:
 * no later pulse becomes the front. */
#pragma once

#include "beadreel/sink.h"
#include "sim/base/internal.h"

/* The position of a chain's front at the last sample; zeros before the first. */
struct bead_energy_front {
    size_t from; /* its last bead; SIZE_MAX: it has turned back */
    double peak; /* N, its largest force */
};

/* The number of parts that an output shows. */
BEAD_INTERNAL size_t bead_energy_parts_count(const struct bead_output *output);
/* The number of parts that are stacked, up to `dissipated`. After them come the work of the drive and any other input, the sum of
 * the stack less that work, then energies past the beads that the output lists. */
BEAD_INTERNAL size_t bead_energy_parts_stacked(const struct bead_output *output);
/* Name of part `i`, "kinetic"; "past bead 20". */
BEAD_INTERNAL void bead_energy_part_name(const struct bead_output *output, size_t i, char name[40]);
/* Finds the parts, J, of a sample with a budget. */
BEAD_INTERNAL void bead_energy_parts_find(const struct bead_output *output, const struct bead_chain *chain,
                                          const struct bead_sample *sample, struct bead_energy_front *front, double *parts);
