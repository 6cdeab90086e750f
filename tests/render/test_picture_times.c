/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The span of time that a picture shows, and the times of its samples. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "beadreel/scene.h"
#include "render/draw/picture_times.h"

/* What is asked for, within the run. */
static void spans_are_within_the_run(void **)
{
    static const struct {
        double asked[2], shown[2];
    } spans[] = {{{NAN, NAN}, {0, 4}}, {{1, NAN}, {1, 4}}, {{NAN, 3}, {0, 3}}, {{1, 3}, {1, 3}}, {{1, 9}, {1, 4}}};
    const struct bead_run_context context = {.end = 4};
    for (size_t i = 0; i < sizeof spans / sizeof *spans; i++) {
        struct bead_output output = {.shown.time = {spans[i].asked[0], spans[i].asked[1]}};
        double time[2];
        assert_int_equal(bead_picture_times(&output, &context, time, NULL), BEAD_OK);
        for (int k = 0; k < 2; k++)
            assert_true(time[k] == spans[i].shown[k]);
    }
}

static void assert_grid(struct bead_grid grid, double start, double every, double end)
{
    assert_true(fabs(grid.start - start) < 1e-12 && fabs(grid.every - every) < 1e-12 && fabs(grid.end - end) < 1e-12);
}

/* A pixel of 0.1 s has two samples or more, as many as resolve the motion, or what is asked for. */
static void pixels_have_two_samples_or_more(void **)
{
    static const double time[2] = {2, 12};
    static const struct {
        double resolution, asked, every;
    } grids[] = {{0, 0, 0.05},      {INFINITY, 0, 0.05}, {1, 0, 0.05}, {0.06, 0, 0.05},
                 {0.026, 0, 0.025}, {0.01, 0, 0.01},     {0.01, 3, 3}};
    for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
        const struct bead_run_context context = {.resolution = grids[i].resolution};
        assert_grid(bead_picture_grid(&context, &(struct bead_shown){.every = grids[i].asked}, time, 100), 2, grids[i].every, 12);
    }
}

/* Of kept samples: from the one before the beginning to the one after the end, if there is one. */
static void kept_samples_surround_the_span(void **)
{
    static const struct {
        double time[2], start, end;
    } spans[] = {{{2, 12}, 2, 12}, {{2.3, 11.2}, 2, 11.5}, {{2.5, 11.5}, 2.5, 11.5}, {{0, 19}, 1, 15}, {{14.9, 20}, 14.5, 15}};
    const struct bead_run_context context = {.resolution = 0.01, .native = {.start = 1, .every = 0.5, .end = 15}};
    for (size_t i = 0; i < sizeof spans / sizeof *spans; i++)
        assert_grid(bead_picture_grid(&context, &(struct bead_shown){.every = 0}, spans[i].time, 100), spans[i].start, 0.5,
                    spans[i].end);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spans_are_within_the_run),
        cmocka_unit_test(pixels_have_two_samples_or_more),
        cmocka_unit_test(kept_samples_surround_the_span),
    };
    return cmocka_run_group_tests_name("times of pictures", tests, NULL, NULL);
}
