/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The camera: its window holds the front, moves without jerks, rests at both ends. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/movie/composer_private.h"
#include "render/stage/camera.h"
#include "render/stage/magnify.h"

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

/* Slope at most 1, no jump of the slope, within its limits, at rest at both ends. */
static void windows_start_and_stop_softly(void **state)
{
    (void)state;
    const double width = 2, low = -0.5, high = 7, step = 1e-3;
    double before = bead_window_left(-10, width, low, high), slope = 0;
    assert_true(before == low && bead_window_left(20, width, low, high) == high);
    for (double front = -10 + step; front < 20; front += step) {
        double left = bead_window_left(front, width, low, high), now = (left - before) / step;
        assert_true(left >= low && left <= high && now > -1e-9 && now < 1 + 1e-9);
        assert_true(fabs(now - slope) < 1.001 * step / (0.4 * width));
        before = left;
        slope = now;
    }
    assert_true(bead_window_left(3, width, 1, 0) == 1); /* longer than the chain: its beginning */
}

static void followers_do_not_lag(void **state)
{
    (void)state;
    struct bead_follower f = bead_follower_make(40, 1000, 1000, 1);
    double place = 0;
    for (int i = 0; i <= 600; i++)
        place = bead_follower_advance(&f, 1000 * i / 600.0, i / 600.0);
    assert_true(fabs(place - 1000) < 0.5);
}

/* A step of compression that runs from bead to bead at constant speed and takes `part` of the picture's time. */
static void run(size_t beads, size_t window, double part, int frames)
{
    char text[400];
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_camera *camera;
    struct bead_message msg = {""};
    snprintf(text, sizeof text,
             "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, beads: [{bead: large-steel, count: %zu}], wall: brass}\n"
             "outputs: [{movie: a.mp4}]\n",
             beads - 1);
    require(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), &msg);
    require(bead_chain_create(scene, 0, &chain, &msg), &msg);
    double radius, spacing = bead_chain_spacing(chain, (struct bead_span){0, beads - 1}, &radius), time[2] = {0, 1e-3};
    double *u = calloc(beads, sizeof *u), width = (double)window * spacing, unit = bead_compression_scale(chain);
    const double *position = bead_chain_position(chain);
    assert_non_null(u);
    require(bead_camera_create(chain, (struct bead_span){0, beads - 1}, width, time, &camera, &msg), &msg);
    double left[3] = {0, 0, 0}, mean = (double)beads * spacing / (part * frames), most = 0, first = 0, last = 0;
    for (int i = 0; i < frames; i++) {
        struct bead_sample sample = {.index = (size_t)i, .time = 1e-3 * i / (frames - 1), .active = beads};
        double front = (double)beads * sample.time / (1e-3 * part);
        for (size_t j = 0; j < beads; j++) /* each contact behind the front is compressed by 0.3 units */
            u[j] = 0.3 * unit * fmax(0, fmin(front, (double)beads) - (double)j);
        sample.field[BEAD_FIELD_DISPLACEMENT] = u;
        require(bead_camera_feed(camera, &sample, &msg), &msg);
        bead_camera_advance(camera, sample.time);
        left[0] = left[1], left[1] = left[2], left[2] = bead_camera_left(camera);
        first = i == 0 ? left[2] : first;
        last = left[2];
        double place = position[(size_t)fmin(front, (double)beads - 1)];
        if (place < left[2] - radius || place > left[2] + width + radius)
            fail_msg("%zu beads, frame %d: the front is at %g m, the window at %g m to %g m", beads, i, place, left[2],
                     left[2] + width);
        assert_true(i == 0 || left[2] >= left[1]);
        if (i > 1)
            most = fmax(most, fabs(left[2] - 2 * left[1] + left[0]));
    }
    /* At rest at the chain's ends, striker and wall in sight. */
    assert_true(first < position[0] - radius && last + width > position[beads - 1] + radius);
    assert_true(last + width < position[beads - 1] + 3 * radius);
    /* No jerks: from rest to the front's speed in several frames, as its way through the window allows. */
    double in_window = fmin(width, 2.5 * (beads * spacing + 3.2 * radius - width)) / mean,
           softest = mean * fmax(0.02, fmin(1, 8 / in_window));
    if (most > softest)
        fail_msg("%zu beads: the speed of the window jumps by %g of the mean speed", beads, most / mean);
    bead_camera_destroy(camera);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
    free(u);
}

