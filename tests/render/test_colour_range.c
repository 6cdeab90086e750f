/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Automatic ranges of colours: all values, but not a strike that would hide the wave; and the colour map of dark pictures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "render/colour/colour_range.h"
#include "render/view/area.h"
#include "sim/chain/chain_internal.h"
#include "tests/sweeps.h"

static const struct bead_colours_asked automatic = {.scale = BEAD_SCALE_LINEAR, .range = {NAN, NAN}};

static void test_ranges(void **state)
{
    (void)state;
    static const struct {
        struct bead_shown_values values;
        bool signs;
        struct bead_colour_range range;
    } cases[] = {
        {{0, 40, INFINITY, 0, 0, 0, 0}, false, {0, 40, false, false, 0, 0}}, /* nothing is known of events */
        {{0, 40, 39, 0, 0, 0, 0}, false, {0, 40, false, false, 0, 0}},
        {{0, 40, 20.1, 0, 0, 0, 0}, false, {0, 40, false, false, 0, 0}}, /* more than half: seen */
        {{0, 40, 10, 0, 0, 0, 0}, false, {0, 10.5, true, false, 40, 0}},
        {{0, 40, 10, 41, 0, 0, 0}, false, {0, 10.5, true, false, 41, 0}}, /* pixels do not reach the peak of samples */
        {{0, 40, 39, 41, 0, 0, 0}, false, {0, 40, false, false, 0, 0}},
        {{-3, 40, 10, 0, 0, 0, 0}, true, {-10.5, 10.5, true, false, 40, 0}},
        {{-40, 8, 10, 0, 0, 0, 0}, true, {-10.5, 10.5, false, true, 40, 0}},
        {{0, 0, 0, 0, 0, 0, 0}, false, {0, 1, false, false, 0, 0}},
        {{5, 5, 5, 0, 0, 0, 0}, false, {0, 5, false, false, 0, 0}}, /* the same everywhere */
        /* nearly a round number */
        {{0, 7.97, 7, 0, 0, 0, 0}, false, {0, 8, false, false, 0, 0}},
        {{0, 7.9, 7, 0, 0, 0, 0}, false, {0, 7.9, false, false, 0, 0}},
        {{-0.9996, 0.9995, 0.9, 0, 0, 0, 0}, true, {-1, 1, false, false, 0, 0}},
        {{0, 7.97, 7, 0, 0, 0, 0}, true, {-8, 8, false, false, 0, 0}}, /* zero stays in the middle */
        {{-7, -5, 7, 0, 0, 0, 0}, true, {-7, 7, false, false, 0, 0}},
        {{-49.8, 0, 40, 0, 0, 0, 0}, false, {-50, 0, false, false, 0, 0}},
        /* about a static force of 20, unless contacts open; a bead at the end has 10, and events are left out there, too */
        {{10, 20.5, 20, 0, 20, 0.5, 0.4}, false, {19.5, 20.5, false, true, 0, 20}},
        {{10, 25, 20, 26, 20, 5, 0.4}, false, {20 - 0.42, 20.42, true, true, 26, 20}},
        {{0, 45, 45, 0, 20, 25, 24}, false, {0, 45, false, false, 0, 0}},
        {{20, 20, 20, 0, 20, 0, 0}, false, {0, 20, false, false, 0, 0}}, /* nothing moves */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bead_colour_range found = bead_colour_range_find(&automatic, cases[i].signs, &cases[i].values);
        const struct bead_colour_range *expected = &cases[i].range;
        if (fabs(found.low - expected->low) > 1e-12 || fabs(found.high - expected->high) > 1e-12 || found.over != expected->over ||
            found.under != expected->under || found.hidden != expected->hidden || found.rest != expected->rest)
            fail_msg("case %zu: %g to %g, hidden %g", i, found.low, found.high, found.hidden);
    }
}

