/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looks: round ticks that fit, suitable units, numbers as people write them, even colour maps. */
#include <ctype.h>
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

#include "beadreel/view.h"
#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "render/encode/page.h"
#include "tests/eyes.h"

/* ---- axes ---- */

static double draw(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) / 9007199254740992.0;
}

/* The number that a label shows. */
static double shown_number(const char *label)
{
    char plain[64];
    size_t used = 0;
    double power = 0;
    if (strncmp(label, "10<sup>", 7) == 0) {
        label += 7;
        power = 10;
    }
    for (; *label && *label != '<'; label++) {
        if (strncmp(label, "\u2212", 3) == 0) {
            plain[used++] = '-';
            label += 2;
        } else if (isdigit((unsigned char)*label) || *label == '.') {
            plain[used++] = *label;
        } else if (strncmp(label, "\u2009", 3) == 0) {
            label += 2;
        } else {
            fail_msg("a label is '%s'", label);
        }
    }
    plain[used] = '\0';
    return power > 0 ? pow(power, strtod(plain, NULL)) : strtod(plain, NULL);
}

static bool is_round(double step)
{
    double mantissa = step / pow(10, floor(log10(step) + 1e-9));
    return fabs(mantissa - 1) < 1e-6 || fabs(mantissa - 2) < 1e-6 || fabs(mantissa - 5) < 1e-6;
}

static double extent(const struct bead_look *look, const char *label, bool horizontal)
{
    double width, height;
    struct bead_text_style style = {.family = look->family, .size = look->tick};
    bead_text_size(NULL, &style, label, &width, &height);
    return horizontal ? width : 0.75 * look->tick;
}

static void check_axis(const struct bead_look *look, const struct bead_axis *axis, double length, bool horizontal)
{
    double end = -1e9;
    for (size_t i = 0; i < axis->count; i++) {
        const struct bead_tick *tick = &axis->ticks[i];
        double shown = tick->value * axis->factor, half = 0.5 * extent(look, tick->label, horizontal);
        assert_true(tick->place >= 0 && tick->place <= 1);
        assert_true(fabs(bead_axis_place(axis, tick->value) - tick->place) < 1e-6);
        if (!(fabs(shown_number(tick->label) - shown) <= 1e-6 * fmax(fabs(shown), 1e-9)))
            fail_msg("'%s' stands at %.15g", tick->label, shown);
        if (!(tick->place * length - half > end))
            fail_msg("'%s' runs into '%s' on %g px from %g to %g", tick->label, axis->ticks[i - 1].label, length, axis->low,
                     axis->high);
        end = tick->place * length + half;
    }
}

static void test_linear_ticks(void **state)
{
    (void)state;
    uint64_t random = 1;
    size_t bare = 0;
    for (int i = 0; i < 4000; i++) {
        struct bead_look look;
        struct bead_axis axis;
        bool horizontal = i % 2;
        double size = pow(10, draw(&random, -11, 5)), low = i % 3 ? 0 : draw(&random, -1, 1) * size,
               length = draw(&random, 30, 2000);
        if (i % 5 == 0)
            bead_look_paper(&look, 600);
        else
            bead_look_screen(&look, 640, 360, false);
        bead_axis_make(&axis, low, low + draw(&random, 0.1, 1) * size, "N", BEAD_SCALE_LINEAR, length, look.tick, horizontal);
        check_axis(&look, &axis, length, horizontal);
        for (size_t t = 2; t < axis.count; t++) {
            double step = axis.ticks[t].value - axis.ticks[t - 1].value;
            assert_true(fabs(step - (axis.ticks[1].value - axis.ticks[0].value)) < 1e-6 * step);
        }
        double step = axis.count >= 2 ? (axis.ticks[1].value - axis.ticks[0].value) * axis.factor : 1;
        bool only_two = axis.count == 2 && (is_round(step / 3) || is_round(step / 4)); /* with no room for a round step */
        if (!is_round(step) && !only_two)
            fail_msg("step %g", step);
        double largest = fmax(fabs(axis.low), fabs(axis.high)) * axis.factor;
        assert_true(largest >= 0.999999 && largest < 1000.001);
        if (length > 12 * look.tick)
            assert_in_range(axis.count, 2, 10);
        bare += axis.count < 2;
    }
    assert_true(bare < 400); /* only where there is hardly any room */
}

