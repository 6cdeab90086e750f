/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colour maps: even steps for the eye, values to their colours, few changes of state. */
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
#include "render/colour/colour_table.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"
#include "tests/eyes.h"

static void lab_of(const uint8_t rgb[3], double lab[3])
{
    eyes_lab(EYES_ALL_CONES, (const double[3]){rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0}, lab);
}

/* CIELAB L* of an sRGB colour. */
static double lightness(const uint8_t rgb[3])
{
    double lab[3];
    lab_of(rgb, lab);
    return lab[0];
}

/* Sequential maps go one way in even steps, diverging ones to a middle and back. */
static void test_lightness_rises(void **state)
{
    (void)state;
    for (const struct bead_colormap_info *info = bead_colormap_list(); info->name; info++) {
        struct bead_colormap map;
        assert_int_equal(bead_colormap_load(info->name, &map, NULL), BEAD_OK);
        assert_string_equal(map.name, info->name);
        const double ends = lightness(map.rgb[255]) - lightness(map.rgb[0]), half = lightness(map.rgb[127]) - lightness(map.rgb[0]);
        const bool diverging = fabs(half) > fabs(ends);
        const double first = copysign(1, half), second = diverging ? -first : first; /* which way it goes */
        for (int i = 0; i < 255; i++) {
            double step = lightness(map.rgb[i + 1]) - lightness(map.rgb[i]);
            bool middle = diverging && i >= 120 && i < 136;
            if (!(middle ? fabs(step) < 1.5 : (i < 128 ? first : second) * step > -0.15))
                fail_msg("%s: lightness steps by %g at %d", info->name, step, i);
        }
        if (!diverging) /* evenly: half of the way in the middle */
            assert_true(fabs(ends) > 60 && fabs(half / ends - 0.5) < 0.12);
        else
            assert_true(fmax(fabs(half), fabs(half - ends)) > 70);
    }
}

