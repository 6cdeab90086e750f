/* Packed pixels: whatever the picture, a decoder of others reads it as it was. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/picture.h"
#include "render/huffman.h"
#include "tests/pictures.h"

/* ---- codes ---- */

static uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Codes fill the space of all bits, none begins another, and what is oftener has none longer. */
static void assert_codes(size_t count, const uint32_t *often, unsigned longest)
{
    struct bead_code codes[BEAD_HUFFMAN_MOST];
    double filled = 0;
    bead_huffman_make(count, often, longest, codes);
    for (size_t i = 0; i < count; i++) {
        assert_in_range(codes[i].length, often[i] > 0 ? 1 : 0, longest);
        filled += codes[i].length ? ldexp(1, -codes[i].length) : 0;
        for (size_t k = 0; k < count; k++) {
            unsigned shorter = codes[i].length < codes[k].length ? codes[i].length : codes[k].length;
            if (often[i] > often[k] && often[k] > 0)
                assert_true(codes[i].length <= codes[k].length);
            if (i != k && shorter > 0)
                assert_true(((codes[i].bits ^ codes[k].bits) & ((1u << shorter) - 1)) != 0);
        }
    }
    assert_true(filled == 1);
}

static void test_codes_are_complete(void **state)
{
    (void)state;
    uint32_t often[BEAD_HUFFMAN_MOST] = {0}, random = 1;
    assert_codes(30, often, 15); /* nothing occurs */
    often[7] = 5;
    assert_codes(30, often, 15);
    for (int round = 0; round < 40; round++) {
        for (size_t i = 0; i < BEAD_HUFFMAN_MOST; i++)
            often[i] = round % 3 ? next_random(&random) % (1u << round % 12) : next_random(&random) % 7 == 0;
        assert_codes(BEAD_HUFFMAN_MOST, often, 15);
        assert_codes(19, often, 7);
    }
    /* Fibonacci's numbers need the deepest trees: longer codes than may be. */
    memset(often, 0, sizeof often);
    for (size_t i = 0; i < 28; i++)
        often[i] = i < 2 ? 1 : often[i - 1] + often[i - 2];
    assert_codes(28, often, 15);
    assert_codes(19, often, 7);
}

static void test_codes_are_the_shortest(void **state)
{
    (void)state;
    static const uint32_t often[6] = {5, 9, 12, 13, 16, 45}; /* Cormen and others, Introduction to Algorithms */
    static const uint8_t wanted[6] = {4, 4, 3, 3, 3, 1};
    struct bead_code codes[6];
    bead_huffman_make(6, often, 15, codes);
    for (int i = 0; i < 6; i++)
        assert_int_equal(codes[i].length, wanted[i]);
}

/* ---- pictures ---- */

typedef uint32_t (*colour_at)(int x, int y, uint32_t *random);

static uint32_t flat(int x, int y, uint32_t *random)
{
    (void)x, (void)y, (void)random;
    return 0x123456;
}

static uint32_t noise(int x, int y, uint32_t *random)
{
    (void)x, (void)y;
    return next_random(random);
}

static uint32_t few_colours(int x, int y, uint32_t *random)
{
    (void)x, (void)y;
    return next_random(random) % 5 * 0x30201;
}

static uint32_t slope(int x, int y, uint32_t *random)
{
    (void)random;
    return (uint32_t)(x * y) * 0x10307 & 0xffffff;
}

/* Rare colours among frequent ones, each half as often as the one before; and rows that come again far above. */
static uint32_t uneven(int x, int y, uint32_t *random)
{
    (void)x;
    uint32_t number = y % 5 == 4 ? (uint32_t)(x * 7919) : next_random(random);
    return 0x010101u * (uint32_t)__builtin_ctz(number | 1u << 20);
}

static const colour_at drawings[] = {flat, noise, few_colours, slope, uneven};

static void assert_picture(int width, int height, colour_at draw, bool indexed)
{
    char path[512];
    uint32_t random = 7, *pixels = malloc(4 * (size_t)width * (size_t)height);
    uint8_t *indices = malloc((size_t)width * (size_t)height), palette[256][3];
    for (int i = 0; i < width * height; i++) {
        pixels[i] = draw(i % width, i / width, &random);
        indices[i] = (uint8_t)pixels[i];
    }
    for (int i = 0; i < 256; i++)
        palette[i][0] = palette[i][1] = palette[i][2] = (uint8_t)i;
    const struct bead_frame frame = {.pixels = (uint8_t *)pixels, .width = width, .height = height, .stride = 4 * (size_t)width};
    const struct bead_picture_notes notes = {.dpi = 0};
    in_directory("packed.png", path, sizeof path);
    assert_int_equal(indexed ? bead_png_write_indexed(path, width, height, indices, palette, &notes, NULL, NULL)
                             : bead_png_write(path, &frame, &notes, NULL, NULL),
                     BEAD_OK);
    struct png_file png = read_png(path);
    assert_true(png.width == width && png.height == height);
    for (int i = 0; i < width * height; i++) {
        const uint8_t *got = png.rgb + 3 * (size_t)i;
        uint32_t colour = (uint32_t)got[0] << 16 | (uint32_t)got[1] << 8 | got[2];
        uint32_t wanted = indexed ? 0x010101u * indices[i] : pixels[i] & 0xffffff;
        if (colour != wanted)
            fail_msg("%d x %d, pixel %d: %06x, not %06x", width, height, i, colour, wanted);
    }
    free(png.rgb);
    free(pixels);
    free(indices);
}

static void test_pictures_are_read_as_they_were(void **state)
{
    (void)state;
    /* One pixel; narrower than a match is long; many rows; rows longer than 32 kB, so that the one above is out of reach. */
    static const int sizes[][2] = {{1, 1}, {1, 400}, {2, 3}, {85, 90}, {86, 3}, {259, 61}, {640, 300}, {11000, 5}, {40000, 4}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (size_t d = 0; d < sizeof drawings / sizeof drawings[0]; d++) {
            assert_picture(sizes[s][0], sizes[s][1], drawings[d], false);
            assert_picture(sizes[s][0], sizes[s][1], drawings[d], true);
        }
}

static void test_flat_pictures_are_small(void **state)
{
    (void)state;
    enum { WIDTH = 1920, HEIGHT = 1080 };
    char path[512];
    uint64_t bytes = 0;
    uint8_t *indices = calloc(WIDTH, HEIGHT), palette[256][3] = {{0}};
    const struct bead_picture_notes notes = {.dpi = 0};
    in_directory("flat.png", path, sizeof path);
    assert_int_equal(bead_png_write_indexed(path, WIDTH, HEIGHT, indices, palette, &notes, &bytes, NULL), BEAD_OK);
    assert_in_range(bytes, 1000, 20000); /* two million pixels */
    free(indices);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_codes_are_complete),
        cmocka_unit_test(test_codes_are_the_shortest),
        cmocka_unit_test(test_pictures_are_read_as_they_were),
        cmocka_unit_test(test_flat_pictures_are_small),
    };
    return cmocka_run_group_tests_name("deflate", tests, make_directory, remove_directory);
}