static void test_uneven_ticks(void **state)
{
    (void)state;
    uint64_t random = 2;
    struct bead_look look;
    struct bead_axis axis;
    bead_look_screen(&look, 1280, 720, true);
    for (int i = 0; i < 1000; i++) {
        bool horizontal = i % 2;
        double high = pow(10, draw(&random, -9, 4)), length = draw(&random, 150, 1000);
        bead_axis_make(&axis, 0, high, "J", BEAD_SCALE_SQRT, length, look.tick, horizontal);
        check_axis(&look, &axis, length, horizontal);
        assert_true(axis.count >= 2 && axis.ticks[0].value == 0);
        for (int both = 0; both < 2; both++) {
            bead_axis_make(&axis, both ? -high : 0, high, "m/s", BEAD_SCALE_SQRT, length, look.tick, horizontal);
            check_axis(&look, &axis, length, horizontal);
            for (size_t t = 0; both && t < axis.count; t++)
                assert_true(axis.ticks[t].value == -axis.ticks[axis.count - 1 - t].value);
            for (size_t t = 0; t < axis.count; t++) { /* 2, 5, 10, 20, 30: never 14.5 */
                const double shown = fabs(axis.ticks[t].value * axis.factor), digit = shown > 0 ? log10(shown) : 0;
                assert_true(shown == 0 || fabs(remainder(pow(10, digit - floor(digit + 1e-9)), 1)) < 1e-6);
            }
        }
        bead_axis_make(&axis, high * pow(10, -draw(&random, 0.2, 12)), high, "N", BEAD_SCALE_LOG, length, look.tick, horizontal);
        check_axis(&look, &axis, length, horizontal);
        assert_true(axis.count >= 1);
    }
}

/* Between powers of ten: 2 to 9 times the lower one, or the powers that have no label. */
static void test_logarithmic_axes_have_minor_ticks(void **state)
{
    (void)state;
    struct bead_axis axis;
    bead_axis_make(&axis, 0.5, 200, "N", BEAD_SCALE_LOG, 600, 15, false);
    assert_int_equal(axis.count, 3); /* 1, 10, 100 */
    assert_int_equal(axis.minor_count, 5 + 8 + 8 + 1);
    for (size_t i = 0; i < axis.minor_count; i++) {
        double value = axis.low * pow(axis.high / axis.low, axis.minor[i]), mantissa = value / pow(10, floor(log10(value) + 1e-9));
        assert_true(fabs(mantissa - round(mantissa)) < 1e-9 && mantissa > 1.5 && mantissa < 9.5);
        assert_true(axis.minor[i] >= 0 && axis.minor[i] <= 1 && (i == 0 || axis.minor[i] > axis.minor[i - 1]));
    }
    bead_axis_make(&axis, 8, 115, "N", BEAD_SCALE_LOG, 900, 30, false);
    for (size_t i = 0; i < axis.count; i++)
        assert_true(strspn(axis.ticks[i].label + 1, "0") == strlen(axis.ticks[i].label + 1)); /* 20, 50, never 71 */
    assert_true(axis.count >= 4 && axis.minor_count == 10);
    bead_axis_make(&axis, 1e-30, 1, "N", BEAD_SCALE_LOG, 200, 15, false);
    assert_true(axis.count >= 2 && axis.minor_count > axis.count);
    bead_axis_make(&axis, 1e-100, 1e100, "", BEAD_SCALE_LOG, 1e4, 1, false);
    assert_true(axis.minor_count <= sizeof axis.minor / sizeof axis.minor[0]);
    bead_axis_make(&axis, 0, 200, "N", BEAD_SCALE_LINEAR, 600, 15, false);
    assert_int_equal(axis.minor_count, 0);
}

/* Shorter ticks between labels, where the scale is uneven or labels are few: in order, apart, never on a label. */
static void test_minor_ticks_between_labels(void **state)
{
    (void)state;
    uint64_t random = 7;
    size_t all = 0;
    for (int i = 0; i < 2000; i++) {
        struct bead_axis axis;
        double length = draw(&random, 60, 900), em = draw(&random, 8, 30), high = pow(10, draw(&random, -6, 6));
        enum bead_scale scale = i % 2 ? BEAD_SCALE_SQRT : BEAD_SCALE_LINEAR;
        bead_axis_make(&axis, i % 4 < 2 ? 0 : -high, high, "N", scale, length, em, i % 3 == 0);
        all += axis.minor_count;
        for (size_t k = 0; k < axis.minor_count; k++) {
            double before = k > 0 ? axis.minor[k - 1] : -1;
            for (size_t t = 0; t < axis.count; t++) {
                before = axis.ticks[t].place < axis.minor[k] ? fmax(before, axis.ticks[t].place) : before;
                assert_true(fabs(axis.ticks[t].place - axis.minor[k]) * length > 0.3 * em);
            }
            assert_true((axis.minor[k] - before) * length > 0.3 * em && axis.minor[k] > 0 && axis.minor[k] < 1);
        }
    }
    assert_true(all > 4000);
}

