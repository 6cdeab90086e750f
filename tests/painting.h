/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of painters: random places and levels. */
#ifndef BEADREEL_TESTS_PAINTING_H
#define BEADREEL_TESTS_PAINTING_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "beadreel/error.h"

static inline void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

static inline uint32_t random_bits(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* From low to high in 64ths, as views place balls. */
static inline float random_place(uint32_t *seed, double low, double high)
{
    return (float)(round((low + (high - low) * random_bits(seed) / 16777216.0) * 64) / 64);
}

#endif
