/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pixels for encoders: BT.709 by its formula, rectangles like whole frames, palettes exact if possible. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/colour/palette.h"
#include "render/encode/pictures.h"
#include "render/paint/pixel_kernels.h"

static uint32_t random_bits(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static struct bead_frame random_frame(int width, int height, uint32_t seed)
{
    struct bead_frame frame;
    assert_int_equal(bead_frame_create(width, height, &frame, NULL), BEAD_OK);
    for (size_t i = 0; i < frame.stride * (size_t)height; i++)
        frame.pixels[i] = (uint8_t)random_bits(&seed); /* the fourth byte and the padding mean nothing */
    return frame;
}

static AVFrame *new_picture(enum AVPixelFormat format, int width, int height)
{
    AVFrame *picture = av_frame_alloc();
    assert_non_null(picture);
    picture->format = format;
    picture->width = width;
    picture->height = height;
    assert_int_equal(av_frame_get_buffer(picture, 64), 0);
    return picture;
}

static void pixel(const struct bead_frame *frame, int x, int y, double rgb[3])
{
    const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
    for (int c = 0; c < 3; c++)
        rgb[c] += p[2 - c] / 255.0;
}

static double luma(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

static void convert_all(const struct bead_frame *frame, AVFrame *picture)
{
    struct bead_rect all = {0, 0, frame->width, frame->height};
    bead_convert_find(picture->format)(frame, bead_convert_align(frame, all), picture);
}

/* Every value is the rounded one of the real-number formula, within the precision of the fixed point. */
static void bt709_is_exact(void **state)
{
    (void)state;
    struct bead_frame frame = random_frame(226, 150, 1);
    AVFrame *picture = new_picture(AV_PIX_FMT_YUV420P, frame.width, frame.height);
    convert_all(&frame, picture);
    double worst = 0;
    for (int y = 0; y < frame.height; y++) {
        for (int x = 0; x < frame.width; x++) {
            double rgb[3] = {0};
            pixel(&frame, x, y, rgb);
            worst = fmax(worst, fabs(picture->data[0][y * picture->linesize[0] + x] - (16 + 219 * luma(rgb))));
        }
    }
    for (int y = 0; y < frame.height; y += 2) {
        for (int x = 0; x < frame.width; x += 2) {
            double rgb[3] = {0};
            for (int i = 0; i < 4; i++)
                pixel(&frame, x + i % 2, y + i / 2, rgb);
            double cb = 128 + 224 * (rgb[2] - luma(rgb)) / 4 / 1.8556, cr = 128 + 224 * (rgb[0] - luma(rgb)) / 4 / 1.5748;
            worst = fmax(worst, fabs(picture->data[1][y / 2 * picture->linesize[1] + x / 2] - cb));
            worst = fmax(worst, fabs(picture->data[2][y / 2 * picture->linesize[2] + x / 2] - cr));
        }
    }
    assert_true(worst < 0.53);
    av_frame_free(&picture);
    bead_frame_free(&frame);
}

/* Four pixels share their colour: of those that cover something, wherever they are among the four, as if they were opaque; but for
 * rounding, what is transparent adds none. */
static void transparent_pixels_add_no_colour(void **state)
{
    (void)state;
    AVFrame *picture = new_picture(AV_PIX_FMT_YUVA420P, 32, 2), *opaque = new_picture(AV_PIX_FMT_YUV420P, 32, 2);
    for (int clear = 0; clear < 16; clear++) { /* a bit for each pixel of a block */
        struct bead_frame frame = random_frame(32, 2, 1);
        for (int i = 0; i < 64; i++)
            memcpy(frame.pixels + (size_t)(i / 32) * frame.stride + 4 * (size_t)(i % 32), (const uint8_t[]){40, 90, 200, 255}, 4);
        frame.alpha = false;
        convert_all(&frame, opaque);
        frame.alpha = true;
        for (int i = 0; i < 64; i++) {
            if (clear >> (i / 32 * 2 + i % 2) & 1)
                memset(frame.pixels + (size_t)(i / 32) * frame.stride + 4 * (size_t)(i % 32), 0, 4);
        }
        convert_all(&frame, picture);
        for (int i = 0; i < 64; i++) {
            const int x = i % 32, y = i / 32, bit = clear >> (y * 2 + x % 2) & 1;
            assert_int_equal(picture->data[3][y * picture->linesize[3] + x], bit ? 0 : 255);
            assert_true(clear == 15 ||
                        picture->data[0][y * picture->linesize[0] + x] == opaque->data[0][y * opaque->linesize[0] + x]);
            for (int plane = 1; plane < 3; plane++)
                assert_int_equal(picture->data[plane][x / 2], clear == 15 ? 128 : opaque->data[plane][x / 2]);
        }
        bead_frame_free(&frame);
    }
    av_frame_free(&picture);
    av_frame_free(&opaque);
}

/* Of all levels, also beside the block that is converted. */
static void instruction_sets_give_the_same_bytes(void **state)
{
    enum { PIXELS = 80, BYTES = 96 };
    static const char *const names[] = {"portable", "sse2", "avx2", "avx512"};
    (void)state;
    _Alignas(64) uint8_t first[4][BYTES], bytes[4][BYTES];
    uint32_t seed = 5;
    for (int turn = 0; turn < 200; turn++) {
        struct bead_frame frame = random_frame(PIXELS, 2, random_bits(&seed));
        if (turn % 3 == 0) { /* the ends of the range */
            for (size_t i = 0; i < 2 * frame.stride; i++)
                frame.pixels[i] = random_bits(&seed) & 1 ? 255 : 0;
        }
        const uint8_t *const rows[2] = {frame.pixels, frame.pixels + frame.stride};
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(names[i]);
            if (!kernels)
                continue; /* this machine has none */
            memset(bytes, 77, sizeof bytes);
            uint8_t *const y[2] = {bytes[0], bytes[1]};
            kernels->yuv420(rows, y, bytes[2], bytes[3], PIXELS);
            for (int line = 0; line < 4; line++)
                assert_int_equal(bytes[line][line < 2 ? PIXELS : PIXELS / 2], 77);
            if (i == 0)
                memcpy(first, bytes, sizeof bytes);
            assert_memory_equal(first, bytes, sizeof bytes);
        }
        bead_frame_free(&frame);
    }
}

static void fill(struct bead_frame *frame, uint32_t rgb)
{
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
            p[0] = (uint8_t)rgb;
            p[1] = (uint8_t)(rgb >> 8);
            p[2] = (uint8_t)(rgb >> 16);
        }
    }
}

