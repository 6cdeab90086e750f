/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Averages over areas of a field: exact, whatever the samples. */
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

#include "render/view/area.h"

/* A field that is linear in time between knots, different for every bead. */
static double field_at(size_t bead, double time)
{
    const double knot = 0.37;
    double k = floor(time / knot), part = time / knot - k;
    double a = sin(3.1 * (double)bead + 1.7 * k), b = sin(3.1 * (double)bead + 1.7 * (k + 1));
    return a + part * (b - a);
}

static struct bead_area *make_area(struct bead_span beads, double from, double to, int across, int along)
{
    struct bead_area_setup setup = {beads, {from, to}, across, along, BEAD_SAMPLING_AREA};
    struct bead_area *area;
    assert_int_equal(bead_area_create(&setup, &area, NULL), BEAD_OK);
    return area;
}

/* Samples at all multiples of `every`, and every knot among them. */
static void feed_field(struct bead_area *area, size_t beads, double until, int parts)
{
    double *values = calloc(beads, sizeof *values);
    for (int i = 0; i * 0.37 / parts <= until + 0.37; i++) {
        for (size_t b = 0; b < beads; b++)
            values[b] = field_at(b, i * 0.37 / parts);
        bead_area_feed(area, i * 0.37 / parts, values, beads);
    }
    free(values);
}

/* Mean over time of one bead, by many midpoints: exact for pieces that are linear between them. */
static double mean_of(size_t bead, double from, double to)
{
    double sum = 0, at = from;
    while (at < to - 1e-15) {
        double next = fmin(to, (floor(at / 0.37 + 1e-9) + 1) * 0.37);
        sum += (next - at) * field_at(bead, 0.5 * (at + next));
        at = next;
    }
    return sum / (to - from);
}

static double overlap(double a0, double a1, double b0, double b1)
{
    return fmax(0, fmin(a1, b1) - fmax(a0, b0));
}

static void assert_means(size_t first, size_t last, int across, int along)
{
    size_t beads = last + 3, shown = last - first + 1;
    double from = 0.21, to = 5.43;
    struct bead_area *area = make_area((struct bead_span){first, last}, from, to, across, along);
    double *means = calloc((size_t)across, sizeof *means);
    feed_field(area, beads, to, 1);
    for (int c = 0; c < along; c++) {
        assert_true(bead_area_column(area, c, means));
        double t0 = from + (to - from) * c / along, t1 = from + (to - from) * (c + 1) / along;
        for (int p = 0; p < across; p++) {
            double x0 = (double)p * (double)shown / across, x1 = (double)(p + 1) * (double)shown / across, wanted = 0;
            for (size_t b = 0; b < shown; b++) {
                double part = overlap(x0, x1, (double)b, (double)b + 1);
                wanted += part > 0 ? part / (x1 - x0) * mean_of(first + b, t0, t1) : 0;
            }
            if (!(fabs(means[p] - wanted) < 1e-12))
                fail_msg("pixel %d, %d of %d x %d: %.15g, not %.15g", c, p, along, across, means[p], wanted);
        }
    }
    free(means);
    bead_area_destroy(area);
}

static void test_means_are_exact(void **state)
{
    (void)state;
    assert_means(0, 6, 7, 11);   /* a pixel a bead */
    assert_means(2, 8, 40, 300); /* more pixels than beads, and than samples */
    assert_means(1, 90, 13, 4);  /* fewer of both */
    assert_means(3, 20, 17, 9);  /* nearly as many */
    assert_means(5, 5, 3, 2);    /* one bead */
}

static void test_short_pulse_keeps_its_integral(void **state)
{
    (void)state;
    enum { BEADS = 500, SAMPLES = 1000, ACROSS = 37, ALONG = 23 };
    struct bead_area *area = make_area((struct bead_span){0, BEADS - 1}, 0, SAMPLES, ACROSS, ALONG);
    double *values = calloc(BEADS, sizeof *values), means[ACROSS], sum = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        values[123] = i == 457 ? 8 : 0;
        bead_area_feed(area, i, values, BEADS);
    }
    for (int c = 0; c < ALONG; c++) {
        assert_true(bead_area_column(area, c, means));
        for (int p = 0; p < ACROSS; p++)
            sum += means[p] * SAMPLES / ALONG * BEADS / ACROSS;
    }
    assert_true(fabs(sum - 8) < 1e-12); /* a triangle 2 wide and 8 high, one bead wide */
    free(values);
    bead_area_destroy(area);
}

static void test_finer_samples_change_nothing(void **state)
{
    (void)state;
    enum { ACROSS = 29, ALONG = 41 };
    struct bead_area *coarse = make_area((struct bead_span){0, 60}, 0.5, 4, ACROSS, ALONG);
    struct bead_area *fine = make_area((struct bead_span){0, 60}, 0.5, 4, ACROSS, ALONG);
    double a[ACROSS], b[ACROSS];
    feed_field(coarse, 61, 4, 1);
    feed_field(fine, 61, 4, 7);
    for (int c = 0; c < ALONG; c++) {
        assert_true(bead_area_column(coarse, c, a) && bead_area_column(fine, c, b));
        for (int p = 0; p < ACROSS; p++)
            assert_true(fabs(a[p] - b[p]) < 1e-12);
    }
    bead_area_destroy(coarse);
    bead_area_destroy(fine);
}

/* Beads at rest are passed over, also where a chain at rest carries a force. */
static void test_resting_beads_keep_their_value(void **state)
{
    (void)state;
    for (int across = 5; across <= 60; across += 55) {
        struct bead_area *all = make_area((struct bead_span){0, 29}, 0, 30, across, 10);
        struct bead_area *moving = make_area((struct bead_span){0, 29}, 0, 30, across, 10);
        double values[30], a[60], b[60];
        for (size_t i = 0; i < 30; i++)
            values[i] = 10 + (double)i;
        for (size_t t = 0; t <= 30; t++) {
            for (size_t i = 0; i < t; i++)
                values[i] += sin((double)(t * i));
            bead_area_feed(all, (double)t, values, 30);
            bead_area_feed(moving, (double)t, values, t);
        }
        for (int c = 0; c < 10; c++) {
            assert_true(bead_area_column(all, c, a) && bead_area_column(moving, c, b));
            for (int p = 0; p < across; p++)
                assert_true(fabs(a[p] - b[p]) < 1e-11);
        }
        bead_area_destroy(all);
        bead_area_destroy(moving);
    }
}

static void test_what_no_sample_touched_is_said(void **state)
{
    (void)state;
    struct bead_area *area = make_area((struct bead_span){0, 1}, 0, 10, 2, 10);
    double values[2] = {1, 2}, means[2];
    bead_area_feed(area, 3.5, values, 2);
    bead_area_feed(area, 6.5, values, 2);
    for (int c = 0; c < 10; c++)
        assert_int_equal(bead_area_column(area, c, means), c >= 3 && c <= 6);
    assert_true(bead_area_column(area, 3, means) && means[0] == 1 && means[1] == 2);
    bead_area_destroy(area);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_means_are_exact),
        cmocka_unit_test(test_short_pulse_keeps_its_integral),
        cmocka_unit_test(test_finer_samples_change_nothing),
        cmocka_unit_test(test_resting_beads_keep_their_value),
        cmocka_unit_test(test_what_no_sample_touched_is_said),
    };
    return cmocka_run_group_tests_name("means", tests, NULL, NULL);
}
