/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Subnormal numbers taken for zeros, in what is read and in what is written, by the processor that this is compiled for. */
#ifndef BEADREEL_SIM_INTEGRATE_SUBNORMALS_H
#define BEADREEL_SIM_INTEGRATE_SUBNORMALS_H

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
/* FPCR.FZ, which does both. */
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
#error "how this processor flushes subnormal numbers to zero is not known: results would have other bits"
#endif

/* Returns the flags of before, for set_arithmetic_flags. */
static inline uint64_t flush_subnormals(void)
{
    const uint64_t before = arithmetic_flags();
    set_arithmetic_flags(before | FLUSH_FLAGS);
    return before;
}

#endif