/* The levels of the standard: black 16, white 235, greys without colour, primaries at the ends of the range. */
static void bt709_has_the_levels_of_the_standard(void **state)
{
    (void)state;
    static const struct {
        uint32_t rgb;
        int y, u, v;
    } known[] = {{0x000000, 16, 128, 128}, {0xffffff, 235, 128, 128}, {0x808080, 126, 128, 128}, {0xff0000, 63, 102, 240},
                 {0x00ff00, 173, 42, 26},  {0x0000ff, 32, 240, 118},  {0x00ffff, 188, 154, 16},  {0xffff00, 219, 16, 138}};
    struct bead_frame frame;
    assert_int_equal(bead_frame_create(16, 2, &frame, NULL), BEAD_OK);
    AVFrame *picture = new_picture(AV_PIX_FMT_YUV420P, 16, 2);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        fill(&frame, known[i].rgb);
        convert_all(&frame, picture);
        assert_int_equal(picture->data[0][5], known[i].y);
        assert_int_equal(picture->data[1][3], known[i].u);
        assert_int_equal(picture->data[2][3], known[i].v);
    }
    av_frame_free(&picture);
    bead_frame_free(&frame);
}

static void assert_same_pictures(const AVFrame *a, const AVFrame *b)
{
    for (int plane = 0; plane < 3 && a->data[plane]; plane++) {
        int part = a->format == AV_PIX_FMT_YUV420P && plane ? 2 : 1;
        size_t bytes = (size_t)a->width / (size_t)part;
        bytes *= a->format == AV_PIX_FMT_BGR0 ? 4 : a->format == AV_PIX_FMT_RGB24 ? 3 : 1;
        for (int y = 0; y < a->height / part; y++)
            assert_memory_equal(a->data[plane] + y * a->linesize[plane], b->data[plane] + y * b->linesize[plane], bytes);
    }
}

