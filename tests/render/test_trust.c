/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Predictability horizon: a comparison run does not change the first one; disordered chains have a horizon and ordered ones none;
 * the picture is the same except for the line. Images of films end at the present. */
#include "support.h"

#include "scratch.h"
#include "strokes.h"

#include "beadreel/session.h"
#include "beadreel/view.h"
#include "render/draw/looks.h"
#include "render/draw/picture.h"
#include "render/view/horizon.h"
#include "render/view/views.h"

/* ---- two runs ---- */

/* First time at which velocities of two runs to `accuracy` and `tolerance_factor` times that differ by more than `part` of their
 * range. */
static double find_horizon(const char *chain, const char *simulate, double tolerance_factor, double part, double until)
{
    struct built built = build(chain, simulate);
    struct bead_run *runs[2] = {start_run(&built, (struct bead_run_settings){.end = until}),
                                start_run(&built, (struct bead_run_settings){.end = until, .tolerance_factor = tolerance_factor})};
    struct bead_message msg = {""};
    struct bead_area_setup setup = {{0, built.chain->beads - 1}, {0, until}, 1000, 1000, BEAD_SAMPLING_AREA};
    struct bead_horizon *horizon;
    assert_int_equal(bead_horizon_create(&setup, &horizon, &msg), BEAD_OK);
    for (int i = 0; i <= 4000; i++) {
        double t = until * i / 4000;
        struct bead_sample sample[2];
        for (int r = 0; r < 2; r++) {
            run_until(runs[r], fmax(t, 1e-9));
            sample[r] = sample_at(runs[r], t);
        }
        size_t active = sample[0].active > sample[1].active ? sample[0].active : sample[1].active;
        bead_horizon_feed(horizon, t, sample[0].field[BEAD_FIELD_VELOCITY], sample[1].field[BEAD_FIELD_VELOCITY], active);
    }
    double range = 2 * built.chain->spec->striker_velocity;
    bead_horizon_find(horizon, part * range, 1000);
    double time = bead_horizon_time(horizon);
    bead_horizon_destroy(horizon);
    bead_run_destroy(runs[0]);
    bead_run_destroy(runs[1]);
    release(&built);
    return time;
}

/* Where all beads differ from one time on, the line goes straight from edge to edge of the image, and no further. */
static void lines_end_at_the_edges(void **)
{
    enum { SEEN = 5, COLUMNS = 100 };
    struct bead_message msg = {""};
    struct bead_look look;
    struct bead_horizon *horizon;
    struct bead_area_setup setup = {{0, SEEN - 1}, {0, 1}, SEEN, COLUMNS, BEAD_SAMPLING_AREA};
    const struct bead_rect plot = {20, 30, 200, 100};
    assert_int_equal(bead_horizon_create(&setup, &horizon, &msg), BEAD_OK);
    for (int i = 0; i <= 2 * COLUMNS; i++) {
        const double first[SEEN] = {0}, later[SEEN] = {1, 1, 1, 1, 1}, time = 0.5 * i / COLUMNS;
        bead_horizon_feed(horizon, time, first, time > 0.3 ? later : first, SEEN);
    }
    (void)bead_horizon_find(horizon, 0.4, COLUMNS);
    assert_at(bead_horizon_time(horizon), 0.3);
    bead_look_screen(&look, 1280, 720, false);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 240, 160);
    cairo_t *cr = cairo_create(surface);
    for (int down = 0; down < 2; down++) {
        strokes_begin();
        bead_horizon_draw(horizon, cr, &look, plot, down ? BEAD_TIME_DOWN : BEAD_TIME_RIGHT, true);
        strokes.on = false;
        assert_int_equal(strokes.count, 2);
        assert_bounds(&strokes.list[0], down ? 20 : 80, down ? 60 : 30, down ? 220 : 80, down ? 60 : 130);
    }
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    bead_horizon_destroy(horizon);
}

