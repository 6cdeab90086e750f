/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The front predicted by theory, over space-time images of films: it is where the closed form puts it, no further than the film,
 * and the same drawn in parts or at once; its force is the pulse's, also between samples. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/draw/picture.h"
#include "render/view/views.h"
#include "tests/scenes.h"

enum { WIDTH = 300, HEIGHT = 200, BALLS = 61, EVERY = 3, SAMPLES = 180 };
static const struct bead_rect plot = {40, 20, 241, 161};
/* Masses of 1 kg between springs of A = 1/3 GPa m^(1/2): so fast is a wave of 1 kN. */
static const double end = 40e-3, force = 1000;

static double speed(double height)
{
    return sqrt(0.8) * cbrt(1e9 / 3) * pow(height, 1. / 6);
}

/* A solitary wave whose crest is at contact c when that line has it at bead c; and one that falls to a quarter half way. */
static void make_wave(double time, bool falls, double *contact)
{
    for (size_t c = 0; c + 1 < BALLS; c++) {
        const double phase = sqrt(10) / 5 * ((double)c - 1 - speed(force) * time);
        contact[c] = fabs(phase) < acos(0) ? (falls && c > BALLS / 2 ? 0.25 : 1) * force * pow(cos(phase), 6) : 0;
    }
}

struct film {
    bool theory, falls;
    int until, often; /* samples: the last; between pictures */
};

static struct bead_frame make_film(struct film film, enum bead_orientation orientation)
{
    struct bead_look look;
    struct bead_colormap map;
    struct bead_view *view;
    struct bead_chain *chain;
    struct bead_frame frame, background;
    struct bead_message msg = {""};
    struct bead_scene *scene = parse("materials: {one: {radius: 0.5 m, mass: 1 kg, modulus: 1 GPa, poisson: 0}}\n"
                                     "chain: {striker: {bead: one, velocity: 1 m/s}, beads: [{bead: one, count: 60}]}\n"
                                     "simulate: {until: 40 ms}\noutputs: [{table: t.csv, show: peaks}]\n");
    double contact[BALLS] = {0}, level[BALLS];
    const struct bead_view_type *type = bead_view_find(BEAD_VIEW_SPACETIME);
    assert_int_equal(bead_chain_create(scene, 0, &chain, &msg), BEAD_OK);
    assert_int_equal(bead_colormap_load("inferno", &map, NULL), BEAD_OK);
    bead_look_screen(&look, WIDTH, HEIGHT, true);
    const struct bead_view_setup setup = {.chain = chain,
                                          .field = BEAD_FIELD_VELOCITY,
                                          .beads = {0, BALLS - 1},
                                          .time = {0, end},
                                          .look = &look,
                                          .orientation = orientation,
                                          .colours = {&map, BEAD_SCALE_LINEAR, 0, 1, 0},
                                          .fill = true,
                                          .theory = film.theory};
    assert_true(!film.theory || (type->fields(&setup) & BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE)));
    assert_int_equal(type->create(&setup, &view, &msg), BEAD_OK);
    assert_int_equal(type->place(view, plot, NULL, &msg), BEAD_OK);
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &background, NULL), BEAD_OK);
    memset(background.pixels, 0, background.stride * HEIGHT);
    for (size_t i = 0; i < BALLS; i++)
        level[i] = 0.5;
    memcpy(frame.pixels, background.pixels, frame.stride * HEIGHT);
    for (int i = 0; i <= film.until; i++) {
        struct bead_changes changes = {0};
        struct bead_sample sample = {.time = end * i / SAMPLES, .active = BALLS};
        make_wave(sample.time, film.falls, contact);
        sample.field[BEAD_FIELD_VELOCITY] = level;
        sample.field[BEAD_FIELD_CONTACT_FORCE] = contact;
        if (type->feed(view, &sample, &msg))
            fail_msg("%s", msg.text);
        if (i == film.until || i % film.often == 0)
            assert_int_equal(type->draw(view, sample.time, &frame, &background, &changes, &msg), BEAD_OK);
    }
    type->destroy(view);
    bead_frame_free(&background);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
    return frame;
}

static const uint8_t *pixel(const struct bead_frame *frame, int x, int y)
{
    return frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
}

/* White pixels of the line that are not in the words, which are in the corner where beads are at rest. */
static bool is_line(const struct bead_frame *with, const struct bead_frame *without, int x, int y, double late)
{
    const uint8_t *p = pixel(with, x, y);
    return late > 0.1 && p[0] > 200 && memcmp(p, pixel(without, x, y), 3) != 0;
}

