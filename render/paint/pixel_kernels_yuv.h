/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: the conversion of frames for encoders.
 * BT.709, limited range, from full-range R'G'B' 0..255 (ITU-R BT.709-6, items 3.2-3.5 for 8 bits):
 *   Y  =  16 + 219/255 (0.2126 R + 0.7152 G + 0.0722 B)
 *   Cb = 128 + 224/255 (B - Y') / 1.8556,   Cr = 128 + 224/255 (R - Y') / 1.5748
 * times 2^14, rounded so that greys have no colour and white is exactly 235; at most 0.53 levels from the formula. */
enum {
    YR = 2991,
    YG = 10064,
    YB = 1016,
    UR = -1649,
    UG = -5547,
    UB = 7196,
    VR = 7196,
    VG = -6536,
    VB = -660,
    FRACTION = 14,
    LUMA_BASE = (16 << FRACTION) + (1 << (FRACTION - 1)),
    /* Chroma is computed from the sum of four pixels. */
    CHROMA_FRACTION = FRACTION + 2,
    CHROMA_BASE = (128 << CHROMA_FRACTION) + (1 << (CHROMA_FRACTION - 1)),
};
_Static_assert(UR + UG + UB == 0 && VR + VG + VB == 0, "greys have no colour");
_Static_assert((LUMA_BASE + 255 * (YR + YG + YB)) >> FRACTION == 235, "white is 235");

/* A block is 16 pixels wide, for vectors of any width. */
enum { BLOCK = 16, VECTORS = BLOCK / LANES };

#if LANES == 16
#define ADD_PRODUCTS(x, y) ((ints)_mm512_madd_epi16((__m512i)(x), (__m512i)(y)))
/* Sums of neighbours are in every second lane. */
enum { SUMS = 1 };
static inline void add_neighbours(const pairs *x, pairs *sum)
{
    sum[0] = x[0] + (pairs)_mm512_srli_epi64((__m512i)x[0], 32);
}

static inline void store_luma(const ints *y, uint8_t *to)
{
    _mm_store_si128((__m128i *)to, _mm512_cvtepi32_epi8((__m512i)y[0]));
}

static inline void store_chroma(const ints *u, const ints *v, uint8_t *to_u, uint8_t *to_v)
{
    _mm_storel_epi64((__m128i *)to_u, _mm512_cvtepi64_epi8((__m512i)u[0]));
    _mm_storel_epi64((__m128i *)to_v, _mm512_cvtepi64_epi8((__m512i)v[0]));
}
#elif LANES == 8
#define ADD_PRODUCTS(x, y) ((ints)_mm256_madd_epi16((__m256i)(x), (__m256i)(y)))
/* Sums of neighbours are in the order 0, 1, 4, 5, 2, 3, 6, 7. */
enum { SUMS = 1 };
static inline void add_neighbours(const pairs *x, pairs *sum)
{
    const __m256 a = (__m256)x[0], b = (__m256)x[1];
    sum[0] = (pairs)_mm256_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)) + (pairs)_mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1));
}

static inline void store_luma(const ints *y, uint8_t *to)
{
    __m256i bytes = _mm256_packs_epi32((__m256i)y[0], (__m256i)y[1]);
    bytes = _mm256_packus_epi16(bytes, bytes);
    _mm_store_si128((__m128i *)to, _mm_unpacklo_epi32(_mm256_castsi256_si128(bytes), _mm256_extracti128_si256(bytes, 1)));
}

static inline void store_chroma(const ints *u, const ints *v, uint8_t *to_u, uint8_t *to_v)
{
    __m256i bytes = _mm256_packs_epi32((__m256i)u[0], (__m256i)v[0]);
    bytes = _mm256_packus_epi16(bytes, bytes);
    __m128i both = _mm_unpacklo_epi16(_mm256_castsi256_si128(bytes), _mm256_extracti128_si256(bytes, 1));
    _mm_storel_epi64((__m128i *)to_u, both);
    _mm_storel_epi64((__m128i *)to_v, _mm_unpackhi_epi64(both, both));
}
#else
enum { SUMS = 2 };
static inline void add_neighbours(const pairs *x, pairs *sum)
{
    for (int i = 0; i < SUMS; i++) {
        const reals a = (reals)x[2 * i], b = (reals)x[2 * i + 1];
        sum[i] = (pairs)__builtin_shufflevector(a, b, 0, 2, 4, 6) + (pairs)__builtin_shufflevector(a, b, 1, 3, 5, 7);
    }
}
#ifdef KERNELS_PORTABLE
typedef uint8_t few_bytes __attribute__((vector_size(LANES)));