/* Change random rectangles, convert only those: the same bits as converting everything. */
static void changed_rectangles_are_enough(void **state)
{
    (void)state;
    static const enum AVPixelFormat formats[] = {AV_PIX_FMT_YUV420P, AV_PIX_FMT_BGR0, AV_PIX_FMT_RGB24, AV_PIX_FMT_GBRP};
    uint32_t seed = 7;
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        struct bead_frame frame = random_frame(118, 74, 3);
        AVFrame *kept = new_picture(formats[f], frame.width, frame.height),
                *whole = new_picture(formats[f], frame.width, frame.height);
        convert_all(&frame, kept);
        for (int i = 0; i < 200; i++) {
            struct bead_rect r = {(int)(random_bits(&seed) % 140) - 10, (int)(random_bits(&seed) % 90) - 8,
                                  (int)(random_bits(&seed) % 40), (int)(random_bits(&seed) % 20)};
            for (int y = r.y < 0 ? 0 : r.y; y < r.y + r.height && y < frame.height; y++) {
                for (int x = r.x < 0 ? 0 : r.x; x < r.x + r.width && x < frame.width; x++) {
                    uint32_t bits = random_bits(&seed);
                    memcpy(frame.pixels + (size_t)y * frame.stride + 4 * (size_t)x, &bits, 4);
                }
            }
            struct bead_rect aligned = bead_convert_align(&frame, r);
            if (aligned.width)
                bead_convert_find(formats[f])(&frame, aligned, kept);
            convert_all(&frame, whole);
            assert_same_pictures(kept, whole);
        }
        av_frame_free(&kept);
        av_frame_free(&whole);
        bead_frame_free(&frame);
    }
}

