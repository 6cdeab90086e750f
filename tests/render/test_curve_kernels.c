/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves as painted by their kernels: instruction sets against each other, and against plain arithmetic. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "beadreel/render.h"
#include "render/paint/pixel_kernels.h"
#include "render/view/profile_scan.h"
#include "tests/painting.h"

/* Noise of all levels. */
static void fill(struct bead_frame *frame)
{
    uint32_t seed = 4711;
    for (size_t i = 0; i < frame->stride * (size_t)frame->height; i++)
        frame->pixels[i] = (uint8_t)random_bits(&seed);
}

/* Slices that cover rows, parts of rows, or nothing. */
static void make_extents(struct bead_extents *e, uint32_t *seed)
{
    for (int i = 0; i < BEAD_SLICES * BEAD_COLUMNS; i++) {
        const float low = random_place(seed, -5, 60), high = low + random_place(seed, 0, 30);
        const bool there = random_bits(seed) % 8;
        e->low[i / BEAD_COLUMNS][i % BEAD_COLUMNS] = there ? low : INFINITY;
        e->high[i / BEAD_COLUMNS][i % BEAD_COLUMNS] = there ? high : -INFINITY;
    }
}

/* A line above an area that reaches far down, in all columns but a few: rows that are wholly covered, or by neither. */
static void make_plateau(struct bead_columns *k, uint32_t *seed)
{
    for (int i = 0; i < BEAD_SLICES * BEAD_COLUMNS; i++) {
        const int slice = i / BEAD_COLUMNS, x = i % BEAD_COLUMNS;
        const float top = random_place(seed, 10, 14);
        k->line.low[slice][x] = x == 5 ? INFINITY : top - 8;
        k->line.high[slice][x] = x == 5 ? -INFINITY : top - 5;
        k->area.low[slice][x] = top;
        k->area.high[slice][x] = x == 21 ? 30 : 40;
    }
}

/* One pixel of a curve, in plain arithmetic. */
static void expect_curve(const struct bead_columns *k, int x, int y, const uint8_t before[4], int after[4])
{
    const struct bead_extents *parts[2] = {&k->area, &k->line};
    for (int c = 0; c < 4; c++)
        after[c] = before[c];
    for (int p = 0; p < 2; p++) {
        double sum = 0;
        for (int s = 0; s < BEAD_SLICES; s++)
            sum += fmax(0, fmin(1, fmin(y + 1, parts[p]->high[s][x]) - fmax(y, parts[p]->low[s][x])));
        for (int c = 0; c < k->channels; c++)
            after[c] =
                (int)(after[c] + (p ? 1 : k->area_alpha) * sum / BEAD_SLICES * ((p ? k->over : k->under)[c] - after[c]) + 0.5);
    }
}

static void check_curves(int channels, bool plateau)
{
    static const char *const names[] = {"portable", "sse2", "avx2", "avx512"};
    enum { FROM = 3, TO = 50, UNTOUCHED = 2 };
    struct bead_frame before, first, other;
    struct bead_message msg = {""};
    uint32_t seed = 99;
    require(bead_frame_create(128, 64, &before, &msg), &msg);
    require(bead_frame_create(128, 64, &first, &msg), &msg);
    require(bead_frame_create(128, 64, &other, &msg), &msg);
    fill(&before);
    struct bead_columns k = {.over = {10, 200, 30.5f, 255}, .under = {250, 0, 99, 255}, .area_alpha = 0.4f, .channels = channels};
    make_extents(&k.line, &seed);
    make_extents(&k.area, &seed);
    if (plateau)
        make_plateau(&k, &seed);
    for (int g = 0; g < BEAD_COLUMNS / BEAD_COLUMN_GROUP; g++) {
        k.from[g] = FROM;
        k.to[g] = g == UNTOUCHED ? FROM : TO;
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(names[i]);
        if (!kernels)
            continue; /* this machine has none */
        memcpy(other.pixels, before.pixels, before.stride * 64);
        kernels->curve(&k, other.pixels + 4 * 32, other.stride);
        if (i == 0)
            memcpy(first.pixels, other.pixels, other.stride * 64);
        assert_memory_equal(first.pixels, other.pixels, other.stride * 64);
    }
    for (int y = 0; y < 64; y++) {
        for (int x = 0; x < 128; x++) {
            const size_t at = (size_t)y * first.stride + 4 * (size_t)x;
            const int column = x - 32, group = column / BEAD_COLUMN_GROUP;
            int expected[4] = {before.pixels[at], before.pixels[at + 1], before.pixels[at + 2], before.pixels[at + 3]};
            if (column >= 0 && column < BEAD_COLUMNS && y >= FROM && y < TO && group != UNTOUCHED)
                expect_curve(&k, column, y, before.pixels + at, expected);
            for (size_t c = 0; c < 4; c++)
                assert_true(abs(first.pixels[at + c] - expected[c]) <= ((int)c < channels));
        }
    }
    bead_frame_free(&before);
    bead_frame_free(&first);
    bead_frame_free(&other);
}

