/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beads are above their numbers, their values in profiles and their columns in space-time images: tapered chains, beads of
 * different radii, parts of chains, few beads. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/figure/figure.h"
#include "render/stage/along.h"
#include "render/stage/panel.h"
#include "render/view/area.h"
#include "render/view/views.h"
#include "tests/sweeps.h"

static const struct {
    const char *beads, *range;
    bool uneven;
} cases[] = {{"{bead: large-steel, count: 30, taper: {to: 1.2 mm}}", "all", true},
             {"{bead: large-steel, count: 30, taper: {to: 1.2 mm}}", "[10, 25]", true},
             {"{cell: [large-steel, aluminium], count: 16}", "all", false},
             {"{bead: large-steel, count: 20}, {bead: small-steel, count: 20}", "all", true},
             {"{bead: large-steel, count: 4}", "all", false},
             {"{bead: large-steel, count: 60}", "[20, 45]", false},
             {"{bead: large-steel, count: 12, gap: 6 mm}, {bead: large-steel, count: 12}", "all", true},
             {"{bead: large-steel, count: 7, taper: {to: 0.1 mm}}", "all", true}};
enum { CASES = sizeof cases / sizeof cases[0] };

struct made {
    struct bead_scene *scene;
    struct bead_chain *chain;
};

static struct made make(size_t k)
{
    char text[600];
    struct made m;
    snprintf(
        text, sizeof text,
        "chain: {beads: [%s], wall: brass}\noutputs: [{image: a.png, size: [1280, 720], views: [beads, profile, spacetime], at: "
        "0 ms, beads: %s}]\n",
        cases[k].beads, cases[k].range);
    m.scene = parse(text);
    assert_int_equal(bead_chain_create(m.scene, 0, &m.chain, NULL), BEAD_OK);
    return m;
}

/* Chains share numbers, with beads drawn over them, only if both chains' beads are above them. */
static void test_chains_of_like_places(void **state)
{
    (void)state;
    for (size_t k = 0; k < CASES; k++) {
        for (size_t l = 0; l < CASES; l++) {
            const struct made a = make(k), b = make(l);
            const size_t most = bead_chain_beads(a.chain) - 1, others = bead_chain_beads(b.chain) - 1;
            const double *x = bead_chain_position(a.chain), *y = bead_chain_position(b.chain), *r = bead_chain_radius(a.chain),
                         *s = bead_chain_radius(b.chain);
            const double length = x[most] - x[0] + r[most] + r[0], other = y[others] - y[0] + s[others] + s[0];
            bool like = most == others;
            for (size_t i = 0; like && i <= most; i++)
                like =
                    fabs((x[i] - x[0] + r[0]) / length - (y[i] - y[0] + s[0]) / other) <= 0.5 * fmin(r[i] / length, s[i] / other);
            const struct bead_view_setup one = {.chain = a.chain, .beads = {0, most}, .over_beads = true},
                                         two = {.chain = b.chain, .beads = {0, others}, .over_beads = true};
            assert_int_equal(bead_along_alike(&one, &two), like);
            const struct bead_view_setup bare = {.chain = a.chain, .beads = {0, most}};
            assert_int_equal(bead_along_alike(&bare, &two), most == others);
            bead_chain_destroy(a.chain);
            bead_chain_destroy(b.chain);
            bead_scene_free(a.scene);
            bead_scene_free(b.scene);
        }
    }
}

/* Numbers are those of a chain whose beads are all as wide as the narrowest, where they have room; on any width there are two. */
static void assert_numbers_have_room(const struct bead_view_setup *setup, double width, double least, double em)
{
    struct bead_view_setup plain = *setup;
    struct bead_axis axis, even;
    plain.over_beads = false;
    const double beads = (double)(setup->beads.last - setup->beads.first + 1);
    for (; width > 4 * em; width *= 0.8) {
        const bool uneven = bead_along_uneven(setup, width);
        (void)bead_along_axis(&axis, setup, width, em, true);
        (void)bead_along_axis(&even, &plain, uneven ? fmax(4 * em, width * least * beads) : width, em, true);
        assert_true(axis.count >= 2);
        assert_int_equal(axis.count, even.count);
        for (size_t t = 0; t < axis.count; t++)
            assert_true(axis.ticks[t].value == even.ticks[t].value);
    }
}

/* The row of beads takes all of the plot's width, as far as its height allows; a bead is within half a radius of the place of its
 * number, and the tick of its number at that place. */
