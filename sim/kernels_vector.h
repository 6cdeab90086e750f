/* Included by kernels_body.h: vectors as wide as the instruction set has them, in GCC's and Clang's vector types. */
#include <immintrin.h>
#include <stdint.h>

#if defined __AVX512F__
#define LANES      8
#define ROOTS      3
#define FOLLOW     7, 8, 9, 10, 11, 12, 13, 14
#define ROOT_OF(x) ((lanes)_mm512_sqrt_pd(x))
#define ANY_OF(x)  (_mm512_test_epi64_mask((__m512i)(x), (__m512i)(x)) != 0)
#elif defined __AVX2__
#define LANES      4
#define ROOTS      1
#define FOLLOW     3, 4, 5, 6
#define ROOT_OF(x) ((lanes)_mm256_sqrt_pd(x))
#define ANY_OF(x)  (!_mm256_testz_si256((__m256i)(x), (__m256i)(x)))
#else
#define LANES      2
#define ROOTS      1
#define FOLLOW     1, 2
#define ROOT_OF(x) ((lanes)_mm_sqrt_pd(x))
#define ANY_OF(x)  (_mm_movemask_epi8((__m128i)(x)) != 0)
#endif
typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef int64_t lane_masks __attribute__((vector_size(8 * LANES)));
typedef signed char lane_bytes __attribute__((vector_size(LANES), may_alias, aligned(1)));
typedef double lanes_anywhere __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

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

static inline lanes larger_lanes(lanes x, lanes y)
{
    return choose(x > y, x, y);
}

static inline bool any_lane(lane_masks x)
{
    return ANY_OF(x);
}

#ifdef __AVX512F__
/* The square root, rounded correctly as the instruction's is but three times as fast: an estimate, two Newton steps for it and its
 * inverse, and the remainder x - g^2, exact in a fused multiply-add (P. Markstein, IBM J. Res. Dev. 34 (1990) 111). Zeros stay
 * zeros. Where the remainder might underflow, or x is not finite, the instruction does it. */
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

/* A d_+^{3/2}, of many in a row */
static inline lanes hertz_of(lanes stiffness, lanes d)
{
    d = positive_part(d);
    return stiffness * (d * root_of(d));
}
