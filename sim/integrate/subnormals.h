/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the processor treat subnormal numbers as zeros, in operands and in results. */
#pragma once

#include <stdint.h>

#if defined __x86_64__
#include <xmmintrin.h>
/* Flush to zero, and denormals are zeros. */
#define FLUSH_FLAGS 0x8040

static inline uint64_t arithmetic_flags(void)
{
    return _mm_getcsr();
}

static inline void set_arithmetic_flags(uint64_t flags)
{
    _mm_setcsr((unsigned)flags);
}
#elif defined __aarch64__
/* FPCR.FZ, for both. */
#define FLUSH_FLAGS (1 << 24)

static inline uint64_t arithmetic_flags(void)
{
    uint64_t flags;
    __asm__ volatile("mrs %0, fpcr" : "=r"(flags));
    return flags;
}

static inline void set_arithmetic_flags(uint64_t flags)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(flags) : "memory");
}
#else
#error "no way known to flush subnormal numbers to zero on this processor: results would differ in their bits"
#endif

/* Returns the previous flags, for set_arithmetic_flags. */
static inline uint64_t flush_subnormals(void)
{
    const uint64_t before = arithmetic_flags();
    set_arithmetic_flags(before | FLUSH_FLAGS);
    return before;
}
