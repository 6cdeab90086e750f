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
#include "render/stage/camera_steps.h"
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

/* ---- the head of the wave, by the loads of contacts and the ways they go ---- */

enum { CONTACTS = 100 };

struct waves {
    double load[CONTACTS];
    signed char way[CONTACTS];
};

/* Contact k has this load, and goes this way. */
static void put(struct waves *w, size_t k, double load, int way)
{
    w->load[k] = load;
    w->way[k] = (signed char)way;
}

static double find(struct bead_step_camera *c, const struct waves *w)
{
    return bead_step_camera_find(c, (struct bead_loads){w->load, w->way, CONTACTS});
}

/* Three contacts, half as strong beside the middle. */
static struct waves pulse(size_t middle, int way)
{
    struct waves w = {0};
    for (size_t k = middle - 1; k <= middle + 1; k++)
        put(&w, k, k == middle ? 1 : 0.5, way);
    return w;
}

static void heads_are_centres_of_what_is_foremost(void **state)
{
    (void)state;
    struct bead_step_camera c = {0};
    struct waves w = pulse(30, 1);
    put(&w, 15, 1, 1);    /* a tail, ten and more behind the foremost contact */
    put(&w, 22, 1, 1);    /* nine behind: no more */
    put(&w, 40, 0.04, 1); /* weaker than a twentieth */
    put(&w, 35, 1, -1);   /* another way */
    assert_true(find(&c, &w) == 30 && c.front == 31 && !c.arrived);
    put(&w, 23, 1, 1); /* eight behind: squares 1, 1/4, 1, 1/4 at 23, 29, 30, 31 */
    c = (struct bead_step_camera){0};
    assert_true(fabs(find(&c, &w) - (23 + 0.25 * 29 + 30 + 0.25 * 31) / 2.5) < 1e-12);
    put(&w, 33, 0.051, 1); /* stronger than a twentieth: the foremost */
    assert_true(find(&c, &w) > 29 && c.front == 33);
}

/* The head does not go back before the wave has been at the end, and what it has passed does not come to meet it. */
static void heads_do_not_go_back(void **state)
{
    (void)state;
    struct bead_step_camera c = {0};
    struct waves w = pulse(30, 1);
    (void)find(&c, &w);
    w = pulse(25, 1);
    put(&w, 29, 0.9, -1);
    assert_true(find(&c, &w) == 30 && c.front == 31 && !c.meets && c.other == 30);
    put(&w, 32, 0.9, -1);
    assert_true(find(&c, &w) == 30 && c.meets && c.other == 32); /* its own middle is ahead of the front */
}

/* A wave meets it within forty contacts, if it is half as strong or more. */
static void waves_are_seen_coming(void **state)
{
    (void)state;
    static const struct {
        size_t at[2];
        double load;
        bool comes;
        double other;
    } cases[] = {{{60, 60}, 0.6, true, 60},
                 {{60, 60}, 0.49, false, 20},
                 {{61, 61}, 0.6, false, 20},
                 {{22, 24}, 0.6, true, 23},
                 {{59, 61}, 0.6, true, 59}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_step_camera c = {0};
        struct waves w = pulse(20, 1);
        for (int k = 0; k < 2; k++)
            put(&w, cases[i].at[k], cases[i].load, -1);
        assert_true(find(&c, &w) == 20 && c.meets == cases[i].comes);
        assert_true(fabs(c.other - cases[i].other) < 1e-12);
    }
}

/* At the last contact it has arrived, and is then followed back; at the ends all loads are its own. One that only goes to the left
 * has been there. */