static void test_given_ranges_stay(void **state)
{
    (void)state;
    const struct bead_colours_asked given = {.scale = BEAD_SCALE_LINEAR, .range = {0, 30}},
                                    half = {.scale = BEAD_SCALE_LINEAR, .range = {1, NAN}};
    const struct bead_shown_values values = {.largest = 40, .typical = 10};
    struct bead_colour_range range = bead_colour_range_find(&given, false, &values);
    assert_true(range.low == 0 && range.high == 30 && range.over && range.hidden == 0);
    range = bead_colour_range_find(&half, false, &values);
    assert_true(range.low == 1 && range.high == 40 && range.hidden == 0);
}

enum { BEADS = 50, COLUMNS = 400 };

/* A wave of size 3 that crosses the chain, and a strike of size 100 at the first beads, in the first columns. */
static double typical_of(int beads, int columns, int places)
{
    struct bead_area *area;
    const struct bead_area_setup setup = {{0, BEADS - 1}, {0, COLUMNS}, places, COLUMNS, BEAD_SAMPLING_AREA};
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    for (int i = 0; i <= 4 * COLUMNS; i++) {
        double values[BEADS], time = i / 4.0;
        for (int j = 0; j < BEADS; j++) {
            double from = j - time * BEADS / COLUMNS;
            values[j] = (j < beads && time < columns ? 100 : 0) + 3 * exp(-0.1 * from * from);
        }
        bead_area_feed(area, time, values, BEADS);
    }
    double largest, typical = bead_area_typical(area, 0, &largest);
    bead_area_destroy(area);
    return typical;
}

static void test_short_and_narrow_is_no_wave(void **state)
{
    (void)state;
    assert_true(fabs(typical_of(0, 0, 100) - 3) < 0.1);
    assert_true(fabs(typical_of(3, 10, 100) - 3) < 0.1);
    assert_true(fabs(typical_of(3, 10, 20) - 3) < 0.3); /* fewer pixels than beads */
    assert_true(typical_of(3, 100, 100) > 90);          /* not short */
    assert_true(typical_of(BEADS, 10, 100) > 90);       /* not narrow */
}

