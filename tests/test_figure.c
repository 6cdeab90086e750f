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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paper_is_a_column_wide_with_8_point_type),
        cmocka_unit_test(test_slides_have_large_type),
        cmocka_unit_test(test_movie_style_is_that_of_movies),
    };
    return cmocka_run_group_tests_name("figures", tests, make_directory, remove_directory);
}
