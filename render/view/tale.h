/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The story of a run in words, from the samples of a picture, for those who cannot see it. "In Clean (M = 1) one pulse of 36 N, 5
 * beads wide, crosses 128 beads in 2.4 ms and keeps its height." */
#pragma once

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"

struct bead_tale;

enum { BEAD_TALE_WORDS = 1600 };

/* The tale of `field` at these beads (or contacts) of all chains, which are borrowed. On failure *tale is NULL. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_tale_create(const struct bead_chain *const *chains, size_t count, enum bead_field field,
                                            struct bead_span beads, struct bead_tale **tale, struct bead_message *msg);
void bead_tale_destroy(struct bead_tale *tale);
/* Samples without the field are ignored. */
void bead_tale_feed(struct bead_tale *tale, const struct bead_sample *sample);
/* A sentence about each chain, or about one; "" before the first sample. tale NULL: "". */
void bead_tale_words(const struct bead_tale *tale, char *out, size_t size);
void bead_tale_of_chain(const struct bead_tale *tale, size_t chain, char *out, size_t size);