static void windows_hold_the_front(void **state)
{
    (void)state;
    run(129, 40, 0.85, 600);
    run(129, 12, 1, 600);
    run(1000, 40, 1, 600);
    run(1000, 40, 0.5, 600);
    run(5000, 60, 1, 600);
    run(45, 40, 1, 120);
    run(30, 8, 0.9, 60);
}

/* As many beads as asked for, at most, each drawn whole, in frames of any shape with any number of chains. */
static void window_of(const char *layout, size_t chains, int width, int height, size_t window)
{
    char text[4096];
    struct bead_scene *scene;
    struct bead_composer *composer;
    struct bead_chain *chain[8];
    struct bead_message msg = {""};
    size_t used = (size_t)snprintf(text, sizeof text, "chains:\n");
    for (size_t c = 0; c < chains; c++)
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "  - {name: c%zu, striker: {bead: large-steel}, beads: [{cell: [large-steel, aluminium], count: "
                                 "40, spins: random, seed: %zu}]}\n",
                                 c, c);
    snprintf(text + used, sizeof text - used, "outputs: [{movie: a.mp4, layout: %s, follow: front, window: %zu}]\n", layout,
             window);
    require(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), &msg);
    for (size_t c = 0; c < chains; c++)
        require(bead_chain_create(scene, c, &chain[c], &msg), &msg);
    struct bead_composer_setup setup = {.output = &scene->outputs[0],
                                        .chains = (const struct bead_chain *const *)chain,
                                        .chain_count = chains,
                                        .width = width,
                                        .height = height,
                                        .time = {0, 1e-3},
                                        .step = 1e-5,
                                        .range = {0, 40}};
    require(bead_composer_create(&setup, &composer, &msg), &msg);
    for (size_t c = 0; c < chains; c++) {
        double radius, spacing = bead_chain_spacing(chain[c], (struct bead_span){0, 80}, &radius);
        double shown = bead_camera_width(composer->cameras[c]);
        struct bead_rect plot = composer->layout.chains[c].plot[0];
        if (shown > 1.001 * (double)window * spacing)
            fail_msg("%zu chains, %d x %d: %g beads are shown, not %zu", chains, width, height, shown / spacing, window);
        if (2 * radius * plot.width / shown > plot.height)
            fail_msg("%zu chains, %d x %d: beads are higher than their row of %d", chains, width, height, plot.height);
        if (strcmp(layout, "stage") == 0)
            continue; /* its curve and images are beside each other */
        assert_int_equal(composer->layout.chains[c].plot[1].width, plot.width);
        const int image = composer->layout.chains[c].plot[2].width; /* 0: it has given way to names */
        assert_true(image == 0 || image >= plot.width);
        assert_true(image > 0 || chains > 4);
    }
    bead_composer_destroy(composer);
    for (size_t c = 0; c < chains; c++)
        bead_chain_destroy(chain[c]);
    bead_scene_free(scene);
}

static void windows_show_as_many_beads_as_asked_for(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1920, 1080}, {1280, 720}, {720, 1280}, {640, 360}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (size_t chains = 1; chains <= 8; chains++) {
            window_of("images", chains, sizes[s][0], sizes[s][1], 40);
            window_of("images", chains, sizes[s][0], sizes[s][1], 12);
            if (chains <= 3)
                window_of("stage", chains, sizes[s][0], sizes[s][1], 12);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_start_and_stop_softly),
        cmocka_unit_test(followers_do_not_lag),
        cmocka_unit_test(windows_hold_the_front),
        cmocka_unit_test(windows_show_as_many_beads_as_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
