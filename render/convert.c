#include "render/convert.h"

#include <emmintrin.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A block is 16 pixels wide: a cache line of BGRX, a vector of luma. */
enum { BLOCK = 16 };

/* BT.709, limited range, from full-range R'G'B' 0..255 (ITU-R BT.709-6, items 3.2-3.5 for 8 bits):
 *   Y  =  16 + 219/255 (0.2126 R + 0.7152 G + 0.0722 B)
 *   Cb = 128 + 224/255 (B - Y') / 1.8556,   Cr = 128 + 224/255 (R - Y') / 1.5748
 * times 2^14, rounded so that greys have no colour and white is exactly 235; 0.53 levels from the formula at most. */
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
    /* Chroma is of the sum of four pixels. */
    CHROMA_FRACTION = FRACTION + 2,
    CHROMA_BASE = (128 << CHROMA_FRACTION) + (1 << (CHROMA_FRACTION - 1)),
};
_Static_assert(UR + UG + UB == 0 && VR + VG + VB == 0, "greys have no colour");
_Static_assert((LUMA_BASE + 255 * (YR + YG + YB)) >> FRACTION == 235, "white is 235");

/* Four pixels, or sums of pixels, as 16-bit numbers: (blue, red) and (green, anything) in each 32 bits. */
struct four {
    __m128i blue_red, green;
};

static inline struct four load(const uint8_t *bgrx)
{
    const __m128i bytes = _mm_set1_epi32(0xff00ff);
    __m128i pixels = _mm_loadu_si128((const __m128i *)bgrx);
    return (struct four){_mm_and_si128(pixels, bytes), _mm_and_si128(_mm_srli_epi32(pixels, 8), bytes)};
}

static inline __m128i weigh(struct four p, int blue, int green, int red, int base)
{
    __m128i br = _mm_madd_epi16(p.blue_red, _mm_set1_epi32((int)((uint32_t)red << 16 | (uint16_t)blue)));
    __m128i g = _mm_madd_epi16(p.green, _mm_set1_epi32((uint16_t)green));
    return _mm_add_epi32(_mm_add_epi32(br, g), _mm_set1_epi32(base));
}

static inline __m128i luma(struct four p)
{
    return _mm_srai_epi32(weigh(p, YB, YG, YR, LUMA_BASE), FRACTION);
}

static inline void store_luma(const struct four p[4], uint8_t *to)
{
    __m128i low = _mm_packs_epi32(luma(p[0]), luma(p[1])), high = _mm_packs_epi32(luma(p[2]), luma(p[3]));
    _mm_store_si128((__m128i *)to, _mm_packus_epi16(low, high));
}

/* Sums of neighbours in two vectors of 32-bit pairs. */
static inline __m128i add_neighbours(__m128i low, __m128i high)
{
    __m128 a = _mm_castsi128_ps(low), b = _mm_castsi128_ps(high);
    __m128i even = _mm_castps_si128(_mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)));
    __m128i odd = _mm_castps_si128(_mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
    return _mm_add_epi16(even, odd);
}

/* The sum of each 2 x 2 pixels (their mean is the filter that neither shifts nor rings). */
static inline struct four add_squares(const struct four above[2], const struct four below[2])
{
    return (struct four){
        add_neighbours(_mm_add_epi16(above[0].blue_red, below[0].blue_red), _mm_add_epi16(above[1].blue_red, below[1].blue_red)),
        add_neighbours(_mm_add_epi16(above[0].green, below[0].green), _mm_add_epi16(above[1].green, below[1].green))};
}

static inline void store_chroma(const struct four sum[2], int blue, int green, int red, uint8_t *to)
{
    __m128i low = _mm_srai_epi32(weigh(sum[0], blue, green, red, CHROMA_BASE), CHROMA_FRACTION);
    __m128i high = _mm_srai_epi32(weigh(sum[1], blue, green, red, CHROMA_BASE), CHROMA_FRACTION);
    __m128i words = _mm_packs_epi32(low, high);
    _mm_storel_epi64((__m128i *)to, _mm_packus_epi16(words, words));
}

