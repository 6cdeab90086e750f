/* Figures: presets of size and type, the largest value of every pixel, plots of peaks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/look.h"
#include "beadreel/render.h"
#include "render/area.h"
#include "render/page.h"
#include "tests/pictures.h"

/* ---- presets ---- */

struct styled {
    struct bead_page page;
    struct bead_look look;
};

static struct styled styled(const char *output)
{
    struct built built = build_chain(output);
    struct styled found;
    assert_int_equal(bead_page_find(&built.scene->outputs[0], "test", &found.page, NULL), BEAD_OK);
    bead_page_look(&found.page, &built.scene->outputs[0], &found.look);
    release_chain(&built);
    return found;
}

static void test_paper_is_a_column_wide_with_8_point_type(void **state)
{
    (void)state;
    const double point = 600 / 72.0;
    struct styled s = styled("image: a.png, style: paper");
    assert_int_equal(s.page.width, lround(86 / 25.4 * 600));
    assert_true(s.page.dpi == 600 && !s.look.dark && s.look.background.r == 1);
    assert_string_equal(s.look.family, "STIX");
    assert_true(fabs(s.look.label - 8 * point) < 1e-9 && fabs(s.look.tick - 8 * point) < 1e-9 && s.look.line <= 0.6 * point);
    struct styled wide = styled("image: a.pdf, style: paper, size: [178 mm, 60 mm], dpi: 300");
    assert_int_equal(wide.page.width, lround(178 / 25.4 * 300));
    assert_true(wide.page.dpi == 300);
    struct styled pixels = styled("image: a.png, style: paper, size: [1000, 800]");
    assert_true(pixels.page.width == 1000 && pixels.page.dpi == 600 && fabs(pixels.look.label - 8 * point) < 1e-9);
}

static void test_slides_have_large_type(void **state)
{
    (void)state;
    struct styled plain = styled("image: a.png"), slide = styled("image: a.png, style: slide");
    struct styled dark = styled("image: a.png, style: slide, theme: dark");
    assert_true(slide.page.width == 1920 && slide.page.height == 1080 && !slide.look.dark && dark.look.dark);
    assert_true(slide.look.label >= 1.5 * plain.look.label && slide.look.tick >= 1080 / 33.0 && slide.look.line > plain.look.line);
    assert_true(dark.look.label == slide.look.label);
}

static void test_movie_style_is_that_of_movies(void **state)
{
    (void)state;
    struct bead_look look;
    struct styled movie = styled("image: a.pdf, style: movie"), light = styled("image: a.pdf, style: movie, theme: light");
    bead_look_screen(&look, 1920, 1080, true);
    assert_true(movie.page.width == 1920 && movie.look.dark && !light.look.dark);
    assert_true(movie.look.label == look.label && movie.look.background.r == look.background.r);
}

/* ---- what a pixel shows ---- */

enum { LONG = 5000, SAMPLES = 100000, WIDTH = 600, HEIGHT = 400 };

struct drawn {
    double largest, sum; /* of pixels; integral over chain and time */
    int lit;             /* pixels that are not 0 */
};

/* A pulse of one sample and one bead in a long chain, in a picture with far fewer pixels. */
static struct drawn draw_one_sample_pulse(enum bead_sampling sampling, size_t bead, int at)
{
    struct bead_area_setup setup = {{0, LONG - 1}, {0, SAMPLES}, HEIGHT, WIDTH, sampling};
    struct bead_area *area;
    struct drawn drawn = {0};
    double *values = calloc(LONG, sizeof *values), pixels[HEIGHT], low;
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    for (int i = 0; i <= SAMPLES; i++) {
        values[bead] = i == at ? -7.25 : 0;
        bead_area_feed(area, i, values, i >= at - 1 && i <= at + 1 ? LONG : 1);
    }
    for (int c = 0; c < WIDTH; c++) {
        assert_true(bead_area_column(area, c, pixels));
        for (int p = 0; p < HEIGHT; p++) {
            drawn.largest = fmin(drawn.largest, pixels[p]);
            drawn.sum += pixels[p] * LONG / HEIGHT * SAMPLES / WIDTH;
            drawn.lit += pixels[p] != 0;
        }
    }
    bead_area_extremes(area, &low, &(double){0});
    assert_true(low == drawn.largest);
    bead_area_destroy(area);
    free(values);
    return drawn;
}

static void test_a_pulse_of_one_sample_shows(void **state)
{
    (void)state;
    static const int places[][2] = {{3210, 45678}, {0, 1}, {4999, 99999}, {12, 500}, {2499, 50000}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        size_t bead = (size_t)places[i][0];
        struct drawn mean = draw_one_sample_pulse(BEAD_SAMPLING_AREA, bead, places[i][1]);
        struct drawn largest = draw_one_sample_pulse(BEAD_SAMPLING_MAX, bead, places[i][1]);
        assert_true(fabs(mean.sum + 7.25) < 1e-9); /* a triangle 2 wide, one bead wide */
        assert_true(mean.largest < 0 && mean.largest > -0.01);
        assert_true(largest.largest == -7.25);
        assert_in_range(largest.lit, 1, 4); /* at most those that the triangle reaches into */
    }
}

/* Beads that nothing has moved keep a force; one that has opened has none. */
static void test_largest_values_of_chains_under_load(void **state)
{
    (void)state;
    enum { BEADS = 6, PIXELS = 3, COLUMNS = 4 };
    struct bead_area_setup setup = {{0, BEADS - 1}, {0, COLUMNS}, PIXELS, COLUMNS, BEAD_SAMPLING_MAX};
    struct bead_area *area;
    double values[BEADS] = {2, 2, 2, 2, 2, 3}, pixels[PIXELS];
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    bead_area_feed(area, 0, values, 0);
    bead_area_feed(area, 1, values, 0);
    values[0] = 9;
    bead_area_feed(area, 1.5, values, 1);
    values[0] = values[1] = values[2] = 0;
    bead_area_feed(area, 2.5, values, 3);
    bead_area_feed(area, 4, values, 3);
    static const double wanted[COLUMNS][PIXELS] = {{2, 2, 3}, {9, 2, 3}, {4.5, 2, 3}, {0, 2, 3}};
    for (int c = 0; c < COLUMNS; c++) {
        assert_true(bead_area_column(area, c, pixels));
        for (int p = 0; p < PIXELS; p++)
            if (fabs(pixels[p] - wanted[c][p]) > 1e-12)
                fail_msg("pixel %d, %d is %g, not %g", c, p, pixels[p], wanted[c][p]);
    }
    bead_area_destroy(area);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paper_is_a_column_wide_with_8_point_type),
        cmocka_unit_test(test_slides_have_large_type),
        cmocka_unit_test(test_movie_style_is_that_of_movies),
        cmocka_unit_test(test_a_pulse_of_one_sample_shows),
        cmocka_unit_test(test_largest_values_of_chains_under_load),
    };
    return cmocka_run_group_tests_name("figures", tests, make_directory, remove_directory);
}
