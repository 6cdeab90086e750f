/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random numbers: Philox4x32-10, which gives word `index` of a stream without computing the words before it. */
#pragma once

#include <Random123/philox.h>
#include <stddef.h>
#include <stdint.h>

/* 64 random bits number `index` of stream `stream` under key `seed`. */
static inline uint64_t bead_draw(uint64_t seed, uint64_t stream, uint64_t index)
{
    philox4x32_ctr_t counter = {{(uint32_t)index, (uint32_t)(index >> 32), (uint32_t)stream, (uint32_t)(stream >> 32)}};
    philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    philox4x32_ctr_t bits = philox4x32(counter, key);
    return (uint64_t)bits.v[0] | (uint64_t)bits.v[1] << 32;
}

/* Uniform on 0..count-1, with an error of 2^-64 count: the high word of the product. */
static inline size_t bead_draw_below(uint64_t seed, uint64_t stream, uint64_t index, size_t count)
{
    return (size_t)(((unsigned __int128)bead_draw(seed, stream, index) * count) >> 64);
}
