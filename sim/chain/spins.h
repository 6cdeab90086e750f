/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spins of a segment's cells. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* The number of up cells among `count` for which (2 up - count)/count is nearest to `magnetism`; the larger of two. */
size_t bead_spins_up(size_t count, double magnetism);

/* Fill `digits` (count characters, not terminated) with exactly bead_spins_up() ones in random order: a
 * Fisher-Yates shuffle whose draw i is word i of Philox4x32 under key `seed` and stream `configuration`,
 * so that it depends on nothing else. */
void bead_spins_draw(char *digits, size_t count, double magnetism, uint64_t seed, uint64_t configuration);
/* As above with a given number of ones. */
void bead_spins_shuffle(char *digits, size_t count, size_t up, uint64_t seed, uint64_t configuration);