/* Where nothing is, an automatic map looks like the page: white paper, dark screen. */
static void test_zero_looks_like_the_page(void **state)
{
    (void)state;
    static const struct {
        const char *map;
        int zero;
        bool dark;
    } cases[] = {{"ember", 0, false}, {"dawn", 127, false}, {"vik", 127, false}, {"inferno", 0, true}, {"dusk", 127, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bead_colormap map;
        struct bead_look look;
        double page[3], zero[3];
        assert_int_equal(bead_colormap_load(cases[i].map, &map, NULL), BEAD_OK);
        bead_look_screen(&look, 1280, 720, cases[i].dark);
        eyes_lab(EYES_ALL_CONES, (const double[3]){look.background.r, look.background.g, look.background.b}, page);
        lab_of(map.rgb[cases[i].zero], zero);
        if (!(fabs(page[0] - zero[0]) < 9))
            fail_msg("%s: lightness %g at zero, on a page of %g", cases[i].map, zero[0], page[0]);
    }
}

/* NAME_r is every map from its other end: the project's maps, and the user's own colours. */
static void test_every_map_turns_round(void **state)
{
    (void)state;
    struct bead_colormap map, turned;
    for (const struct bead_colormap_info *info = bead_colormap_list(); info->name; info++) {
        char name[40];
        snprintf(name, sizeof name, "%s_r", info->name);
        assert_int_equal(bead_colormap_load(info->name, &map, NULL), BEAD_OK);
        assert_int_equal(bead_colormap_load(name, &turned, NULL), BEAD_OK);
        assert_string_equal(turned.name, name);
        for (int i = 0; i < 256; i++)
            assert_memory_equal(map.rgb[i], turned.rgb[255 - i], 3);
    }
    assert_int_equal(bead_colormap_load("#000000 #ff8000 #ffffff_r", &turned, NULL), BEAD_OK);
    assert_memory_equal(turned.rgb[0], ((const uint8_t[]){255, 255, 255}), 3);
    assert_int_equal(bead_colormap_load("_r", &turned, NULL), BEAD_ERROR_SCENE);
    assert_int_equal(bead_colormap_load("viridis_r_r", &turned, NULL), BEAD_ERROR_SCENE);
}

/* The distance of two colours of a map in CIELAB. */
static double apart(const struct bead_colormap *map, int i, int j)
{
    double a[3], b[3];
    lab_of(map->rgb[i], a);
    lab_of(map->rgb[j], b);
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/* Equal steps of a value look alike: over 16 of 256 colours, so that rounding to 8 bits does not count. Measured: largest to
 * least 1.9 for batlow, 2.1 for ember, 2.3 for viridis, 3.3 for cividis, which was made uniform in another space than CIELAB. */
static void test_maps_are_uniform(void **state)
{
    (void)state;
    static const char *const names[] = {"viridis", "cividis", "batlow", "ember"};
    enum { STEP = 16 };
    for (size_t m = 0; m < sizeof names / sizeof names[0]; m++) {
        struct bead_colormap map;
        double least = INFINITY, largest = 0;
        assert_int_equal(bead_colormap_load(names[m], &map, NULL), BEAD_OK);
        for (int i = 0; i + STEP < 256; i++) {
            least = fmin(least, apart(&map, i, i + STEP));
            largest = fmax(largest, apart(&map, i, i + STEP));
        }
        if (!(least > 3 && largest < 3.5 * least))
            fail_msg("%s: colours %d apart differ by %g to %g", names[m], STEP, least, largest);
    }
}

/* Values of both signs look equally strong: they are as far from the middle, to 5 % and what rounding to 8 bits makes of it. In
 * greys they are not alike: positive ones are lighter, the more, the larger they are, in the end by a third of all lightness. */
static void test_signs_are_told_apart_in_greys(void **state)
{
    (void)state;
    struct bead_colormap map;
    for (const char *const *name = (const char *const[]){"dawn", "dusk", NULL}; *name; name++) {
        assert_int_equal(bead_colormap_load(*name, &map, NULL), BEAD_OK);
        for (int i = 0; i < 128; i++) {
            const double strong = apart(&map, i, 127), other = apart(&map, 255 - i, 127), size = (127.5 - i) / 127.5,
                         lighter = lightness(map.rgb[255 - i]) - lightness(map.rgb[i]);
            if (!(fabs(strong - other) < 0.05 * strong + 1.5))
                fail_msg("%s: %d is %g from the middle, %d is %g", *name, i, strong, 255 - i, other);
            if (!(lighter > 32 * size - 0.8))
                fail_msg("%s: %d is lighter than %d by only %g", *name, 255 - i, i, lighter);
        }
    }
}

static void test_unknown_map(void **state)
{
    (void)state;
    struct bead_colormap map;
    struct bead_message msg = {""};
    assert_int_equal(bead_colormap_load("jet", &map, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "viridis_r"));
    assert_int_equal(bead_colormap_load("../materials", &map, &msg), BEAD_ERROR_SCENE);
}

static void test_values_to_colours(void **state)
{
    (void)state;
    struct bead_colours c = {NULL, BEAD_SCALE_LINEAR, 0, 256, 0};
    for (int i = 0; i < 256; i++) {
        assert_int_equal(bead_colours_index(&c, i + 0.5), i);
        assert_int_equal(bead_colours_index(&c, i), i);
    }
    assert_int_equal(bead_colours_index(&c, -5), 0);
    assert_int_equal(bead_colours_index(&c, 256), 255);
    assert_int_equal(bead_colours_index(&c, 1e300), 255);
    assert_int_equal(bead_colours_index(&c, NAN), 0);
    c.scale = BEAD_SCALE_SQRT;
    assert_int_equal(bead_colours_index(&c, 64.01), 128);
    c = (struct bead_colours){NULL, BEAD_SCALE_SQRT, -4, 4, 0};
    assert_true(bead_colours_place(&c, 0) == 0.5 && bead_colours_place(&c, 1) == 0.75 && bead_colours_place(&c, -1) == 0.25);
    c = (struct bead_colours){NULL, BEAD_SCALE_LOG, 1e-4, 1, 0};
    assert_true(fabs(bead_colours_place(&c, 1e-2) - 0.5) < 1e-12);
    assert_int_equal(bead_colours_index(&c, 0), 0);
    assert_int_equal(bead_colours_index(&c, -3), 0);
}

/* Frames: changes never get lost. */
static void test_changes_merge(void **state)
{
    (void)state;
    struct bead_changes changes = {0};
    bead_changes_add(&changes, (struct bead_rect){0, 0, 0, 9}); /* nothing */
    bead_changes_add(&changes, (struct bead_rect){0, 0, 9, 0});
    assert_int_equal(changes.count, 0);
    for (int i = 0; i < 100; i++)
        bead_changes_add(&changes, (struct bead_rect){10 * i, 5 * i, 3, 3});
    assert_true(changes.count <= 32);
    for (int i = 0; i < 100; i++) {
        bool covered = false;
        for (size_t r = 0; r < changes.count; r++) {
            struct bead_rect c = changes.rect[r];
            covered = covered || (c.x <= 10 * i && c.y <= 5 * i && c.x + c.width >= 10 * i + 3 && c.y + c.height >= 5 * i + 3);
        }
        assert_true(covered);
    }
}

/* What changes in every frame is kept once, and places far apart do not take in what lies between them. */
static void test_changes_stay_small(void **state)
{
    (void)state;
    struct bead_changes changes = {0};
    for (int i = 0; i < 40; i++) {
        bead_changes_add(&changes, (struct bead_rect){i % 3, 0, 20, 10});
        bead_changes_add(&changes, (struct bead_rect){1900, 1070 - i % 2, 20, 10});
    }
    assert_int_equal(changes.count, 2);
    for (int i = 0; i < 40; i++)
        bead_changes_add(&changes, (struct bead_rect){40 * i, 500, 2, 2});
    size_t pixels = 0;
    for (size_t r = 0; r < changes.count; r++)
        pixels += (size_t)changes.rect[r].width * (size_t)changes.rect[r].height;
    assert_true(pixels < 22 * 10 + 20 * 11 + 41 * 40 * 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lightness_rises),
        cmocka_unit_test(test_zero_looks_like_the_page),
        cmocka_unit_test(test_every_map_turns_round),
        cmocka_unit_test(test_maps_are_uniform),
        cmocka_unit_test(test_signs_are_told_apart_in_greys),
        cmocka_unit_test(test_unknown_map),
        cmocka_unit_test(test_values_to_colours),
        cmocka_unit_test(test_changes_merge),
        cmocka_unit_test(test_changes_stay_small),
    };
    return cmocka_run_group_tests_name("colour maps", tests, NULL, NULL);
}