static void test_beads_over_their_numbers(void **state)
{
    (void)state;
    for (size_t k = 0; k < CASES; k++) {
        struct made m = make(k);
        const struct bead_chain *chains[] = {m.chain};
        const struct bead_run_context context = {
            .scene = m.scene, .chains = chains, .chain_count = 1, .end = 1e-3, .resolution = 1e-6};
        const struct bead_output *output = &m.scene->outputs[0];
        struct bead_page page;
        struct bead_look look;
        struct bead_figure *figure;
        struct bead_insets insets;
        assert_int_equal(bead_page_find(output, &page, NULL), BEAD_OK);
        bead_page_look(&page, &output->paper, &look);
        assert_int_equal(bead_figure_create(output, &context, &page, &look, NULL, &figure, NULL), BEAD_OK);
        assert_int_equal(
            bead_figure_put(figure, (struct bead_rect){0, 0, page.width, page.height}, &(struct bead_insets){0}, &insets, NULL),
            BEAD_OK);
        const struct bead_tile *row = &figure->tiles[0];
        const size_t first = row->setup.beads.first, last = row->setup.beads.last;
        const double *position = bead_chain_position(m.chain), *radius = bead_chain_radius(m.chain);
        const double begin = position[first] - radius[first], length = position[last] + radius[last] - begin;
        const double width = row->plot.width, pitch = width / (double)(last - first + 1);
        const double scale = fmin(width, row->type->most_width(&row->setup, row->plot.height)) / length;
        const double left = 0.5 * (width - length * scale);
        assert_int_equal(bead_along_uneven(&row->setup, width), cases[k].uneven);
        struct bead_axis axis;
        (void)bead_along_axis(&axis, &row->setup, width, look.tick, true);
        assert_true(axis.count >= 2);
        for (size_t i = first; i <= last; i++) {
            const double bead = left + (position[i] - begin) * scale;
            const double place =
                cases[k].uneven ? bead_along_place(&row->setup, (double)i) * width : ((double)(i - first) + 0.5) * pitch;
            if (!(fabs(bead - place) <= 0.5 * radius[i] * scale))
                fail_msg("case %zu: bead %zu of radius %.3g px stands at %.1f, its number at %.1f", k, i, radius[i] * scale, bead,
                         place);
            for (size_t t = 0; t < axis.count; t++)
                assert_true((size_t)lround(axis.ticks[t].value) != i || fabs(axis.ticks[t].place * width - place) < 1e-6 * width);
        }
        double least = INFINITY;
        for (size_t i = first; i <= last; i++)
            least = fmin(least, 2 * radius[i] / length);
        assert_numbers_have_room(&row->setup, width, least, look.tick);
        bead_figure_destroy(figure);
        bead_chain_destroy(m.chain);
        bead_scene_free(m.scene);
    }
}

/* Pixels of space-time images belong to the beads over them: a field that jumps between two beads does so where these touch. */
static void images_are_below_their_beads(void **state)
{
    (void)state;
    enum { WIDE = 600, HIGH = 60, SAMPLES = 121, JUMP = 21 };
    struct made m = make(3); /* twenty large beads and twenty small ones */
    struct bead_look look;
    struct bead_colormap map;
    struct bead_frame frame, background;
    struct bead_message msg = {""};
    bead_look_screen(&look, 1280, 720, false);
    assert_int_equal(bead_colormap_load("ember", &map, &msg), BEAD_OK);
    const size_t beads = bead_chain_beads(m.chain);
    const struct bead_view_setup setup = {.chain = m.chain,
                                          .field = BEAD_FIELD_FORCE,
                                          .beads = {0, beads - 1},
                                          .time = {0, 1e-3},
                                          .colours = {&map, BEAD_SCALE_LINEAR, 0, 40, 0},
                                          .look = &look,
                                          .over_beads = true,
                                          .orientation = BEAD_TIME_DOWN,
                                          .magnify = 1};
    const struct bead_view_type *type = bead_view_find(BEAD_VIEW_SPACETIME);
    struct bead_view *view;
    assert_int_equal(type->create(&setup, &view, &msg), BEAD_OK);
    assert_int_equal(type->place(view, (struct bead_rect){0, 0, WIDE, HIGH}, NULL, &msg), BEAD_OK);
    assert_int_equal(bead_frame_create(WIDE, HIGH, &frame, &msg), BEAD_OK);
    assert_int_equal(bead_frame_create(WIDE, HIGH, &background, &msg), BEAD_OK);
    for (size_t i = 0; i < SAMPLES; i++) {
        double force[64] = {0};
        for (size_t k = JUMP; k < beads; k++)
            force[k] = 40;
        struct bead_sample sample = {.time = 1e-3 * (double)i / (SAMPLES - 1), .index = i, .active = beads};
        sample.field[BEAD_FIELD_FORCE] = force;
        assert_int_equal(type->feed(view, &sample, &msg), BEAD_OK);
    }
    struct bead_changes changes = {0};
    assert_int_equal(type->draw(view, 1e-3, &frame, &background, &changes, &msg), BEAD_OK);
    const uint8_t *row = frame.pixels + (size_t)(HIGH / 2) * frame.stride;
    int first = 0;
    while (first < WIDE && memcmp(row + 4 * first, row, 3) == 0)
        first++;
    const double *position = bead_chain_position(m.chain), *radius = bead_chain_radius(m.chain);
    const double begin = position[0] - radius[0], length = position[beads - 1] + radius[beads - 1] - begin,
                 touch = (position[JUMP] - radius[JUMP] - begin) / length * WIDE;
    if (fabs(first - touch) > 1.5)
        fail_msg("the field jumps at pixel %d, the beads touch at %.1f", first, touch);
    type->destroy(view);
    bead_frame_free(&frame);
    bead_frame_free(&background);
    bead_chain_destroy(m.chain);
    bead_scene_free(m.scene);
}