static void test_curves_are_averages_over_slices(void **state)
{
    (void)state;
    check_curves(3, false);
    check_curves(3, true);
}

static void test_curves_cover_transparent_frames(void **state)
{
    (void)state;
    check_curves(4, false);
    check_curves(4, true);
}

/* Dashes are as long as their pattern says, and do not depend on which columns are drawn at a time. */
static void test_dashes(void **state)
{
    (void)state;
    enum { WIDTH = 480, HEIGHT = 120, POINTS = 61, BLOCK = 37 };
    const struct bead_rect rect = {0, 0, WIDTH, HEIGHT};
    struct bead_message msg = {""};
    struct bead_frame whole, parts;
    float x[POINTS], y[POINTS];
    require(bead_frame_create(WIDTH, HEIGHT, &whole, &msg), &msg);
    require(bead_frame_create(WIDTH, HEIGHT, &parts, &msg), &msg);
    for (size_t pattern = 1; pattern <= BEAD_DASH_DOTTED; pattern++) {
        const struct bead_dashes *dashes = bead_look_dashes(pattern);
        struct bead_curve curve = {x, y, POINTS, .base = HEIGHT, .width = 4, .line = {1, 1, 1}, .dashes = dashes};
        double lit = 0, expected = 0, all = 0;
        for (int i = 0; i < dashes->count; i++) {
            expected += i % 2 ? 0 : dashes->lengths[i];
            all += dashes->lengths[i];
        }
        for (int wavy = 0; wavy < 2; wavy++) {
            memset(whole.pixels, 0, whole.stride * HEIGHT);
            memset(parts.pixels, 0, parts.stride * HEIGHT);
            for (int i = 0; i < POINTS; i++) {
                x[i] = (float)(WIDTH * i) / (POINTS - 1);
                y[i] = (float)(60.5 - wavy * 50 * sin(0.4 * i));
            }
            bead_curve_draw(&curve, rect, 0, WIDTH, &whole, NULL);
            for (int from = 0; from < WIDTH; from += BLOCK)
                bead_curve_draw(&curve, rect, from, from + BLOCK < WIDTH ? from + BLOCK : WIDTH, &parts, NULL);
            assert_memory_equal(whole.pixels, parts.pixels, whole.stride * HEIGHT);
            for (int px = 0; px < WIDTH && !wavy; px++)
                lit += whole.pixels[60 * whole.stride + 4 * (size_t)px] / 255.0 / WIDTH;
        }
        if (fabs(lit - expected / all) > 0.06)
            fail_msg("pattern %zu is on in %.3f of its length, not %.3f", pattern, lit, expected / all);
    }
    bead_frame_free(&whole);
    bead_frame_free(&parts);
}

/* A curve that rises at the left of `split`, and is level from there on; returns the number of dashes in columns from..to. */
static int count_dashes(float rise, int from, int to, struct bead_frame *frame)
{
    enum { POINTS = 49, SPLIT = 20 };
    float x[POINTS], y[POINTS];
    const struct bead_rect rect = {0, 0, frame->width, frame->height};
    const struct bead_curve curve = {
        x, y, POINTS, .base = 400, .width = 4, .line = {1, 1, 1}, .dashes = bead_look_dashes(1), .start = 0};
    int dashes = 0;
    memset(frame->pixels, 0, frame->stride * (size_t)frame->height);
    for (int i = 0; i < POINTS; i++) {
        x[i] = (float)(10 * i);
        y[i] = 390.5F - (i < SPLIT ? rise * (float)i / SPLIT : rise);
    }
    bead_curve_draw(&curve, rect, 0, frame->width, frame, NULL);
    bool was = false;
    for (int px = from; px < to; px++) { /* halfway up the slope, or on the level */
        const int row = (int)(390.5F - (px < 10 * SPLIT ? rise * (float)px / (10 * SPLIT) : rise));
        const bool on = frame->pixels[(size_t)row * frame->stride + 4 * (size_t)px] > 127;
        dashes += on && !was;
        was = on;
    }
    return dashes;
}