static inline ints add_products(pairs x, pairs y)
{
    const ints a = (ints)x, b = (ints)y, low = (ints)((words)x << 16) >> 16;
    return low * ((ints)((words)y << 16) >> 16) + (a >> 16) * (b >> 16);
}
#define ADD_PRODUCTS(x, y) add_products(x, (pairs)(y))

static inline void store_bytes(const ints *x, int vectors, uint8_t *to)
{
    for (int i = 0; i < vectors; i++) {
        const few_bytes bytes = __builtin_convertvector(x[i], few_bytes);
        memcpy(to + LANES * i, &bytes, LANES);
    }
}

static inline void store_luma(const ints *y, uint8_t *to)
{
    store_bytes(y, VECTORS, to);
}

static inline void store_chroma(const ints *u, const ints *v, uint8_t *to_u, uint8_t *to_v)
{
    store_bytes(u, SUMS, to_u);
    store_bytes(v, SUMS, to_v);
}
#else
#define ADD_PRODUCTS(x, y) ((ints)_mm_madd_epi16((__m128i)(x), (__m128i)(y)))

static inline void store_luma(const ints *y, uint8_t *to)
{
    __m128i low = _mm_packs_epi32((__m128i)y[0], (__m128i)y[1]), high = _mm_packs_epi32((__m128i)y[2], (__m128i)y[3]);
    _mm_store_si128((__m128i *)to, _mm_packus_epi16(low, high));
}

static inline void store_chroma(const ints *u, const ints *v, uint8_t *to_u, uint8_t *to_v)
{
    __m128i us = _mm_packs_epi32((__m128i)u[0], (__m128i)u[1]), vs = _mm_packs_epi32((__m128i)v[0], (__m128i)v[1]);
    __m128i both = _mm_packus_epi16(us, vs);
    _mm_storel_epi64((__m128i *)to_u, both);
    _mm_storel_epi64((__m128i *)to_v, _mm_unpackhi_epi64(both, both));
}
#endif
#endif

/* Pixels, or sums of pixels, as 16-bit numbers: (blue, red) and (green, anything) in each lane. */
static inline ints weigh(pairs blue_red, pairs green, int blue, int of_green, int red, int base)
{
    const words both = (words)all(0) + ((uint32_t)red << 16 | (uint16_t)blue), one = (words)all(0) + (uint16_t)of_green;
    return ADD_PRODUCTS(blue_red, both) + ADD_PRODUCTS(green, one) + base;
}

static inline void luma_of(const pairs *blue_red, const pairs *green, uint8_t *to)
{
    ints y[VECTORS];
    for (int i = 0; i < VECTORS; i++)
        y[i] = weigh(blue_red[i], green[i], YB, YG, YR, LUMA_BASE) >> FRACTION;
    store_luma(y, to);
}

/* Chroma of the mean of each 2 x 2 pixels: this filter neither shifts nor rings. */
static inline void chroma_of(const pairs *blue_red, const pairs *green, uint8_t *to_u, uint8_t *to_v)
{
    pairs both[SUMS], one[SUMS];
    ints u[SUMS], v[SUMS];
    add_neighbours(blue_red, both);
    add_neighbours(green, one);
    for (int i = 0; i < SUMS; i++) {
        u[i] = weigh(both[i], one[i], UB, UG, UR, CHROMA_BASE) >> CHROMA_FRACTION;
        v[i] = weigh(both[i], one[i], VB, VG, VR, CHROMA_BASE) >> CHROMA_FRACTION;
    }
    store_chroma(u, v, to_u, to_v);
}

static void two_rows_to_yuv420(const uint8_t *const bgrx[2], uint8_t *const y[2], uint8_t *u, uint8_t *v, int width)
{
    for (int x = 0; x < width; x += BLOCK) {
        pairs blue_red[2][VECTORS], green[2][VECTORS];
        for (int k = 0; k < 2; k++) {
            const words_anywhere *pixels = (const words_anywhere *)(bgrx[k] + 4 * (size_t)x);
            for (int i = 0; i < VECTORS; i++) {
                blue_red[k][i] = (pairs)(pixels[i] & 0xff00ff);
                green[k][i] = (pairs)(pixels[i] >> 8 & 0xff00ff);
            }
            luma_of(blue_red[k], green[k], y[k] + x);
        }
        for (int i = 0; i < VECTORS; i++) {
            blue_red[0][i] += blue_red[1][i];
            green[0][i] += green[1][i];
        }
        chroma_of(blue_red[0], green[0], u + x / 2, v + x / 2);
    }
}
