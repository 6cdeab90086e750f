/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places: the beads and contacts whose curves over time plots and tables show: those with sensors, or those that the output
 * lists. */
#pragma once

#include "beadreel/sink.h"
#include "sim/base/internal.h"

struct bead_place_shown {
    char name[128]; /* of the sensor, or "bead 20", "contact 3" */
    size_t index;   /* in arrays of samples */
    enum bead_field field;
};

/* The number of places that a chain has for this output, and place `k`: beads first. Places that the chain does not have are left
 * out. */
BEAD_INTERNAL size_t bead_places_count(const struct bead_output *output, const struct bead_chain *chain);
BEAD_INTERNAL struct bead_place_shown bead_place_shown(const struct bead_output *output, const struct bead_chain *chain, size_t k);
/* Fails if the chain lacks a listed one. */
BEAD_CHECK enum bead_error bead_places_check(const struct bead_output *output, const struct bead_chain *chain,
                                             struct bead_message *msg);
/* Widen what is needed of samples to one place. */
void bead_place_needs(const struct bead_place_shown *place, struct bead_needs *needs);
/* Widen what is needed of samples, `beads` and `fields`, to all places of the chain. */
BEAD_INTERNAL void bead_places_need(const struct bead_output *output, const struct bead_chain *chain, struct bead_needs *needs);
/* Is a bead, or a contact, listed, or is the list empty? */
bool bead_is_listed(const struct bead_listed *listed, size_t index);
