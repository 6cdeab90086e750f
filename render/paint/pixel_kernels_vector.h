/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: vectors of 32-bit numbers, one for each pixel, as wide as in the instruction set, in GCC's and
 * Clang's vector types. With KERNELS_PORTABLE only these types are used. */
#include <math.h>
#include <stdint.h>

#if defined KERNELS_PORTABLE
#define LANES         4
#define COUNT         0, 1, 2, 3
#define ROOT_OF(x)    roots(x)
#define LARGER(x, y)  larger(x, y)
#define SMALLER(x, y) smaller(x, y)
#else
#include <immintrin.h>
#if defined __AVX512F__
#define LANES         16
#define COUNT         0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
#define ROOT_OF(x)    ((reals)_mm512_sqrt_ps(x))
#define LARGER(x, y)  ((reals)_mm512_max_ps(x, y))
#define SMALLER(x, y) ((reals)_mm512_min_ps(x, y))
#elif defined __AVX2__
#define LANES         8
#define COUNT         0, 1, 2, 3, 4, 5, 6, 7
#define ROOT_OF(x)    ((reals)_mm256_sqrt_ps(x))
#define LARGER(x, y)  ((reals)_mm256_max_ps(x, y))
#define SMALLER(x, y) ((reals)_mm256_min_ps(x, y))
#else
#define LANES         4
#define COUNT         0, 1, 2, 3
#define ROOT_OF(x)    ((reals)_mm_sqrt_ps(x))
#define LARGER(x, y)  ((reals)_mm_max_ps(x, y))
#define SMALLER(x, y) ((reals)_mm_min_ps(x, y))
#endif
#endif
typedef float reals __attribute__((vector_size(4 * LANES)));
typedef float reals_anywhere __attribute__((vector_size(4 * LANES), aligned(4), may_alias));
typedef int32_t ints __attribute__((vector_size(4 * LANES)));
typedef uint32_t words __attribute__((vector_size(4 * LANES)));
typedef uint32_t words_anywhere __attribute__((vector_size(4 * LANES), aligned(4), may_alias));
/* Two colours of each pixel. */
typedef uint16_t pairs __attribute__((vector_size(4 * LANES)));
typedef int16_t signed_pairs __attribute__((vector_size(4 * LANES)));

static inline reals all(float x)
{
    return x - (reals){0};
}

#ifdef KERNELS_PORTABLE
static inline reals choose(ints mask, reals yes, reals no)
{
    return (reals)((mask & (ints)yes) | (~mask & (ints)no));
}

static inline reals larger(reals x, reals y)
{
    return choose(x > y, x, y);
}

static inline reals smaller(reals x, reals y)
{
    return choose(x < y, x, y);
}

static inline reals roots(reals x)
{
    return (reals){sqrtf(x[0]), sqrtf(x[1]), sqrtf(x[2]), sqrtf(x[3])};
}
#endif

static inline reals clamp(reals x)
{
    return SMALLER(LARGER(x, all(0)), all(1));
}

static inline reals magnitude(reals x)
{
    return (reals)((ints)x & INT32_MAX);
}

/* These two are for numbers from 0 to 2^22. */
static inline reals whole_part(reals x)
{
    return __builtin_convertvector(__builtin_convertvector(x, ints), reals);
}

static inline ints ceiling(reals x)
{
    ints whole = __builtin_convertvector(x, ints);
    return whole - (x > __builtin_convertvector(whole, reals));
}

/* 0..1 to 0..255, rounding to nearest, ties to even: the number added moves the integer into the last bits of the sum, on top of
 * LEVEL_ZERO. */
#define LEVEL_ZERO 0x4b400000u
static inline words level_of(reals x)
{
    return (words)(x * 255.0f + 12582912.0f);
}

/* Levels as two colours of each pixel. */
static inline pairs pair_of(words low, words high)
{
    return (pairs)(low + (high << 16) - LEVEL_ZERO);
}