/* Dashes stay where they are when the curve changes elsewhere, and are as long where it is steep: 32 px a pattern. */
static void test_dashes_stay(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_frame low, high;
    require(bead_frame_create(480, 400, &low, &msg), &msg);
    require(bead_frame_create(480, 400, &high, &msg), &msg);
    assert_int_equal(count_dashes(0, 256, 480, &low), 7);
    assert_int_equal(count_dashes(320, 256, 480, &high), 7);
    for (int px = 256; px < 480; px++) /* level, 320 px higher */
        assert_int_equal(low.pixels[390 * low.stride + 4 * (size_t)px], high.pixels[70 * high.stride + 4 * (size_t)px]);
    assert_int_equal(count_dashes(320, 32, 156, &high), 8); /* 60 px in each 32 px: 2 patterns */
    bead_frame_free(&low);
    bead_frame_free(&high);
}

enum { PIECES_WIDE = 200, PIECES_HIGH = 90 };
static const struct bead_rect piece_rect = {11, 7, 170, 70};

static void clear_frame(struct bead_frame *frame)
{
    memset(frame->pixels, 50, frame->stride * PIECES_HIGH);
}

static void draw_piece(const struct bead_curve *curve, const struct bead_curve *dots, float r, int from, int to,
                       struct bead_frame *frame, const struct bead_frame *background)
{
    bead_curve_draw(curve, piece_rect, from, to, frame, background);
    bead_curve_dots(dots, r, piece_rect, from, to, frame);
}

/* Of dots at the corners of a plot there is what is within it, and nothing beyond. */
static void test_dots_at_corners(void **)
{
    enum { SIDE = 40, EDGE = 10, INSIDE = SIDE - 2 * EDGE };
    static const float near[] = {0, INSIDE}, far[] = {EDGE, EDGE + INSIDE};
    struct bead_message msg = {""};
    struct bead_frame part, whole;
    require(bead_frame_create(SIDE, SIDE, &part, &msg), &msg);
    require(bead_frame_create(SIDE, SIDE, &whole, &msg), &msg);
    memset(part.pixels, 0, part.stride * SIDE);
    memset(whole.pixels, 0, whole.stride * SIDE);
    const struct bead_curve one = {near, near, 2, .line = {1, 1, 1}}, other = {far, far, 2, .line = {1, 1, 1}};
    bead_curve_dots(&one, 4.3F, (struct bead_rect){EDGE, EDGE, INSIDE, INSIDE}, 0, INSIDE, &part);
    bead_curve_dots(&other, 4.3F, (struct bead_rect){0, 0, SIDE, SIDE}, 0, SIDE, &whole);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            const bool within = x >= EDGE && x < SIDE - EDGE && y >= EDGE && y < SIDE - EDGE;
            const size_t at = (size_t)y * part.stride + 4 * (size_t)x;
            assert_int_equal(part.pixels[at], within ? whole.pixels[at] : 0);
        }
    }
    assert_true(whole.pixels[EDGE * whole.stride + 4 * EDGE] == 255);
    bead_frame_free(&part);
    bead_frame_free(&whole);
}

/* Lines with areas and dots, at uneven places, beyond the plot above and below: the same in pieces of any width, over what was
 * drawn before, and nothing beside the plot. */
static void test_pieces(void **state)
{
    (void)state;
    enum { POINTS = 23 };
    static const int blocks[] = {1, 7, 64};
    struct bead_message msg = {""};
    struct bead_frame background, whole, parts;
    float x[POINTS], y[POINTS];
    uint32_t seed = 3;
    require(bead_frame_create(PIECES_WIDE, PIECES_HIGH, &background, &msg), &msg);
    require(bead_frame_create(PIECES_WIDE, PIECES_HIGH, &whole, &msg), &msg);
    require(bead_frame_create(PIECES_WIDE, PIECES_HIGH, &parts, &msg), &msg);
    clear_frame(&background);
    for (size_t k = 0; k < 12; k++) {
        for (int i = 0; i < POINTS; i++) {
            x[i] = (i > 0 ? x[i - 1] : random_place(&seed, -3, 6)) + random_place(&seed, 0.5, 14);
            y[i] = random_place(&seed, -20, 90);
        }
        const struct bead_curve curve = {x,
                                         y,
                                         POINTS,
                                         .base = 55.3F,
                                         .width = random_place(&seed, 1, 6),
                                         .line = {1, 0.5, 0.2},
                                         .area = {0.2, 0.5, 1},
                                         .area_alpha = 0.3,
                                         .dashes = k % 3 ? bead_look_dashes(k % 3) : NULL,
                                         .start = x[0]};
        const float r = random_place(&seed, 1, 5);
        clear_frame(&whole);
        draw_piece(&curve, &curve, r, 0, piece_rect.width, &whole, NULL);
        for (size_t b = 0; b < 3; b++) {
            memset(parts.pixels, 200, parts.stride * PIECES_HIGH);
            for (int from = 0; from < piece_rect.width; from += blocks[b])
                draw_piece(&curve, &curve, r, from, from + blocks[b] < piece_rect.width ? from + blocks[b] : piece_rect.width,
                           &parts, &background);
            for (int py = 0; py < PIECES_HIGH; py++) {
                for (int px = 0; px < PIECES_WIDE; px++) {
                    const size_t at = (size_t)py * whole.stride + 4 * (size_t)px;
                    const bool inside = px >= piece_rect.x && px < piece_rect.x + piece_rect.width && py >= piece_rect.y &&
                                        py < piece_rect.y + piece_rect.height;
                    if (inside ? memcmp(whole.pixels + at, parts.pixels + at, 3) != 0
                               : whole.pixels[at] != 50 || parts.pixels[at] != 200)
                        fail_msg("curve %zu in pieces of %d: differs at %d, %d", k, blocks[b], px, py);
                }
            }
        }
    }
    bead_frame_free(&background);
    bead_frame_free(&whole);
    bead_frame_free(&parts);
}

