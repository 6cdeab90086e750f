/* SPDX-License-Identifier: GPL-3.0-or-later */
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

#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "render/encode/page.h"
#include "render/figure/still.h"
#include "render/view/area.h"
#include "sessions.h"
#include "tests/missing.h"
#include "tests/pictures.h"

extern const struct bead_sink_type bead_plot_sink;

/* ---- presets ---- */

struct styled {
    struct bead_page page;
    struct bead_look look;
};

static struct styled styled(const char *output)
{
    struct built built = build_chain(output);
    struct styled found;
    assert_int_equal(bead_page_find(&built.scene->outputs[0], &found.page, NULL), BEAD_OK);
    bead_page_look(&found.page, &built.scene->outputs[0].paper, &found.look);
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

/* ---- peaks ---- */

enum { CONTACTS = 10 };

/* Draws peaks of the chain of ten beads as the sink would at the end of a run. */
static struct png_file draw_known_peaks(const char *output, const double values[CONTACTS], size_t open, size_t exceeded,
                                        size_t lost, const double *uncertainty)
{
    struct built built = build_chain(output);
    struct bead_run_context context = make_stage(&built);
    struct bead_peak peaks[CONTACTS];
    struct bead_outcome outcome = {.contact_peaks = peaks, .contact_uncertainty = uncertainty};
    struct bead_sink *sink;
    struct bead_needs needs;
    struct bead_message msg = {""};
    char path[512];
    assert_int_equal(bead_chain_contacts(built.chain), CONTACTS);
    for (size_t i = 0; i < CONTACTS; i++)
        peaks[i] = (struct bead_peak){.value = values[i],
                                      .time = values[i] > 0 ? 1e-4 * (double)i : NAN,
                                      .open = i == open,
                                      .exceeded = i == exceeded,
                                      .unpredictable = i == lost};
    assert_int_equal(bead_plot_sink.create(&built.scene->outputs[0], &context, &sink, &msg), BEAD_OK);
    bead_plot_sink.needs(sink, &needs);
    assert_true(needs.contact_peaks && needs.uncertainty && needs.fields == 0);
    if (bead_plot_sink.end(sink, &outcome, &msg))
        fail_msg("%s", msg.text);
    bead_plot_sink.destroy(sink);
    release_chain(&built);
    in_directory("peaks.png", path, sizeof path);
    return read_png(path);
}

static struct png_file draw_peaks(const char *output, const double values[CONTACTS], size_t open, size_t exceeded)
{
    return draw_known_peaks(output, values, open, exceeded, 99, NULL);
}

/* Pixels in the full colour of the first curve, in the picture's columns and rows from..to. */
static int count_ink(const struct png_file *png, int left, int right, int top, int bottom)
{
    struct bead_look look;
    bead_look_screen(&look, png->width, png->height, false);
    struct bead_rgb ink = bead_look_curve(&look, 0);
    int count = 0;
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            const uint8_t *rgb = png->rgb + 3 * ((size_t)y * (size_t)png->width + (size_t)x);
            count += fabs(rgb[0] - 255 * ink.r) < 2 && fabs(rgb[1] - 255 * ink.g) < 2 && fabs(rgb[2] - 255 * ink.b) < 2;
        }
    }
    return count;
}

static void test_peaks_stand_at_their_height(void **state)
{
    (void)state;
    static const double values[CONTACTS] = {10, 10, 10, 10, 10, 10, 10, 10, 10, 0}; /* the last one was never loaded */
    struct png_file png = draw_peaks("plot: peaks.png, show: peaks, size: [640, 400]", values, 99, 99);
    int rows = 0, first = png.height, last = 0;
    for (int y = 0; y < png.height; y++) {
        if (count_ink(&png, 0, png.width, y, y + 1) > 0) {
            rows++;
            first = y < first ? y : first;
            last = y;
        }
    }
    assert_true(rows >= 3 && rows == last - first + 1 && rows < 14); /* one line of markers */
    assert_true(last < png.height / 4);                              /* near the top of the axis from 0 */
    int all = count_ink(&png, 0, png.width, 0, png.height), right = count_ink(&png, 600, png.width, 0, png.height);
    assert_true(all > 9 * 8 && right == 0);
    free(png.rgb);
}