/* Follows the line of a film and returns the largest distance, in beads, from a wave as fast as that of `height`. */
static double distance(enum bead_orientation orientation, struct film film, double height, int *pixels, double *last)
{
    const bool down = orientation == BEAD_TIME_DOWN;
    struct bead_frame with = make_film(film, orientation);
    film.theory = false;
    struct bead_frame without = make_film(film, orientation);
    double most = 0;
    *pixels = 0;
    *last = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const double right = (x + 0.5 - plot.x) / plot.width, below = (y + 0.5 - plot.y) / plot.height;
            const double when = down ? below : right, along = down ? right : 1 - below;
            if (memcmp(pixel(&with, x, y), pixel(&without, x, y), 3) != 0)
                assert_true(when > 0 && when <= (double)film.until / SAMPLES + 0.01 && along > 0 && along < 1);
            if (!is_line(&with, &without, x, y, when - along + 0.4))
                continue;
            *pixels += 1;
            *last = fmax(*last, when);
            most = fmax(most, fabs(along * BALLS - 0.5 - 1 - speed(height) * when * end));
        }
    }
    bead_frame_free(&with);
    bead_frame_free(&without);
    return most;
}

static void it_is_the_closed_forms(void **state)
{
    (void)state;
    static const enum bead_orientation orientations[] = {BEAD_TIME_DOWN, BEAD_TIME_RIGHT};
    for (size_t i = 0; i < 2; i++) {
        for (int until = SAMPLES / 3; until <= 2 * SAMPLES / 3; until += SAMPLES / 3) {
            int pixels;
            double last, most = distance(orientations[i], (struct film){true, false, until, EVERY}, force, &pixels, &last);
            if (!(most < 1 && pixels > 20 && last > (double)until / SAMPLES - 0.1))
                fail_msg("%d pixels up to %.3f, at %d of %d; %.2f beads off", pixels, last, until, SAMPLES, most);
        }
    }
}

/* As the pulse grows weaker, the whole line turns. */
static void it_turns_with_the_force(void **state)
{
    (void)state;
    int pixels;
    double last;
    const struct film film = {true, true, SAMPLES, EVERY};
    assert_true(distance(BEAD_TIME_DOWN, film, force, &pixels, &last) > 3);
    const double most = distance(BEAD_TIME_DOWN, film, force / 4, &pixels, &last);
    if (!(most < 1 && pixels > 40))
        fail_msg("%d pixels, %.2f beads off", pixels, most);
}

static void it_is_the_same_in_parts(void **state)
{
    (void)state;
    for (int falls = 0; falls < 2; falls++) {
        struct bead_frame often = make_film((struct film){true, falls, 150, 7}, BEAD_TIME_DOWN),
                          once = make_film((struct film){true, falls, 150, 1000}, BEAD_TIME_DOWN);
        assert_int_equal(bead_frame_hash(&often), bead_frame_hash(&once));
        bead_frame_free(&often);
        bead_frame_free(&once);
    }
}

/* A light line is visible on any colour, and so are its edges: black of 0.6, on either side, no narrower than half the line and no
 * wider than it. Each channel gains light * (1 - ground) - dark * 0.6 * ground, with two areas, which two channels determine. */
static void it_has_dark_edges(void **state)
{
    (void)state;
    struct film film = {true, false, 2 * SAMPLES / 3, EVERY};
    struct bead_frame with = make_film(film, BEAD_TIME_DOWN);
    film.theory = false;
    struct bead_frame without = make_film(film, BEAD_TIME_DOWN);
    const double shown = (double)film.until / SAMPLES;
    double gained[2] = {0, 0}, ground[2] = {0, 0}, rows = 0;
    for (int y = 0; y < HEIGHT; y++) {
        const double when = (y + 0.5 - plot.y) / plot.height;
        if (when < 0.1 || when > shown - 0.1) /* beside the words, and above the cursor */
            continue;
        rows++;
        for (int x = 0; x < WIDTH; x++) {
            if (when - (x + 0.5 - plot.x) / plot.width + 0.4 <= 0.1)
                continue;
            for (int k = 0; k < 2; k++) { /* blue and red */
                ground[k] = pixel(&without, plot.x + 1, y)[2 * k] / 255.0;
                gained[k] += (pixel(&with, x, y)[2 * k] - pixel(&without, x, y)[2 * k]) / 255.0;
            }
        }
    }
    const double a = 1 - ground[0], b = 0.6 * ground[0], c = 1 - ground[1], d = 0.6 * ground[1], all = a * d - b * c;
    const double light = (gained[0] * d - b * gained[1]) / all, dark = (gained[0] * c - a * gained[1]) / all;
    if (!(rows > 60 && light > 0.6 * rows && dark > light && dark < 2 * light))
        fail_msg("in %g rows %.0f pixels are light, %.0f dark, on %.2f and %.2f", rows, light, dark, ground[0], ground[1]);
    bead_frame_free(&with);
    bead_frame_free(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_the_closed_forms),
        cmocka_unit_test(it_turns_with_the_force),
        cmocka_unit_test(it_is_the_same_in_parts),
        cmocka_unit_test(it_has_dark_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