static void heads_come_back(void **state)
{
    (void)state;
    struct bead_step_camera c = {0};
    struct waves w = pulse(CONTACTS - 2, 1);
    assert_true(find(&c, &w) == CONTACTS - 2 && c.arrived && c.front == CONTACTS - 1);
    for (int k = CONTACTS - 2; k >= 1; k -= 6) {
        w = pulse((size_t)k, -1);
        if (k < 60)
            put(&w, (size_t)k + 30, 1, -1); /* too far behind */
        if (k + 15 < CONTACTS && k > 15)
            put(&w, (size_t)k + 4, 1, 1); /* passes it */
        assert_true(find(&c, &w) == k && c.arrived && !c.meets);
    }
    assert_int_equal(c.way, 1); /* it has also turned round at the first contact */
    w = pulse(12, 1);
    assert_true(find(&c, &w) == 11); /* of loads within nine contacts of the previous place */
    assert_true(find(&c, &w) == 12);
    struct bead_step_camera left = {0};
    w = pulse(70, -1);
    assert_true(find(&left, &w) == 70 && left.arrived && left.front == 0);
    struct bead_step_camera rest = {0};
    const struct waves none = {0};
    assert_true(find(&rest, &none) == 0 && !rest.arrived);
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
    double radius, spacing = bead_chain_spacing(chain, (struct bead_span){0, beads - 1}, &radius),
                   time[2] = {2e-3, 3e-3}; /* of a part of the run */
    double *u = calloc(beads, sizeof *u), width = (double)window * spacing, unit = bead_compression_scale(chain);
    const double *position = bead_chain_position(chain);
    assert_non_null(u);
    require(bead_camera_create(chain, (struct bead_span){0, beads - 1}, width, time, &camera, &msg), &msg);
    double left[3] = {0, 0, 0}, mean = (double)beads * spacing / (part * frames), most = 0, first = 0, last = 0;
    for (int i = 0; i < frames; i++) {
        struct bead_sample sample = {.index = (size_t)i, .time = time[0] + 1e-3 * i / (frames - 1), .active = beads};
        double front = (double)beads * (sample.time - time[0]) / (1e-3 * part);
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

/* A wave in beads `first` to `last` of a chain, which presses each contact in turn, that with the wall, too, in a film that takes
 * no time, so that nothing is smoothed: the window is where that of the front is, between any two beads, however long they are, and
 * between two samples, without a look at the rest of the chain. */
static void follow(const char *wall, size_t first, size_t last)
{
    enum { MOST_BEADS = 60, STEPS = 300 };
    const double now[2] = {1e-3, 1e-3}, width = 0.1, reached = 0.015, beyond[] = {0.2, 2.4, 0.8};
    char text[400];
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_camera *camera;
    struct bead_message msg = {""};
    snprintf(text, sizeof text,
             "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 4}, {cell: "
             "[large-steel, ptfe, small-steel], count: 10}, {bead: ptfe, count: 4}], wall: %s}\noutputs: [{movie: a.mp4}]\n",
             wall);
    require(bead_scene_parse("test", text, strlen(text), NULL, &scene, &msg), &msg);
    require(bead_chain_create(scene, 0, &chain, &msg), &msg);
    require(bead_camera_create(chain, (struct bead_span){first, last}, width, now, &camera, &msg), &msg);
    const double *position = bead_chain_position(chain), *radius = bead_chain_radius(chain);
    const size_t all = bead_chain_beads(chain);
    const bool walled = last + 1 == all && strcmp(wall, "none") != 0;
    double u[MOST_BEADS], largest = 0, before = (double)first;
    for (size_t i = 0; i < all; i++)
        u[i] = i % 2 ? 1 : -1;
    for (size_t i = first; i <= last; i++)
        largest = fmax(largest, radius[i]);
    const double low = position[first] - radius[first] - beyond[first == 0] * largest,
                 high = position[last] + radius[last] + beyond[walled ? 2 : 0] * largest;
    for (int k = 0; k < STEPS; k++) {
        const double front = (double)first + k * ((double)(last - first) + walled) / (STEPS - 1), middle = (front + before) / 2;
        struct bead_sample sample = {.index = (size_t)k, .time = 1e-3 * (k + 1), .active = all};
        for (size_t j = last + 1; j-- > first;)
            u[j] = (j < last ? u[j + 1] : 0) +
                   (j < last || walled ? reached * bead_compression_scale(chain) * fmin(1, fmax(0, front - (double)j)) : 0);
        sample.field[BEAD_FIELD_DISPLACEMENT] = u;
        require(bead_camera_feed(camera, &sample, &msg), &msg);
        bead_camera_advance(camera, sample.time - 0.5e-3);
        const size_t bead = (size_t)fmin(middle, (double)last - 1);
        const double place = position[bead] + fmin(middle - (double)bead, 1) * (position[bead + 1] - position[bead]);
        assert_float_equal(bead_camera_left(camera), bead_window_left(place, width, low, high - width), 1e-9);
        before = front;
    }
    assert_true(bead_camera_left(camera) > high - width - 0.005 && bead_camera_width(camera) == width);
    bead_camera_destroy(camera);
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

static void windows_are_those_of_their_front(void **state)
{
    (void)state;
    static const char *const walls[] = {"none", "rigid", "brass"};
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        follow(walls[i], 0, 38); /* all of it, and parts with one end, or none */
        follow(walls[i], 3, 38);
        follow(walls[i], 0, 37);
        follow(walls[i], 5, 35);
    }
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

/* At most as many beads as requested, each drawn whole, in frames of any shape with any number of chains. */
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
                                        .range = {.high = 40}};
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
        cmocka_unit_test(heads_are_centres_of_what_is_foremost),
        cmocka_unit_test(heads_do_not_go_back),
        cmocka_unit_test(waves_are_seen_coming),
        cmocka_unit_test(heads_come_back),
        cmocka_unit_test(windows_are_those_of_their_front),
        cmocka_unit_test(windows_hold_the_front),
        cmocka_unit_test(windows_show_as_many_beads_as_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
