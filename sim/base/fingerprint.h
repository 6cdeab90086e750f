/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fingerprints: 64 bits that detect accidental differences; they do not protect against deliberate ones. */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { BEAD_FINGERPRINT_START = 0x2545f491 };

/* Add `size` bytes to `hash`: FNV-1a, mixed at the end, so that every bit of the result depends on every byte. */
static inline uint64_t bead_fingerprint(uint64_t hash, const void *bytes, size_t size)
{
    hash ^= 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    hash = (hash ^ (hash >> 31)) * 0xbf58476d1ce4e5b9u;
    return hash ^ (hash >> 29);
}