static void test_dark_pictures_have_a_dark_map(void **state)
{
    (void)state;
    static const struct {
        const char *output, *map;
    } cases[] = {{"image: a.png", "ember"},
                 {"image: a.png, colormap: grey_r", "grey_r"},
                 {"image: a.png, field: velocity", "dawn"},
                 {"image: a.png, field: velocity, range: [-2, 0]", "dawn"},
                 {"image: a.png, field: velocity, range: [0, 2]", "ember"}, /* zero is white here too */
                 {"image: a.png, theme: dark", "inferno"},
                 {"image: a.png, theme: dark, colormap: batlow", "batlow"},
                 {"image: a.png, theme: dark, field: velocity", "dusk"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[300];
        struct bead_chain *chain;
        struct bead_colormap map;
        snprintf(text, sizeof text, "chain: {beads: [{bead: large-steel, count: 5}]}\noutputs: [{%s}]\n", cases[i].output);
        struct bead_scene *scene = parse(text);
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        const bool dark = scene->outputs[0].paper.theme == BEAD_THEME_DARK;
        assert_int_equal(bead_colour_range_map(&scene->outputs[0], chain, dark, false, &map, NULL), BEAD_OK);
        assert_string_equal(map.name, cases[i].map);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* One force for all contacts of all chains, and only where forces are shown. */
static void test_rest_is_the_static_force(void **state)
{
    (void)state;
    static const struct {
        const char *first, *second;
        enum bead_field field;
        double rest;
    } cases[] = {{"precompression: 20 N", "precompression: 20 N", BEAD_FIELD_FORCE, 20},
                 {"precompression: 20 N", "precompression: 20 N", BEAD_FIELD_CONTACT_FORCE, 20},
                 {"precompression: 20 N", "precompression: 20 N", BEAD_FIELD_VELOCITY, 0},
                 {"precompression: 20 N", "precompression: 21 N", BEAD_FIELD_FORCE, 0},
                 {"precompression: 20 N, tilt: 90 deg, wall: rigid", "precompression: 20 N", BEAD_FIELD_FORCE, 0},
                 {"wall: rigid", "wall: brass", BEAD_FIELD_FORCE, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[400];
        struct bead_chain *chains[2];
        snprintf(text, sizeof text,
                 "chains: [{name: a, %s, beads: [{bead: glass, count: 3}]}, {name: b, %s, beads: [{bead: glass, count: 4}]}]\n"
                 "outputs: [{image: a.png}]\n",
                 cases[i].first, cases[i].second);
        struct bead_scene *scene = parse(text);
        for (size_t c = 0; c < 2; c++)
            assert_int_equal(bead_chain_create(scene, c, &chains[c], NULL), BEAD_OK);
        assert_true(bead_colour_range_rest((const struct bead_chain *const *)chains, 2, cases[i].field) == cases[i].rest);
        bead_chain_destroy(chains[0]);
        bead_chain_destroy(chains[1]);
        bead_scene_free(scene);
    }
}

static void test_deviations_have_no_signs(void **state)
{
    (void)state;
    static const char *const shows[] = {"mean", "deviation"}, *const maps[] = {"dawn", "ember"};
    for (int i = 0; i < 2; i++) {
        char text[400];
        struct bead_chain *chain = NULL;
        struct bead_colormap map;
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: glass, count: 3, disorder: {mass: normal 5 %%}}]}\n"
                 "sweep: {over: {chain.beads.0.disorder.seed: 1..3}}\noutputs: [{image: a.png, field: velocity, show: %s}]\n",
                 shows[i]);
        struct bead_scene *scene = parse(text);
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        assert_int_equal(bead_colour_range_map(&scene->outputs[0], chain, false, false, &map, NULL), BEAD_OK);
        assert_string_equal(map.name, maps[i]);
        assert_int_equal(bead_colour_range_signed(&scene->outputs[0], chain), i == 0);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

/* Whatever can be below 0 has a map with zero in its middle: forces of springs that pull, and solitons that are troughs. */
static void test_what_can_be_negative_has_signs(void **state)
{
    (void)state;
    static const struct {
        const char *chain;
        enum bead_field field;
        bool signs;
    } cases[] = {
        {"beads: [{bead: glass}]", BEAD_FIELD_FORCE, false},
        {"beads: [{bead: glass}]", BEAD_FIELD_VELOCITY, true},
        {"law: {fpu-alpha: 1, stiffness: 1 N/m}, beads: [{bead: glass}]", BEAD_FIELD_FORCE, true},
        {"law: {fpu-alpha: 1, stiffness: 1 N/m}, beads: [{bead: glass}]", BEAD_FIELD_CONTACT_FORCE, true},
        {"law: {fpu-alpha: 1, stiffness: 1 N/m}, beads: [{bead: glass}]", BEAD_FIELD_COMPRESSION, true},
        {"law: {fpu-alpha: 1, stiffness: 1 N/m}, beads: [{bead: glass}]", BEAD_FIELD_ENERGY, false},
        {"equation: kdv, length: 40, start: {solitons: [{speed: 3, at: 8}]}", BEAD_FIELD_DISPLACEMENT, false},
        {"equation: kdv, length: 40, nonlinearity: -2, start: {solitons: [{speed: 3, at: 8}]}", BEAD_FIELD_DISPLACEMENT, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        struct bead_chain *chain = NULL;
        snprintf(text, sizeof text, "chain: {%s}\nsimulate: {until: 1}\noutputs: [{image: a.png}]\n", cases[i].chain);
        struct bead_scene *scene = parse(text);
        assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
        if (bead_chain_signed(chain, cases[i].field) != cases[i].signs)
            fail_msg("case %zu", i);
        bead_chain_destroy(chain);
        bead_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranges),
        cmocka_unit_test(test_given_ranges_stay),
        cmocka_unit_test(test_rest_is_the_static_force),
        cmocka_unit_test(test_deviations_have_no_signs),
        cmocka_unit_test(test_what_can_be_negative_has_signs),
        cmocka_unit_test(test_short_and_narrow_is_no_wave),
        cmocka_unit_test(test_dark_pictures_have_a_dark_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