static uint8_t *line(const AVFrame *picture, int plane, int y)
{
    return picture->data[plane] + (ptrdiff_t)y * picture->linesize[plane];
}

static const uint8_t *row(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

static void two_rows_to_yuv420(const uint8_t *above, const uint8_t *below, uint8_t *y0, uint8_t *y1, uint8_t *u, uint8_t *v,
                               int width)
{
    for (int x = 0; x < width; x += BLOCK) {
        struct four a[4], b[4];
        for (int i = 0; i < 4; i++) {
            a[i] = load(above + 4 * (size_t)x + 16 * (size_t)i);
            b[i] = load(below + 4 * (size_t)x + 16 * (size_t)i);
        }
        store_luma(a, y0 + x);
        store_luma(b, y1 + x);
        struct four sum[2] = {add_squares(a, b), add_squares(a + 2, b + 2)};
        store_chroma(sum, UB, UG, UR, u + x / 2);
        store_chroma(sum, VB, VG, VR, v + x / 2);
    }
}

static void to_yuv420(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y += 2) {
        two_rows_to_yuv420(row(frame, r.x, y), row(frame, r.x, y + 1), line(picture, 0, y) + r.x, line(picture, 0, y + 1) + r.x,
                           line(picture, 1, y / 2) + r.x / 2, line(picture, 2, y / 2) + r.x / 2, r.width);
    }
}

static void copy_bgr0(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++)
        memcpy(line(picture, 0, y) + 4 * (ptrdiff_t)r.x, row(frame, r.x, y), 4 * (size_t)r.width);
}

static void to_rgb24(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        const uint8_t *from = row(frame, r.x, y);
        uint8_t *to = line(picture, 0, y) + 3 * (ptrdiff_t)r.x;
        for (int x = 0; x < r.width; x++, from += 4, to += 3) {
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
        }
    }
}

static void to_gbrp(const struct bead_frame *frame, struct bead_rect r, AVFrame *picture)
{
    for (int y = r.y; y < r.y + r.height; y++) {
        const uint8_t *from = row(frame, r.x, y);
        uint8_t *g = line(picture, 0, y) + r.x, *b = line(picture, 1, y) + r.x, *red = line(picture, 2, y) + r.x;
        for (int x = 0; x < r.width; x++, from += 4) {
            b[x] = from[0];
            g[x] = from[1];
            red[x] = from[2];
        }
    }
}

bead_convert bead_convert_find(enum AVPixelFormat format)
{
    static const struct {
        enum AVPixelFormat format;
        bead_convert convert;
    } converters[] = {
        {AV_PIX_FMT_YUV420P, to_yuv420},
        {AV_PIX_FMT_BGR0, copy_bgr0},
        {AV_PIX_FMT_RGB24, to_rgb24},
        {AV_PIX_FMT_GBRP, to_gbrp},
    };
    for (size_t i = 0; i < sizeof converters / sizeof *converters; i++) {
        if (converters[i].format == format)
            return converters[i].convert;
    }
    return NULL;
}

static int clamp(int64_t value, int high)
{
    return value < 0 ? 0 : value > high ? high : (int)value;
}

struct bead_rect bead_convert_align(const struct bead_frame *frame, struct bead_rect rect)
{
    int x0 = clamp(rect.x, frame->width), x1 = clamp((int64_t)rect.x + rect.width, frame->width);
    int y0 = clamp(rect.y, frame->height), y1 = clamp((int64_t)rect.y + rect.height, frame->height);
    if (x1 <= x0 || y1 <= y0)
        return (struct bead_rect){0, 0, 0, 0};
    x0 -= x0 % BLOCK;
    x1 += (BLOCK - x1 % BLOCK) % BLOCK;
    y0 -= y0 % 2;
    y1 += y1 % 2 && y1 < frame->height;
    return (struct bead_rect){x0, y0, x1 - x0, y1 - y0};
}