static void test_axes_of_beads_count(void **state)
{
    (void)state;
    struct bead_axis axis;
    for (double beads = 1; beads < 2e6; beads *= 1.7) {
        bead_axis_make(&axis, -0.5, floor(beads) - 0.5, "1", BEAD_SCALE_LINEAR, 400, 15, false);
        assert_string_equal(axis.unit, "");
        for (size_t i = 0; i < axis.count; i++)
            assert_true(axis.ticks[i].value == floor(axis.ticks[i].value) && !strchr(axis.ticks[i].label, '.'));
    }
}

static void test_axes_that_make_no_sense_have_no_ticks(void **state)
{
    (void)state;
    struct bead_axis axis;
    const double bad[][2] = {{0, 0}, {1, 0}, {NAN, 1}, {0, INFINITY}, {1, 1 + 1e-15}};
    for (size_t i = 0; i < 5; i++) {
        bead_axis_make(&axis, bad[i][0], bad[i][1], "N", BEAD_SCALE_LINEAR, 400, 15, false);
        assert_int_equal(axis.count, 0);
    }
    bead_axis_make(&axis, -1, 1, "N", BEAD_SCALE_LOG, 400, 15, false);
    assert_int_equal(axis.count, 0);
}

/* ---- numbers ---- */

static void assert_quantity(double value, const char *unit, int digits, const char *wanted)
{
    char text[64];
    bead_quantity(value, unit, digits, text, sizeof text);
    assert_string_equal(text, wanted);
}

static void test_quantities(void **state)
{
    (void)state;
    assert_quantity(1.64e-3, "s", 4, "1.640\u00a0ms");
    assert_quantity(35, "N", 2, "35\u00a0N");
    assert_quantity(35, "N", 4, "35.00\u00a0N");
    assert_quantity(0, "N", 4, "0\u00a0N");
    assert_quantity(-0.5e-6, "m", 2, "\u2212500\u00a0nm");
    assert_quantity(999.96, "N", 4, "1.000\u00a0kN");
    assert_quantity(999.94, "N", 4, "999.9\u00a0N");
    assert_quantity(2.5e-6, "s", 2, "2.5\u00a0\u00b5s");
    assert_quantity(7200, "s", 2, "7200\u00a0s");
    assert_quantity(0.443, "m/s", 3, "443\u00a0mm/s");
    assert_quantity(32.7e-12, "g", 3, "32.7\u00a0pg");
    assert_quantity(3.27e10, "g", 3, "32\u2009700\u2009000\u00a0kg");
    assert_quantity(3600, "", 2, "3600");
    assert_quantity(1234567, "", 2, "1\u2009234\u2009567");
    assert_quantity(0.25, "", 2, "0.25");
    assert_quantity(NAN, "N", 3, "\u2013\u00a0N");
    assert_quantity(-INFINITY, "N", 3, "\u2212\u221e\u00a0N");
}

static void test_escapes(void **state)
{
    (void)state;
    char out[64], small[8];
    bead_text_escape("a < b & \"c\" > d", out, sizeof out);
    assert_string_equal(out, "a &lt; b &amp; \"c\" &gt; d");
    bead_text_escape("\u00e4\u00e4\u00e4\u00e4\u00e4", small, sizeof small);
    assert_string_equal(small, "\u00e4\u00e4\u00e4"); /* no half characters */
    bead_text_escape("a&b&c", small, sizeof small);
    assert_string_equal(small, "a&amp;b");
    bead_text_escape("x\xff\x80y\tz", out, sizeof out);
    assert_string_equal(out, "x??y z");
    bead_text_magnetism(0.2, out, sizeof out);
    assert_string_equal(strstr(out, "</i>"), "</i></span> = 0.2");
    bead_text_magnetism(14.0 / 15, out, sizeof out); /* the digits of legends */
    assert_non_null(strstr(out, " = 0.933"));
    bead_text_magnetism(1, out, sizeof out);
    assert_string_equal(strstr(out, "</i>"), "</i></span> = 1");
    bead_text_magnetism(0, out, sizeof out);
    assert_string_equal(strstr(out, "</i>"), "</i></span> = 0");
}