/* A row as wide as its height allows has beads that fill most of it, with a line of names below them. */
static void rows_leave_room_for_names(void **state)
{
    (void)state;
    struct made m = make(4); /* four equal beads */
    struct bead_look look;
    bead_look_screen(&look, 1280, 720, false);
    const struct bead_view_setup setup = {.chain = m.chain, .field = BEAD_FIELD_FORCE, .beads = {1, 4}, .look = &look};
    for (int height = 80; height < 400; height += 40) {
        const double diameter = bead_view_find(BEAD_VIEW_BEADS)->most_width(&setup, height) / 4;
        assert_true(diameter + look.tick < height && diameter > 0.75 * (height - 2 * look.tick));
    }
    for (int width = 200; width < 1200; width += 100) { /* and no higher than beads of all the width need, with their names */
        const struct bead_view_type *type = bead_view_find(BEAD_VIEW_BEADS);
        const double height = type->most_height(&setup, width);
        assert_true(type->most_width(&setup, height) >= width && height > 0.25 * width + look.tick);
        assert_true(height < 0.5 * width + 2 * look.tick);
    }
    for (int width = 4; width < 400; width++) /* nor flatter than their names and three letters */
        assert_true(bead_view_find(BEAD_VIEW_BEADS)->most_height(&setup, width) >=
                    (width >= 5 * look.label ? 4.3 : 2.2) * look.tick);
    bead_chain_destroy(m.chain);
    bead_scene_free(m.scene);
}

/* A panel has its own colour behind curves, at all of its pixels and at no other, unless the picture is to have no background. */
static void panels_are_filled(void **state)
{
    (void)state;
    struct made m = make(2);
    struct bead_look look;
    bead_look_film(&look, 1280, 720, true, false);
    look.panel = (struct bead_rgb){1, 0, 0};
    const struct bead_view_setup setup = {.chain = m.chain, .field = BEAD_FIELD_FORCE, .beads = {1, 32}, .look = &look};
    const struct bead_rect plot = {20, 10, 60, 40};
    for (int clear = 0; clear < 2; clear++) {
        look.clear = clear;
        cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 60);
        cairo_t *cr = cairo_create(surface);
        bead_panel_fill(cr, &setup, plot);
        cairo_destroy(cr);
        cairo_surface_flush(surface);
        for (int y = 0; y < 60; y++) {
            for (int x = 0; x < 100; x++) {
                const unsigned char *p =
                    cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x;
                const bool within = x >= plot.x && x < plot.x + plot.width && y >= plot.y && y < plot.y + plot.height;
                assert_int_equal(p[2], within && !clear ? 255 : 0);
            }
        }
        cairo_surface_destroy(surface);
    }
    bead_chain_destroy(m.chain);
    bead_scene_free(m.scene);
}