static void test_peaks_below_a_logarithmic_axis_are_marked(void **state)
{
    (void)state;
    static const double values[CONTACTS] = {100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 1e-9};
    static const char output[] = "plot: peaks.png, show: peaks, scale: log, size: [640, 400]";
    struct png_file png = draw_peaks(output, values, 99, 99);
    int below = count_ink(&png, 560, png.width, 320, png.height);
    assert_true(below > 0);
    free(png.rgb);
    png = draw_peaks(output, values, 0, 99); /* hollow: less ink for the first */
    struct png_file closed = draw_peaks(output, values, 99, 99);
    assert_true(count_ink(&png, 0, 120, 0, 200) < count_ink(&closed, 0, 120, 0, 200));
    free(png.rgb);
    free(closed.rgb);
}

/* A logarithmic axis has the same room above the largest and below the least value: their middle is the plot's, for any of them. */
static void test_logarithmic_axes_have_equal_room(void **state)
{
    (void)state;
    static const double values[2][CONTACTS] = {{100, 50, 20, 10, 5, 2, 1, 1, 1, 1}, {100, 90, 80, 70, 60, 60, 60, 60, 60, 60}};
    int sum[2];
    for (int k = 0; k < 2; k++) {
        struct png_file png = draw_peaks("plot: peaks.png, show: peaks, scale: log, size: [640, 400]", values[k], 99, 99);
        int first = png.height, last = 0;
        for (int y = 0; y < png.height; y++) {
            const bool inked = count_ink(&png, 0, png.width, y, y + 1) > 0;
            first = inked && y < first ? y : first;
            last = inked ? y : last;
        }
        sum[k] = first + last;
        assert_true(first > 0 && last > first + 100);
        free(png.rgb);
    }
    assert_true(abs(sum[0] - sum[1]) <= 1);
}

/* A peak of the first passage, after which the force was larger, is hollow, and stays on the line. */
static void test_exceeded_peaks_are_hollow(void **state)
{
    (void)state;
    static const double values[CONTACTS] = {10, 10, 10, 10, 10, 10, 10, 10, 10, 10};
    static const char output[] = "plot: peaks.png, show: peaks, size: [640, 400]";
    struct png_file plain = draw_peaks(output, values, 99, 99), exceeded = draw_peaks(output, values, 99, 0),
                    open = draw_peaks(output, values, 0, 99);
    const int first = plain.width / 8, all = count_ink(&plain, 0, first, 0, plain.height);
    const int hollow = count_ink(&exceeded, 0, first, 0, plain.height);
    assert_true(hollow < all);
    assert_true(hollow >= count_ink(&open, 0, first, 0, plain.height));
    free(plain.rgb);
    free(exceeded.rgb);
    free(open.rgb);
}

/* Rows with a colour that is clearly blue, as bars are, which are too thin for the full colour. */
static int blue_rows(const struct png_file *png, int right)
{
    int rows = 0;
    for (int y = 0; y < png->height; y++) {
        bool blue = false;
        for (int x = 0; x < right; x++) {
            const uint8_t *rgb = png->rgb + 3 * ((size_t)y * (size_t)png->width + (size_t)x);
            blue = blue || rgb[0] + 60 < rgb[2];
        }
        rows += blue;
    }
    return rows;
}

/* Bars are as long as peaks are uncertain; those that marks would hide are left out. What cannot be predicted is hollow, without a
 * bar. */
static void test_uncertain_peaks_have_bars(void **state)
{
    (void)state;
    static const double values[CONTACTS] = {10, 10, 10, 10, 10, 10, 10, 10, 10, 10};
    static const char output[] = "plot: peaks.png, show: peaks, size: [640, 400], range: [0, 12]";
    double u[3][CONTACTS] = {{0.09}, {1}, {2}};
    struct png_file plain = draw_peaks(output, values, 99, 99), lost = draw_known_peaks(output, values, 99, 99, 0, u[2]), barred[3],
                    exceeded = draw_peaks(output, values, 99, 0);
    int height[3];
    const int column = plain.width / 8;
    for (size_t i = 0; i < 3; i++) {
        barred[i] = draw_known_peaks(output, values, 99, 99, 99, u[i]);
        height[i] = blue_rows(&barred[i], column);
    }
    const double pixels = (height[2] - height[1]) / 2.; /* 1 N */
    assert_int_equal(height[0], blue_rows(&plain, column));
    assert_true(pixels > 20 && fabs(height[1] - 2 * pixels) < 4);
    assert_int_equal(count_ink(&lost, 0, column, 0, plain.height), count_ink(&exceeded, 0, column, 0, plain.height));
    free(plain.rgb);
    free(lost.rgb);
    free(exceeded.rgb);
    for (size_t i = 0; i < 3; i++)
        free(barred[i].rgb);
}

