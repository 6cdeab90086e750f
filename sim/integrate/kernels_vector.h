/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by kernels_body.h: vectors of the instruction set's width, in GCC's and Clang's vector types. KERNELS_PORTABLE uses
 * nothing else, with 128 bits as in most processors. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#if defined KERNELS_PORTABLE
#define LANES            2
#define ROOTS            1
#define FOLLOW           1, 2
#define LOWER            0, 1
#define UPPER            2, 3
#define FLOAT_ROOT_OF(x) ((floats){sqrtf((x)[0]), sqrtf((x)[1]), sqrtf((x)[2]), sqrtf((x)[3])})
#define ROOT_OF(x)       ((lanes){sqrt((x)[0]), sqrt((x)[1])})
#define LARGER_OF(x, y)  choose((x) > (y), x, y)
#define SMALLER_OF(x, y) choose((x) < (y), x, y)
#define BITS_OF(x)       ((unsigned)((x)[0] < 0) | (unsigned)((x)[1] < 0) << 1)
#define EACH(f)          f(0), f(1)
#else
#include <immintrin.h>
#if defined __AVX512F__
#define LANES            8
#define ROOTS            3
#define FOLLOW           7, 8, 9, 10, 11, 12, 13, 14
#define LOWER            0, 1, 2, 3, 4, 5, 6, 7
#define UPPER            8, 9, 10, 11, 12, 13, 14, 15
#define FLOAT_ROOT_OF(x) ((floats)_mm512_sqrt_ps(x))
#define ROOT_OF(x)       ((lanes)_mm512_sqrt_pd(x))
#define LARGER_OF(x, y)  ((lanes)_mm512_max_pd(x, y))
#define SMALLER_OF(x, y) ((lanes)_mm512_min_pd(x, y))
#define BITS_OF(x)       _mm512_movepi64_mask((__m512i)(x))
#define EACH(f)          f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)
#elif defined __AVX2__
#define LANES            4
#define ROOTS            1
#define FOLLOW           3, 4, 5, 6
#define LOWER            0, 1, 2, 3
#define UPPER            4, 5, 6, 7
#define FLOAT_ROOT_OF(x) ((floats)_mm256_sqrt_ps(x))
#define ROOT_OF(x)       ((lanes)_mm256_sqrt_pd(x))
#define LARGER_OF(x, y)  ((lanes)_mm256_max_pd(x, y))
#define SMALLER_OF(x, y) ((lanes)_mm256_min_pd(x, y))
#define BITS_OF(x)       ((unsigned)_mm256_movemask_pd((__m256d)(x)))
#define EACH(f)          f(0), f(1), f(2), f(3)
#else
#define LANES            2
#define ROOTS            1
#define FOLLOW           1, 2
#define LOWER            0, 1
#define UPPER            2, 3
#define FLOAT_ROOT_OF(x) ((floats)_mm_sqrt_ps(x))
#define ROOT_OF(x)       ((lanes)_mm_sqrt_pd(x))
#define LARGER_OF(x, y)  ((lanes)_mm_max_pd(x, y))
#define SMALLER_OF(x, y) ((lanes)_mm_min_pd(x, y))
#define BITS_OF(x)       ((unsigned)_mm_movemask_pd((__m128d)(x)))
#define EACH(f)          f(0), f(1)
#endif
#endif
typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef int64_t lane_masks __attribute__((vector_size(8 * LANES)));
typedef signed char lane_bytes __attribute__((vector_size(LANES), may_alias, aligned(1)));
typedef double lanes_anywhere __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

/* Single precision, for numbers that need only 7 digits: a vector holds twice as many, and roots and quotients are faster. */
enum { FLOATS = 2 * LANES };
typedef float floats __attribute__((vector_size(8 * LANES)));
typedef float floats_anywhere __attribute__((vector_size(8 * LANES), aligned(4), may_alias));
typedef int32_t float_masks __attribute__((vector_size(8 * LANES)));
typedef float half_floats __attribute__((vector_size(4 * LANES)));

static inline lanes load_lanes(const double *p)
{
    return *(const lanes_anywhere *)p;
}

static inline void store_lanes(double *p, lanes x)
{
    *(lanes_anywhere *)p = x;
}

static inline lanes positive_part(lanes x)
{
    return (lanes)((lane_masks)x & (x > 0));
}

static inline lanes magnitude(lanes x)
{
    return (lanes)((lane_masks)x & INT64_MAX);
}

static inline lanes choose(lane_masks mask, lanes yes, lanes no)
{
    return (lanes)((mask & (lane_masks)yes) | (~mask & (lane_masks)no));
}

/* The last of `before` and all but the last of `now`. */
static inline lanes follow_lanes(lanes before, lanes now)
{
    return __builtin_shufflevector(before, now, FOLLOW);
}

/* x > y ? x : y, and x < y ? x : y */
static inline lanes larger_lanes(lanes x, lanes y)
{
    return LARGER_OF(x, y);
}

static inline lanes smaller_lanes(lanes x, lanes y)
{
    return SMALLER_OF(x, y);
}