static void test_text_is_measured_alike_everywhere(void **state)
{
    (void)state;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 10, 10);
    cairo_t *cr = cairo_create(surface);
    struct bead_text_style style = {.family = "Lato", .size = 17.3};
    double w[4], h[4];
    bead_text_size(NULL, &style, "time (ms)", &w[0], &h[0]);
    bead_text_size(cr, &style, "time (ms)", &w[1], &h[1]);
    cairo_scale(cr, 0.12, 0.12);
    bead_text_size(cr, &style, "time (ms)", &w[2], &h[2]);
    style.size *= 10;
    bead_text_size(NULL, &style, "time (ms)", &w[3], &h[3]);
    assert_true(w[0] > 50 && w[0] == w[1] && h[0] == h[1]);
    assert_true(fabs(w[2] - w[0]) < 0.02 * w[0]);
    assert_true(fabs(w[3] - 10 * w[0]) < 0.2 * w[0]);
    /* A symbol is as large before its index as before a letter. */
    static const char *const parts[] = {"*δ*_1", "*δ*x", "x_1", "xx"};
    char markup[300];
    for (int i = 0; i < 4; i++)
        bead_text_size(NULL, &style, (bead_markup(parts[i], markup, sizeof markup), markup), &w[i], &h[i]);
    assert_true(fabs(w[0] - (w[1] + w[2] - w[3])) < 0.01 * w[0]);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

/* Lines are as high as the style says, whatever the installed version of the font does; symbols and indices need more. */
static void test_lines_have_their_height(void **state)
{
    (void)state;
    const struct bead_text_style style = {.family = "Lato", .size = 100};
    static const char *const texts[] = {"time", "one\ntwo\n\nfour", "one <b>two</b>"};
    static const double heights[] = {100, 400, 100};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        double width, height;
        bead_text_size_lines(NULL, &style, 1000, texts[i], &width, &height);
        assert_true(fabs(height - heights[i]) < 0.5);
    }
    double width, height;
    bead_text_size(NULL, &style, "<span face=\"STIX\"><i>M</i></span>", &width, &height);
    assert_true(height > 120);
}

/* Labels of films have 3 % of the shorter side, large ones 4 %, on upright telephones 5 and 6 %; ticks are as large; captions and
 * titles larger. */
static void film_type_is_a_part_of_the_frame(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1920, 1080}, {1440, 1080}, {1080, 1080}, {1080, 1920}, {3840, 2160}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        double side = fmin(sizes[i][0], sizes[i][1]);
        for (int large = 0; large < 2; large++) {
            struct bead_look look;
            bead_look_film(&look, sizes[i][0], sizes[i][1], true, large);
            const double upright = sizes[i][1] > sizes[i][0] ? 0.02 : 0;
            assert_float_equal(look.label, ((large ? 0.04 : 0.03) + upright) * side, 1e-9);
            assert_float_equal(look.tick, look.label, 1e-9);
            assert_true(look.title > 1.1 * look.label);
        }
    }
}

/* An axis that ends on a round number has a tick there. */
static void test_round_ends_have_ticks(void **state)
{
    (void)state;
    static const struct {
        double low, high, length;
        const char *last;
    } axes[] = {
        {0.6e-3, 1.5e-3, 800, "1.5"}, {0, 1.6, 1100, "1.6"}, {0, 800e-6, 160, "800"}, {0, 900e-6, 460, "900"}, {0, 70, 600, "70"}};
    for (size_t i = 0; i < sizeof axes / sizeof *axes; i++) {
        struct bead_axis axis;
        bead_axis_make(&axis, axes[i].low, axes[i].high, "s", BEAD_SCALE_LINEAR, axes[i].length, 20, true);
        assert_true(axis.count >= 3 && axis.count <= 12);
        assert_string_equal(axis.ticks[axis.count - 1].label, axes[i].last);
        assert_true(axis.ticks[axis.count - 1].place > 1 - 1e-9);
        for (size_t k = 2; k < axis.count; k++) { /* in equal steps */
            double step = axis.ticks[1].place - axis.ticks[0].place;
            assert_true(fabs(axis.ticks[k].place - axis.ticks[k - 1].place - step) < 1e-9);
        }
    }
}

/* ---- colours ---- */

