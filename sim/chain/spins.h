/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spins of a segment's cells. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "sim/base/internal.h"

/* The number of up cells among `count` for which (2 up - count)/count is nearest to `magnetism`; the larger of two. */
size_t bead_spins_up(size_t count, double magnetism);

/* Fill `digits` (count characters, not terminated) with exactly bead_spins_up() ones in random order: a
 * Fisher-Yates shuffle whose draw i is word i of Philox4x32 under key `seed` and stream `configuration`,
 * so that it depends on nothing else. */
void bead_spins_draw(char *digits, size_t count, double magnetism, uint64_t seed, uint64_t configuration);
/* As above with a given number of ones. */
void bead_spins_shuffle(char *digits, size_t count, size_t up, uint64_t seed, uint64_t configuration);

/* Order of `count` digits, '1' up, beside M, which is 0 for up down up down ..., a regular chain of tetramers. The mean length of
 * domains, cells in a row that are turned alike; and the mean of s_i s_(i + d) for d = 1 and 2, s = 1 up and -1 reversed: 1 if all
 * are turned alike; -1 and 1 in that chain. NaN with too few cells. */
#define BEAD_ORDER_DOMAIN      "domain length"
#define BEAD_ORDER_CORRELATION "spin correlation"
#define BEAD_ORDER_SECOND      "spin correlation at 2"
enum { BEAD_ORDERS = 3 };
/* The number of the one of this name; BEAD_ORDERS: none. */
BEAD_INTERNAL int bead_order_named(const char *name);
BEAD_INTERNAL double bead_spins_order(const char *digits, size_t count, int order);