static inline bool any_lane(lane_masks x)
{
    return BITS_OF(x) != 0;
}

/* Stores a byte 0 or 1 for each lane. */
static inline void store_marks(unsigned char *p, lane_masks x)
{
#if LANES == 8
    *(lane_bytes *)p = __builtin_convertvector(x, lane_bytes) & 1;
#else
    const uint32_t bytes = BITS_OF(x) * 0x204081u & 0x01010101u; /* bit i moves to bit 8 i */
    memcpy(p, &bytes, LANES);
#endif
}

static inline lanes gather_lanes(const double *x, const size_t *at)
{
#define GATHERED(i) x[(ptrdiff_t)at[i]]
    return (lanes){EACH(GATHERED)};
#undef GATHERED
}

/* A bit for each lane where x < y. */
static inline unsigned less_bits(lanes x, lanes y)
{
#if LANES == 8
    return _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ);
#else
    return BITS_OF(x < y);
#endif
}

/* Packs the numbers k, k + 1, ... of lanes whose bits are set; writes whole vectors. Returns their count. */
static inline size_t pack_numbers(unsigned bits, size_t k, size_t *out)
{
#if LANES == 8
    const __m512i number = _mm512_add_epi64(_mm512_set1_epi64((long long)k), _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi64((__mmask8)bits, number));
#elif LANES == 4
    /* a byte for each lane that is set, the lowest first */
    static const uint32_t lane[16] = {0, 0,     1,     0x100,   2,     0x200,   0x201,   0x20100,
                                      3, 0x300, 0x301, 0x30100, 0x302, 0x30200, 0x30201, 0x3020100};
    const __m256i number = _mm256_cvtepu8_epi64(_mm_cvtsi32_si128((int)lane[bits]));
    _mm256_storeu_si256((__m256i *)out, _mm256_add_epi64(_mm256_set1_epi64x((long long)k), number));
#else
    for (size_t i = 0, n = 0; i < LANES; n += bits >> i++ & 1)
        out[n] = k + i;
#endif
    return (size_t)__builtin_popcount(bits);
}

static inline floats narrow_lanes(lanes low, lanes high)
{
    return __builtin_shufflevector(__builtin_convertvector(low, half_floats), __builtin_convertvector(high, half_floats), LOWER,
                                   UPPER);
}

static inline lanes widen_lower(floats x)
{
    return __builtin_convertvector(__builtin_shufflevector(x, x, LOWER), lanes);
}

static inline lanes widen_upper(floats x)
{
    return __builtin_convertvector(__builtin_shufflevector(x, x, UPPER), lanes);
}

static inline floats choose_floats(float_masks mask, floats yes, floats no)
{
    return (floats)((mask & (float_masks)yes) | (~mask & (float_masks)no));
}

static inline floats positive_floats(floats x)
{
    return (floats)((float_masks)x & (x > 0));
}

static inline floats magnitude_floats(floats x)
{
    return (floats)((float_masks)x & INT32_MAX);
}

static inline floats larger_floats(floats x, floats y)
{
    return choose_floats(x > y, x, y);
}

static inline floats root_floats(floats x)
{
    return FLOAT_ROOT_OF(x);
}

static inline bool any_float(float_masks x)
{
    return any_lane((lane_masks)x | (lane_masks)x << 32);
}

#if LANES == 8
/* The square root, correctly rounded like the instruction's but three times as fast: an estimate, two Newton steps for it and its
 * inverse, and the remainder x - g^2, exact in a fused multiply-add (P. Markstein, IBM J. Res. Dev. 34 (1990) 111). Zeros remain
 * zeros. If the remainder might underflow, or x is not finite, the instruction is used. */
static inline lanes root_of(lanes x)
{
    const __m512i low = _mm512_set1_epi64(0x0800000000000000), span = _mm512_set1_epi64(0x7000000000000000);
    const __m512d half = _mm512_set1_pd(0.5);
    const __mmask8 fine = _mm512_cmplt_epu64_mask(_mm512_sub_epi64(_mm512_castpd_si512(x), low), span);
    if (__builtin_expect(_mm512_mask_cmp_pd_mask((__mmask8)~fine, x, _mm512_setzero_pd(), _CMP_NEQ_UQ), 0))
        return _mm512_sqrt_pd(x);
    __m512d y = _mm512_maskz_rsqrt14_pd(fine, x), g = _mm512_mul_pd(x, y), h = _mm512_mul_pd(half, y);
    for (int i = 0; i < 2; i++) {
        __m512d rest = _mm512_fnmadd_pd(g, h, half);
        g = _mm512_fmadd_pd(g, rest, g);
        h = _mm512_fmadd_pd(h, rest, h);
    }
    return _mm512_fmadd_pd(_mm512_fnmadd_pd(g, g, x), h, g);
}
#else
static inline lanes root_of(lanes x)
{
    return ROOT_OF(x);
}
#endif

/* A d_+^{3/2} for long loops. */
static inline lanes hertz_of(lanes stiffness, lanes d)
{
    d = positive_part(d);
    return stiffness * (d * root_of(d));
}