/* All looks, on light and dark pages. */
enum { LOOKS = 8 };
static const char *make_look(int index, struct bead_look *look)
{
    const bool dark = index % 2;
    if (index / 2 == 0) {
        bead_look_paper(look, 300);
        if (dark)
            bead_look_darken(look);
        return dark ? "dark paper" : "paper";
    }
    if (index / 2 == 1)
        bead_look_screen(look, 1280, 720, dark);
    else if (index / 2 == 2)
        bead_look_slide(look, 1280, 720, dark);
    else
        bead_look_film(look, 1280, 720, dark, false);
    return dark ? "dark screen" : "screen";
}

static void take(struct bead_rgb colour, double srgb[3])
{
    srgb[0] = colour.r;
    srgb[1] = colour.g;
    srgb[2] = colour.b;
}

/* WCAG 2.2, 1.4.3 and 1.4.11: 4.5 for letters and for curves, whose names have their colours, 3 for lines; on page and panels. */
static void test_contrast(void **state)
{
    (void)state;
    for (int l = 0; l < LOOKS; l++) {
        struct bead_look look;
        const char *name = make_look(l, &look);
        const struct bead_rgb grounds[] = {look.background, look.panel};
        for (size_t g = 0; g < 2; g++) {
            const struct bead_rgb letters[] = {look.ink, look.faint, look.accent};
            double ground[3], colour[3];
            take(grounds[g], ground);
            for (size_t i = 0; i < 3 + 1 + 6; i++) {
                const double least = i == 3 ? 3 : 4.5;
                take(i < 3 ? letters[i] : i == 3 ? look.axis : bead_look_curve(&look, i - 4), colour);
                if (!(eyes_contrast(colour, ground) >= least))
                    fail_msg("%s: colour %zu has a contrast of %.2f on ground %zu", name, i, eyes_contrast(colour, ground), g);
            }
        }
    }
}

/* Pairs 1, 4, 9, 17 and 20 of the test data of Sharma, Wu and Dalal 2005. */
static void test_differences_as_published(void **state)
{
    (void)state;
    static const double pairs[][7] = {{50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425},
                                      {50, -1.3802, -84.2814, 50, 0, -82.7485, 1},
                                      {50, 2.49, -0.001, 50, -2.49, 0.0009, 7.1792},
                                      {50, 2.5, 0, 73, 25, -18, 27.1492},
                                      {50, 2.5, 0, 58, 24, 15, 19.4535}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        const double found = eyes_difference(pairs[i], pairs[i] + 3);
        if (!(fabs(found - pairs[i][6]) < 1e-4))
            fail_msg("pair %zu: %.4f, not %.4f", i, found, pairs[i][6]);
    }
}

/* Any two curves of a picture, with all cones and without one kind. */
static void test_curves_are_told_apart_by_all_eyes(void **state)
{
    (void)state;
    for (int l = 0; l < 2; l++) {
        struct bead_look look;
        (void)make_look(2 + l, &look);
        for (int eyes = 0; eyes < EYES_KINDS; eyes++) {
            for (size_t i = 0; i < 6 * 6; i++) {
                double one[3], two[3], lab[2][3];
                take(bead_look_curve(&look, i / 6), one);
                take(bead_look_curve(&look, i % 6), two);
                eyes_lab((enum eyes)eyes, one, lab[0]);
                eyes_lab((enum eyes)eyes, two, lab[1]);
                if (i / 6 != i % 6 && !(eyes_difference(lab[0], lab[1]) >= 12))
                    fail_msg("%s, eyes %d: curves %zu and %zu differ by %.1f", l ? "dark" : "light", eyes, i / 6, i % 6,
                             eyes_difference(lab[0], lab[1]));
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_ends_have_ticks),
        cmocka_unit_test(test_linear_ticks),
        cmocka_unit_test(test_uneven_ticks),
        cmocka_unit_test(test_logarithmic_axes_have_minor_ticks),
        cmocka_unit_test(test_minor_ticks_between_labels),
        cmocka_unit_test(test_axes_of_beads_count),
        cmocka_unit_test(test_axes_that_make_no_sense_have_no_ticks),
        cmocka_unit_test(test_quantities),
        cmocka_unit_test(test_escapes),
        cmocka_unit_test(test_text_is_measured_alike_everywhere),
        cmocka_unit_test(test_lines_have_their_height),
        cmocka_unit_test(film_type_is_a_part_of_the_frame),
        cmocka_unit_test(test_contrast),
        cmocka_unit_test(test_differences_as_published),
        cmocka_unit_test(test_curves_are_told_apart_by_all_eyes),
    };
    return cmocka_run_group_tests_name("looks", tests, NULL, NULL);
}