static void disorder_has_a_horizon(void **state)
{
    (void)state;
    double time = find_horizon(P3_CHAIN, "until: 20 ms", 10, 0.01, 12e-3);
    if (!(time > 2e-3 && time < 7e-3)) /* 1e-6 grows to 1e-2 by a factor e every 0.34 ms */
        fail_msg("the horizon is %.4g ms", 1e3 * time);
    double tighter = find_horizon(P3_CHAIN, "until: 20 ms, accuracy: 1e-9", 10, 0.01, 12e-3);
    if (!(tighter > time + 1e-3)) /* a thousand times less: later by some 2 ms */
        fail_msg("the horizon to 1e-9 is %.4g ms, to 1e-6 %.4g ms", 1e3 * tighter, 1e3 * time);
}

static void order_has_none_in_the_first_passage(void **state)
{
    (void)state;
    assert_true(isinf(find_horizon(P2_CHAIN, "until: 1.5 ms", 10, 0.01, 1.5e-3)));
    assert_true(isinf(find_horizon(P1_CHAIN, "until: 1.5 ms", 10, 0.01, 1.5e-3)));
}

static void smaller_differences_come_first(void **state)
{
    (void)state;
    double last = INFINITY;
    for (double part = 0.04; part > 0.002; part /= 2) {
        double time = find_horizon(P3_CHAIN, "until: 20 ms", 10, part, 8e-3);
        assert_true(time <= last);
        last = time;
    }
    assert_true(isfinite(last));
}

/* A comparison run that is the same run would agree always. */
static void runs_differ(void **state)
{
    (void)state;
    static const struct {
        const char *simulate;
        double tolerance_factor;
    } cases[] = {{"until: 1 ms", 10},
                 {"until: 1 ms, accuracy: 1e-10", 10},
                 {"until: 1 ms, accuracy: 3e-4", 0.1}, /* no longer steps than those */
                 {"until: 1 ms, step: 1 us", 2},
                 {"until: 1 ms, step: 8 us", 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct built built = build(P3_CHAIN, cases[i].simulate);
        const struct bead_chain *chain = built.chain;
        const struct bead_simulate *asked = &built.scene->simulate;
        struct bead_stepping first, comparison;
        struct bead_message msg = {""};
        double tolerance_factor = bead_run_tolerance_factor(&chain, 1, asked);
        assert_near(tolerance_factor, cases[i].tolerance_factor, 0);
        assert_int_equal(bead_run_stepping(chain, asked, 1, &first, &msg), BEAD_OK);
        assert_int_equal(bead_run_stepping(chain, asked, tolerance_factor, &comparison, &msg), BEAD_OK);
        assert_true(fabs(log(comparison.step / first.step)) > 0.1);
        release(&built);
    }
}

/* ---- sessions ---- */

static enum bead_error try_play(const char *input, const char *output, struct bead_counts *counts, struct bead_message *msg)
{
    static const struct bead_sink_type *const *lists[3];
    lists[0] = bead_data_sinks();
    lists[1] = bead_render_sinks();
    struct bead_session *session = NULL;
    struct bead_job job;
    BEAD_DEFAULT(&job);
    job.input = input;
    job.output = output;
    job.sinks = lists;
    job.hash = true;
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    if (!err)
        *counts = *bead_session_counts(session);
    bead_session_close(session);
    return err;
}

static enum bead_error play(const char *outputs, struct bead_counts *counts, struct bead_message *msg)
{
    char path[512];
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%ssimulate: {until: 2 ms}\noutputs: [%s]\n", P3_CHAIN, outputs);
    fclose(file);
    return try_play(path, directory, counts, msg);
}

static void the_first_run_keeps_its_bits(void **state)
{
    (void)state;
    struct bead_counts alone, two;
    struct bead_message msg = {""};
    if (play("{image: a.png, size: [640, 360]}", &alone, &msg) || play("{image: a.png, size: [640, 360], trust: true}", &two, &msg))
        fail_msg("%s", msg.text);
    assert_true(alone.state_hash == two.state_hash);
    assert_true(alone.steps == two.steps);
    assert_true(alone.evaluations == two.evaluations);
    assert_true(alone.comparison_steps == 0);
    assert_true(two.comparison_steps > 0 && two.comparison_steps < two.steps);
}

static void scenes_that_cannot_show_it(void **state)
{
    (void)state;
    static const char *const outputs[] = {"{image: a.png, trust: true, axes: false}", "{movie: a.mp4, trust: true, axes: false}",
                                          "{image: a.png, trust: true, views: [beads, profile]}", "{table: a.csv, trust: true}"};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        struct bead_counts counts;
        struct bead_message msg = {""};
        assert_int_equal(play(outputs[i], &counts, &msg), BEAD_ERROR_SCENE);
        assert_non_null(strstr(msg.text, "trust"));
    }
}