/* What a frame is lighter than black, in whole pixels, and the middle of that. */
static double ink_of(const struct bead_frame *frame, size_t channel, double middle[2])
{
    double sum = 0;
    middle[0] = middle[1] = 0;
    for (int py = 0; py < PIECES_HIGH; py++) {
        for (int px = 0; px < PIECES_WIDE; px++) {
            const double part = frame->pixels[(size_t)py * frame->stride + 4 * (size_t)px + channel] / 255.0;
            sum += part;
            middle[0] += part * (px + 0.5 - piece_rect.x), middle[1] += part * (py + 0.5 - piece_rect.y);
        }
    }
    middle[0] /= sum, middle[1] /= sum;
    return sum;
}

/* A dot has the area and the place of its disc; a line that of its band with round ends, its area reaches to the base. */
static void test_inks(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_frame frame;
    double middle[2];
    uint32_t seed = 8;
    require(bead_frame_create(PIECES_WIDE, PIECES_HIGH, &frame, &msg), &msg);
    for (int k = 0; k < 20; k++) {
        const float x[2] = {random_place(&seed, 20, 60), random_place(&seed, 100, 150)}, y = random_place(&seed, 12, 30),
                    r = random_place(&seed, 1.5, 8), base = random_place(&seed, 50, 60), width = random_place(&seed, 1, 6),
                    rise = random_place(&seed, 0, 20);
        const struct bead_curve dot = {x, (const float[]){y, y}, 1, .line = {1, 1, 1}};
        memset(frame.pixels, 0, frame.stride * PIECES_HIGH);
        bead_curve_dots(&dot, r, piece_rect, 0, piece_rect.width, &frame);
        assert_true(fabs(ink_of(&frame, 0, middle) / (M_PI * (r * r + 1.0 / 12)) - 1) < 0.02);
        assert_true(fabs(middle[0] - x[0]) < 0.03 && fabs(middle[1] - y) < 0.03);
        /* blue is the line, red what the area adds */
        const struct bead_curve line = {x,
                                        (const float[]){y, y + rise},
                                        2,
                                        .base = base,
                                        .width = width,
                                        .line = {0, 0, 1},
                                        .area = {1, 0, 0},
                                        .area_alpha = 1};
        const double along = x[1] - x[0], length = hypot(along, rise);
        memset(frame.pixels, 0, frame.stride * PIECES_HIGH);
        bead_curve_draw(&line, piece_rect, 0, piece_rect.width, &frame, NULL);
        assert_true(fabs(ink_of(&frame, 0, middle) / (length * width + 0.25 * M_PI * width * width) - 1) < 0.035);
        assert_true(fabs(middle[0] - 0.5 * (x[0] + x[1])) < 0.1 && fabs(middle[1] - y - 0.5 * rise) < 0.1);
        assert_true(fabs(ink_of(&frame, 2, middle) / (along * (base - y - 0.5 * rise) - 0.5 * length * width) - 1) < 0.01);
    }
    bead_frame_free(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_curves_are_averages_over_slices),
        cmocka_unit_test(test_curves_cover_transparent_frames),
        cmocka_unit_test(test_dashes),
        cmocka_unit_test(test_dots_at_corners),
        cmocka_unit_test(test_dashes_stay),
        cmocka_unit_test(test_pieces),
        cmocka_unit_test(test_inks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