static void rectangles_are_clipped(void **state)
{
    (void)state;
    struct bead_frame frame = {.width = 50, .height = 21, .stride = 256};
    static const struct {
        struct bead_rect in, out;
    } cases[] = {{{0, 0, 50, 21}, {0, 0, 64, 21}},       {{17, 3, 1, 1}, {16, 2, 16, 2}},
                 {{-5, -5, 6, 6}, {0, 0, 16, 2}},        {{50, 0, 5, 5}, {0, 0, 0, 0}},
                 {{0, 21, 5, 5}, {0, 0, 0, 0}},          {{3, 3, 0, 5}, {0, 0, 0, 0}},
                 {{3, 3, -4, 5}, {0, 0, 0, 0}},          {{49, 20, 2147483647, 2147483647}, {48, 20, 16, 1}},
                 {{-2147483647, 0, 10, 2}, {0, 0, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_rect r = bead_convert_align(&frame, cases[i].in);
        assert_memory_equal(&r, &cases[i].out, sizeof r);
    }
}

/* An animation of `count` pictures in a palette: the root mean square difference of all channels of each. */
enum { SHADES = 256 * 128 };
static void reduce(uint8_t (*rgb)[3 * SHADES], size_t count, size_t pixels, uint8_t (*indices)[SHADES], uint32_t colours[256],
                   double *difference)
{
    struct bead_palette *palette;
    assert_int_equal(bead_palette_create(&palette, NULL), BEAD_OK);
    for (size_t k = 0; k < count; k++)
        bead_palette_count(palette, rgb[k], pixels);
    assert_int_equal(bead_palette_choose(palette, NULL), BEAD_OK);
    bead_palette_colours(palette, colours);
    for (size_t k = 0; k < count; k++) {
        double sum = 0;
        bead_palette_convert(palette, rgb[k], pixels, indices[k]);
        for (size_t i = 0; i < pixels; i++) {
            assert_true(indices[k][i] < BEAD_PALETTE_MOST && colours[indices[k][i]] >> 24 == 255);
            for (size_t c = 0; c < 3; c++)
                sum += pow((double)rgb[k][3 * i + c] - (double)(colours[indices[k][i]] >> (16 - 8 * c) & 255), 2);
        }
        difference[k] = sqrt(sum / (3.0 * (double)pixels));
    }
    assert_int_equal(colours[BEAD_PALETTE_MOST], 0);
    bead_palette_destroy(palette);
}

static uint8_t animation[2][3 * SHADES], reduced[2][SHADES];

static void set(size_t picture, int at, int r, int g, int b)
{
    const uint8_t rgb[3] = {(uint8_t)r, (uint8_t)g, (uint8_t)b};
    memcpy(animation[picture] + 3 * at, rgb, sizeof rgb);
}

static void palette_is_exact_for_few_colours(void **state)
{
    (void)state;
    for (int colours = 1; colours <= 255; colours += 127) {
        uint32_t chosen[256];
        double difference[2];
        for (int i = 0; i < 3333; i++) { /* the second picture has other colours */
            int k = i % ((colours + 1) / 2), other = colours - 1 - k;
            set(0, i, k * 37 % 256, k, 255 - k);
            set(1, i, other * 37 % 256, other, 255 - other);
        }
        reduce(animation, 2, 3333, reduced, chosen, difference);
        assert_true(difference[0] == 0 && difference[1] == 0);
    }
}

/* Smooth shading in thousands of colours; then colours that the first picture has not. */
static void palette_is_close_for_many_colours(void **state)
{
    (void)state;
    uint32_t chosen[256];
    double difference[2];
    for (int i = 0; i < SHADES; i++) {
        int x = i % 256, y = i / 256;
        for (size_t k = 0; k < 2; k++) {
            if (y < 64)
                set(k, i, x, 4 * y, 255 - x);
            else if (k == 0)
                set(k, i, 0xfd, 0xfd, 0xfc);
            else
                set(k, i, 10, x / 32 * 32, 20);
        }
    }
    reduce(animation, 2, SHADES, reduced, chosen, difference);
    assert_true(difference[0] < 7 && difference[1] < 7);
    assert_int_equal(chosen[reduced[0][100 * 256 + 9]], 0xfffdfdfc); /* the background is what it was */
    for (int x = 0; x < 256; x += 32) {
        int green = (int)(chosen[reduced[1][100 * 256 + x]] >> 8 & 255);
        assert_true(abs(green - x) <= 12);
    }
}

/* Tones are parted where they differ most, whichever channel it is: the dark, more frequent, from the light. */
static void tones_are_parted_along_the_widest_channel(void **state)
{
    (void)state;
    for (int wide = 0; wide < 24; wide += 8) {
        const int narrow = (wide + 8) % 24; /* by this one, one dark and one light tone would be in each part */
        struct bead_tone tones[4];
        for (uint32_t i = 0; i < 4; i++)
            tones[i] =
                (struct bead_tone){(i < 2 ? 10 + i : 200 + i) << wide | (i % 2 ? 30u : 5u) << narrow, i < 2 ? 10 + i : 3 + i};
        uint32_t chosen[2];
        assert_int_equal(bead_palette_cut(tones, 4, 2, chosen), 2);
        const uint32_t low = chosen[0] < chosen[1] ? chosen[0] : chosen[1], high = chosen[0] ^ chosen[1] ^ low;
        const uint32_t dark = (low >> wide & 255) < 100 ? low : high, light = low ^ high ^ dark;
        assert_int_equal(dark, 11u << wide | 30u << narrow);
        assert_int_equal(light, 203u << wide | 30u << narrow);
    }
}

/* Squares about the means of tones first..end-1, by their values. */
static double spread(const struct bead_tone *tones, size_t first, size_t end)
{
    double weight = 0, mean = 0, sum = 0;
    for (size_t i = first; i < end; i++)
        weight += tones[i].count, mean += (double)tones[i].count * tones[i].colour;
    for (size_t i = first; i < end; i++)
        sum += tones[i].count * pow(tones[i].colour - mean / weight, 2);
    return sum;
}

static uint32_t most_frequent(const struct bead_tone *tones, size_t first, size_t end)
{
    size_t most = first;
    for (size_t i = first; i < end; i++)
        most = tones[i].count > tones[most].count ? i : most;
    return tones[most].colour;
}

/* Of all ways to part a few tones in two, the one with the least squares, found by trying all. */
static void tones_are_parted_where_it_is_best(void **state)
{
    (void)state;
    enum { TONES = 6 };
    uint32_t random = 1;
    for (int k = 0; k < 300; k++) {
        struct bead_tone tones[TONES];
        uint32_t value = 0, chosen[2];
        double least = INFINITY, second = INFINITY;
        size_t best = 0;
        for (size_t i = 0; i < TONES; i++) { /* no two are equally frequent */
            random = random * 1664525u + 1013904223u;
            value += 1 + (random >> 29);
            tones[i] = (struct bead_tone){value, 1 + (uint32_t)i + TONES * (random >> 24 & 3)};
        }
        for (size_t cut = 1; cut < TONES; cut++) {
            const double sum = spread(tones, 0, cut) + spread(tones, cut, TONES);
            best = sum < least ? cut : best;
            second = sum < least ? least : fmin(second, sum);
            least = fmin(least, sum);
        }
        const uint32_t low = most_frequent(tones, 0, best), high = most_frequent(tones, best, TONES);
        assert_int_equal(bead_palette_cut(tones, TONES, 2, chosen), 2);
        if (second - least > 1e-9 * second && (chosen[0] ^ chosen[1] ^ low ^ high || (chosen[0] != low && chosen[0] != high)))
            fail_msg("case %d: %u and %u, not %u and %u", k, chosen[0], chosen[1], low, high);
    }
}

static void chosen_colours_are_far_apart(void **state)
{
    (void)state;
    struct bead_tone tones[] = {{0xff0000, 10}, {0xfe0000, 1000}, {0x0000ff, 1}, {0x00ff00, 5}, {0x00fe00, 4}, {0x000001, 100000}};
    uint32_t chosen[4];
    assert_int_equal(bead_palette_cut(tones, 6, 4, chosen), 4);
    static const uint32_t wanted[] = {0xfe0000, 0x0000ff, 0x00ff00, 0x000001};
    for (size_t w = 0; w < 4; w++) {
        int found = 0;
        for (size_t i = 0; i < 4; i++)
            found += chosen[i] == wanted[w];
        assert_int_equal(found, 1);
    }
    assert_int_equal(bead_palette_cut(tones, 0, 4, chosen), 0);
    assert_int_equal(bead_palette_cut(tones, 2, 4, chosen), 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bt709_is_exact),
        cmocka_unit_test(transparent_pixels_add_no_colour),
        cmocka_unit_test(instruction_sets_give_the_same_bytes),
        cmocka_unit_test(bt709_has_the_levels_of_the_standard),
        cmocka_unit_test(changed_rectangles_are_enough),
        cmocka_unit_test(rectangles_are_clipped),
        cmocka_unit_test(palette_is_exact_for_few_colours),
        cmocka_unit_test(palette_is_close_for_many_colours),
        cmocka_unit_test(tones_are_parted_along_the_widest_channel),
        cmocka_unit_test(tones_are_parted_where_it_is_best),
        cmocka_unit_test(chosen_colours_are_far_apart),
    };
    return cmocka_run_group_tests_name("convert", tests, NULL, NULL);
}