static void a_trajectory_has_no_comparison_run(void **state)
{
    (void)state;
    struct bead_counts counts;
    struct bead_message msg = {""};
    char run[512], again[512];
    snprintf(run, sizeof run, "%s/run.h5", directory);
    snprintf(again, sizeof again, "%s/a.png", directory);
    if (play("{trajectory: run.h5, every: 4 us}, {image: a.png, size: [640, 360], trust: true}", &counts, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(try_play(run, again, &counts, &msg), BEAD_ERROR_UNSUPPORTED);
    assert_non_null(strstr(msg.text, "run the scene"));
}

/* ---- pictures ---- */

enum { WIDTH = 400, HEIGHT = 200, LEFT = 10, TOP = 10 };

static double made_up(size_t bead, double time)
{
    return sin(0.7 * (double)bead + 3e4 * time);
}

/* When bead j of the comparison run goes its own way, s. */
static double parting(size_t bead)
{
    return 0.4e-3 + 2e-6 * (double)((bead * 37) % 50);
}

/* A picture of samples up to `until` us, of 1 ms, drawn in `parts`. */
static struct bead_frame draw_until(const struct bead_chain *chain, int until, bool trust, bool fill, int parts, double *horizon)
{
    struct bead_message msg = {""};
    struct bead_colormap map;
    struct bead_look look;
    struct bead_frame frame, background;
    struct bead_changes changes = {0};
    struct bead_view *view;
    const struct bead_view_type *type = bead_view_find(BEAD_VIEW_SPACETIME);
    double values[200], comparison[200];
    assert_int_equal(bead_colormap_load("viridis", &map, &msg), BEAD_OK);
    bead_look_screen(&look, WIDTH, HEIGHT, true);
    struct bead_view_setup setup = {.chain = chain,
                                    .field = BEAD_FIELD_FORCE,
                                    .beads = {0, bead_chain_beads(chain) - 1},
                                    .time = {0, 1e-3},
                                    .colours = {&map, BEAD_SCALE_LINEAR, -1, 1, 0},
                                    .look = &look,
                                    .orientation = fill ? BEAD_TIME_DOWN : BEAD_TIME_RIGHT,
                                    .fill = fill,
                                    .trust = trust};
    assert_int_equal(bead_frame_create(WIDTH + 2 * LEFT, HEIGHT + 2 * TOP, &frame, &msg), BEAD_OK);
    assert_int_equal(bead_frame_create(WIDTH + 2 * LEFT, HEIGHT + 2 * TOP, &background, &msg), BEAD_OK);
    assert_int_equal(type->create(&setup, &view, &msg), BEAD_OK);
    assert_int_equal(type->place(view, (struct bead_rect){LEFT, TOP, WIDTH, HEIGHT}, NULL, &msg), BEAD_OK);
    for (int i = 0; i <= until; i++) {
        double t = 1e-6 * i;
        for (size_t j = 0; j <= setup.beads.last; j++) {
            values[j] = made_up(j, t);
            comparison[j] = values[j] + (t > parting(j) ? 0.5 : 0);
        }
        struct bead_sample sample = {.time = t, .active = setup.beads.last + 1, .comparison_active = setup.beads.last + 1};
        sample.field[BEAD_FIELD_FORCE] = values;
        sample.comparison[BEAD_FIELD_FORCE] = trust ? comparison : NULL;
        assert_int_equal(type->feed(view, &sample, &msg), BEAD_OK);
        if (i == until || (parts > 0 && i % parts == 0))
            assert_int_equal(type->draw(view, t, &frame, &background, &changes, &msg), BEAD_OK);
    }
    *horizon = trust ? type->horizon(view) : INFINITY;
    type->destroy(view);
    bead_frame_free(&background);
    return frame;
}

static struct bead_frame draw_view(const struct bead_chain *chain, bool trust, bool fill, int parts, double *horizon)
{
    return draw_until(chain, 1000, trust, fill, parts, horizon);
}

/* A film's image has all times up to the present, none beyond it; a still has all. The background is black here, no value is. */
static void images_of_films_end_at_the_present(void **state)
{
    (void)state;
    struct built built = build(P2_CHAIN, "until: 1 ms");
    static const int untils[] = {100, 370, 900};
    for (size_t i = 0; i < 3; i++) {
        double none;
        struct bead_frame film = draw_until(built.chain, untils[i], false, true, 50, &none);
        for (int y = 0; y < HEIGHT; y++) {
            const double time = 1000 * (y + 0.5) / HEIGHT, pixel = 1000.0 / HEIGHT; /* us */
            size_t shown = 0;
            for (int x = 0; x < WIDTH; x++) {
                const uint8_t *p = film.pixels + (size_t)(TOP + y) * film.stride + 4 * (size_t)(LEFT + x);
                shown += p[0] + p[1] + p[2] > 0;
            }
            if (time < untils[i] - pixel || time > untils[i] + 4 * pixel) /* a line is at the present */
                assert_int_equal(shown, time < untils[i] ? WIDTH : 0);
        }
        bead_frame_free(&film);
    }
    release(&built);
}

static void pixels_are_the_same_but_for_the_line(void **state)
{
    (void)state;
    struct built built = build(P2_CHAIN, "until: 1 ms");
    double horizon, none;
    struct bead_frame with = draw_view(built.chain, true, false, 0, &horizon);
    struct bead_frame without = draw_view(built.chain, false, false, 0, &none);
    assert_near(horizon, 0.4e-3, 3e-6); /* the pixel that it lies in, or the one before */
    size_t different = 0;
    for (int y = 0; y < with.height; y++) {
        for (int x = 0; x < with.width; x++) {
            bool same = memcmp(with.pixels + (size_t)y * with.stride + 4 * (size_t)x,
                               without.pixels + (size_t)y * without.stride + 4 * (size_t)x, 3) == 0;
            double time = (x - LEFT) * 1e-3 / WIDTH;
            different += !same;
            assert_true(same || (time > 0.4e-3 - 10e-6 && time < 0.5e-3 + 10e-6));
        }
    }
    assert_true(different > HEIGHT && different < 40 * HEIGHT);
    bead_frame_free(&with);
    bead_frame_free(&without);
    release(&built);
}

static void movies_draw_the_same_line_in_any_parts(void **state)
{
    (void)state;
    struct built built = build(P2_CHAIN, "until: 1 ms");
    double horizon;
    struct bead_frame whole = draw_view(built.chain, true, true, 0, &horizon),
                      plain = draw_view(built.chain, false, true, 7, &horizon);
    static const int parts[] = {1, 7, 90};
    assert_true(bead_frame_hash(&whole) != bead_frame_hash(&plain));
    for (size_t i = 0; i < 3; i++) {
        struct bead_frame frame = draw_view(built.chain, true, true, parts[i], &horizon);
        assert_true(bead_frame_hash(&frame) == bead_frame_hash(&whole));
        bead_frame_free(&frame);
    }
    bead_frame_free(&whole);
    bead_frame_free(&plain);
    release(&built);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_end_at_the_edges),
        cmocka_unit_test(disorder_has_a_horizon),
        cmocka_unit_test(order_has_none_in_the_first_passage),
        cmocka_unit_test(smaller_differences_come_first),
        cmocka_unit_test(runs_differ),
        cmocka_unit_test(the_first_run_keeps_its_bits),
        cmocka_unit_test(scenes_that_cannot_show_it),
        cmocka_unit_test(a_trajectory_has_no_comparison_run),
        cmocka_unit_test(images_of_films_end_at_the_present),
        cmocka_unit_test(pixels_are_the_same_but_for_the_line),
        cmocka_unit_test(movies_draw_the_same_line_in_any_parts),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