static void run_scene(const char *text)
{
    char scene[512], output[512];
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    write_text(scene, text);
    play_counts((struct bead_job){.input = scene, .output = output});
}

/* Several chains: one name that is too long for its place is cut, and takes nothing from the other names. */
static void test_long_names_leave_the_others(void **state)
{
    (void)state;
    static const char *const names[] = {"first", "second", "third", "fourth", "The fifth of them has a name longer than its panel"};
    char scene[4096], path[512], text[512], command[1200], *words;
    if (!has_program("pdftotext"))
        skip_without("pdftotext (poppler-utils)");
    int used = snprintf(scene, sizeof scene, "chains:\n");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        used += snprintf(scene + used, sizeof scene - (size_t)used,
                         "  - {name: %s, beads: [{cell: [large-steel, aluminium], count: 4, spins: \"1101\"}]}\n", names[i]);
    snprintf(scene + used, sizeof scene - (size_t)used, "outputs: [{image: n.pdf, style: paper, size: [150 mm, 60 mm]}]\n");
    run_scene(scene);
    in_directory("n.pdf", path, sizeof path);
    in_directory("n.txt", text, sizeof text);
    snprintf(command, sizeof command, "pdftotext '%s' '%s'", path, text);
    assert_int_equal(system(command), 0);
    size_t length;
    words = read_all(text, &length);
    for (size_t i = 0; i < 4; i++) {
        if (!strstr(words, names[i]))
            fail_msg("%s is not in the picture", names[i]);
    }
    assert_non_null(strstr(words, "The"));
    assert_null(strstr(words, "longer than its panel"));
    free(words);
}

/* Nothing reaches over the border, at any size and in any style. */
static void test_peaks_are_not_cut(void **state)
{
    (void)state;
    static const double values[CONTACTS] = {888, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1};
    static const char *const settings[] = {"size: [300, 200]", "size: [1200, 240], scale: log", "style: paper, dpi: 150",
                                           "style: slide, scale: sqrt", "size: [200, 500], scale: log"};
    for (size_t s = 0; s < sizeof settings / sizeof settings[0]; s++) {
        char output[256];
        snprintf(output, sizeof output, "plot: peaks.png, show: peaks, %s", settings[s]);
        struct png_file png = draw_peaks(output, values, 3, 99);
        assert_border_white(&png, output);
        free(png.rgb);
    }
}

static void assert_refused(const char *output, const char *says)
{
    char text[512];
    struct bead_scene *scene;
    struct bead_message msg = {""};
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: large-steel, count: 9}, {bead: large-steel, sensor: s}], wall: brass}\noutputs: [{%s}]\n",
             output);
    if (bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg) != BEAD_ERROR_SCENE)
        fail_msg("%s is accepted", output);
    if (!strstr(msg.text, says))
        fail_msg("'%s' does not say '%s'", msg.text, says);
}

static void test_settings_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    assert_refused("plot: a.png, show: sensors, scale: log", "show: peaks");
    assert_refused("plot: a.png, show: peaks, trust: true", "show: sensors");
    assert_refused("plot: a.png, show: peaks, time: [0, 1 ms]", "show: sensors");
    assert_refused("plot: a.png, show: peaks, sample: max", "sample");
    assert_refused("movie: a.mp4, style: slide", "style");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_paper_is_a_column_wide_with_8_point_type),
        cmocka_unit_test(test_slides_have_large_type),
        cmocka_unit_test(test_movie_style_is_that_of_movies),
        cmocka_unit_test(test_a_pulse_of_one_sample_shows),
        cmocka_unit_test(test_largest_values_of_chains_under_load),
        cmocka_unit_test(test_peaks_stand_at_their_height),
        cmocka_unit_test(test_peaks_below_a_logarithmic_axis_are_marked),
        cmocka_unit_test(test_exceeded_peaks_are_hollow),
        cmocka_unit_test(test_logarithmic_axes_have_equal_room),
        cmocka_unit_test(test_uncertain_peaks_have_bars),
        cmocka_unit_test(test_peaks_are_not_cut),
        cmocka_unit_test(test_long_names_leave_the_others),
        cmocka_unit_test(test_settings_that_do_not_fit_are_refused),
    };
    return cmocka_run_group_tests_name("figures", tests, make_directory, remove_directory);
}