/* A pixel of the image shows the beads that are there, in proportion. */
static void test_pixels_belong_to_unlike_beads(void **state)
{
    (void)state;
    enum { BEADS = 5, PLACES = 31 };
    static const double borders[BEADS + 1] = {1, 4, 6.3, 7.5, 9, 11}, values[2][BEADS] = {{0}, {3, 1, 4, 1, 5}};
    const struct bead_area_setup setup = {{0, BEADS - 1}, {0, 1}, PLACES, 2, BEAD_SAMPLING_AREA};
    struct bead_area *area;
    double means[PLACES];
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    bead_area_divide(area, borders);
    bead_area_feed(area, 0, values[1], BEADS);
    bead_area_feed(area, 1, values[1], BEADS);
    assert_true(bead_area_column(area, 1, means));
    for (int p = 0; p < PLACES; p++) {
        const double from = 1 + p * 10.0 / PLACES, to = 1 + (p + 1) * 10.0 / PLACES;
        double expected = 0;
        for (int j = 0; j < BEADS; j++)
            expected += values[1][j] * fmax(0, fmin(to, borders[j + 1]) - fmax(from, borders[j])) / (to - from);
        if (!(fabs(means[p] - expected) < 1e-12))
            fail_msg("pixel %d is %g, not %g", p, means[p], expected);
    }
    bead_area_destroy(area);
}

/* Of a string between fixed ends: the ends are those of the plot, masses at their coordinates, whether or not they are drawn. */
static void test_strings_reach_their_ends(void **state)
{
    (void)state;
    struct bead_scene *scene = parse("chain: {equation: fput, points: 31, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
                                     "simulate: {until: 10}\noutputs: [{movie: a.mp4}]\n");
    struct bead_chain *chain;
    struct bead_look look;
    struct bead_axis axis;
    bead_look_film(&look, 1280, 720, true, false);
    assert_int_equal(bead_chain_create(scene, 0, &chain, NULL), BEAD_OK);
    const struct bead_view_setup setup = {.chain = chain, .field = BEAD_FIELD_DISPLACEMENT, .beads = {0, 30}, .look = &look};
    assert_true(bead_along_fixed(&setup) && bead_along_uneven(&setup, 1000));
    (void)bead_along_axis(&axis, &setup, 1000, look.tick, true);
    assert_true(axis.low == 0 && axis.high == 32);
    for (size_t t = 0; t < axis.count; t++)
        assert_float_equal(axis.ticks[t].place, axis.ticks[t].value / 32, 1e-9);
    for (int k = 0; k <= 32; k++) /* mass number k - 1 is at x = k */
        assert_float_equal(bead_along_place(&setup, k - 1), k / 32.0, 1e-9);
    assert_float_equal(bead_along_border(&setup, 0), 0, 1e-9);
    assert_float_equal(bead_along_border(&setup, 5), 5.5, 1e-9);
    assert_float_equal(bead_along_border(&setup, 31), 32, 1e-9);
    struct bead_view_setup part = setup;
    part.beads.last = 20;
    assert_false(bead_along_fixed(&part));
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* Of several chains the shorter ones have fewer beads than are shown: their numbers are even, as are those of images without beads,
 * with a comparison. */
static void test_numbers_beyond_the_chain_are_even(void **state)
{
    (void)state;
    const struct made m = make(0);
    const size_t beads = bead_chain_beads(m.chain);
    for (size_t last = beads - 2; last < beads + 3; last++) {
        for (int contacts = 0; contacts < 2; contacts++) {
            struct bead_view_setup setup = {.chain = m.chain,
                                            .field = contacts ? BEAD_FIELD_CONTACT_FORCE : BEAD_FIELD_FORCE,
                                            .beads = {0, last},
                                            .over_beads = true};
            assert_int_equal(bead_along_uneven(&setup, 1000), last < beads);
            setup.trust = true;
            assert_false(bead_along_uneven(&setup, 1000));
            setup.trust = setup.over_beads = false;
            assert_false(bead_along_uneven(&setup, 1000));
        }
    }
    bead_chain_destroy(m.chain);
    bead_scene_free(m.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_beads_over_their_numbers),          cmocka_unit_test(test_chains_of_like_places),
        cmocka_unit_test(test_numbers_beyond_the_chain_are_even), cmocka_unit_test(rows_leave_room_for_names),
        cmocka_unit_test(images_are_below_their_beads),           cmocka_unit_test(panels_are_filled),
        cmocka_unit_test(test_strings_reach_their_ends),          cmocka_unit_test(test_pixels_belong_to_unlike_beads),
    };
    return cmocka_run_group_tests_name("places along chains", tests, NULL, NULL);
}
