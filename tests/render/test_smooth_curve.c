/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The smooth curve of profiles: it passes through the values, a pulse has the same height at any place, and no value has the wrong
 * sign. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/draw/smooth_curve.h"

enum { COUNT = 40, PARTS = 8 };

/* Force in a contact of a solitary wave of equal beads, after V. F. Nesterenko (1983): cos^6 over five bead diameters. */
static double contact_force(double place)
{
    double phase = place * sqrt(10) / 5;
    return fabs(phase) < M_PI / 2 ? pow(cos(phase), 6) : 0;
}

/* Forces of beads, the mean of two contacts; y points down. */
static void pulse(double centre, float *x, float *y)
{
    for (int i = 0; i < COUNT; i++) {
        x[i] = (float)(10 * i);
        y[i] = (float)(100 - 40 * (contact_force(i - 0.5 - centre) + contact_force(i + 0.5 - centre)));
    }
}

static double peak_of(const float *y, size_t count)
{
    double least = 100;
    for (size_t i = 0; i < count; i++)
        least = fmin(least, y[i]);
    return 100 - least;
}

static void the_peak_does_not_jitter(void **state)
{
    (void)state;
    float x[COUNT], y[COUNT], sx[COUNT * PARTS], sy[COUNT * PARTS];
    double low = 1e9, high = 0, polygon_low = 1e9, polygon_high = 0;
    for (int k = 0; k <= 50; k++) {
        pulse(20 + k / 50.0, x, y);
        size_t points = bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, false, -INFINITY, 100, sx, sy);
        assert_int_equal(points, (COUNT - 1) * PARTS + 1);
        low = fmin(low, peak_of(sy, points));
        high = fmax(high, peak_of(sy, points));
        polygon_low = fmin(polygon_low, peak_of(y, COUNT));
        polygon_high = fmax(polygon_high, peak_of(y, COUNT));
    }
    assert_true(polygon_high - polygon_low > 0.1 * polygon_high);
    assert_true(high - low < 0.015 * high);
}

static void values_are_kept(void **state)
{
    (void)state;
    float x[COUNT], y[COUNT], sx[COUNT * PARTS], sy[COUNT * PARTS];
    pulse(20.3, x, y);
    size_t points = bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, false, -INFINITY, 100, sx, sy);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(sx[i * PARTS] == x[i] && sy[i * PARTS] == y[i]);
    for (size_t i = 0; i < points; i++)
        assert_true(sy[i] <= 100); /* no force of the wrong sign */
    assert_int_equal(bead_smooth_fill(x, y, COUNT, 0, COUNT, 1, false, -INFINITY, 100, sx, sy), COUNT);
    assert_memory_equal(y, sy, sizeof y);
}

/* The part redrawn after a value has changed is all that it changes, and a part is as in the whole. */
static void influence_ends(void **state)
{
    (void)state;
    float x[COUNT], y[COUNT], sx[2][COUNT * PARTS], sy[2][COUNT * PARTS];
    pulse(20.3, x, y);
    size_t points = bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, false, -INFINITY, INFINITY, sx[0], sy[0]);
    y[18] -= 5;
    bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, false, -INFINITY, INFINITY, sx[1], sy[1]);
    for (size_t i = 0; i < points; i++) {
        if (i <= (18 - BEAD_SMOOTH_REACH) * PARTS || i >= (18 + BEAD_SMOOTH_REACH) * PARTS)
            assert_true(sy[0][i] == sy[1][i]);
    }
    bead_smooth_fill(x, y, COUNT, 10, 20, PARTS, false, -INFINITY, INFINITY, sx[0], sy[0]);
    for (size_t i = 0; i <= 9 * PARTS; i++)
        assert_true(sy[0][i] == sy[1][10 * PARTS + i]);
}

/* The fifth mode of a string: with its fixed ends the curve is the sine everywhere, without bends at the ends. */
static void strings_are_straight_at_their_ends(void **state)
{
    (void)state;
    float x[COUNT], y[COUNT], sx[COUNT * PARTS], sy[COUNT * PARTS];
    for (int i = 0; i < COUNT; i++) {
        x[i] = (float)(10 * i);
        y[i] = (float)(50 - 40 * sin(5 * M_PI * i / (COUNT - 1)));
    }
    const size_t points = bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, true, -INFINITY, INFINITY, sx, sy);
    for (size_t i = 0; i < points; i++)
        assert_float_equal(sy[i], 50 - 40 * sin(5 * M_PI * sx[i] / (10 * (COUNT - 1))), 0.05);
}

/* A spline of values of a cubic is that cubic, far from the ends. */
static void cubics_are_kept(void **state)
{
    (void)state;
    float x[COUNT], y[COUNT], sx[COUNT * PARTS], sy[COUNT * PARTS];
    for (int i = 0; i < COUNT; i++) {
        const double t = (i - 20) / 10.0;
        x[i] = (float)(10 * i);
        y[i] = (float)(20 + 30 * t - 12 * t * t + 8 * t * t * t);
    }
    (void)bead_smooth_fill(x, y, COUNT, 0, COUNT, PARTS, false, -INFINITY, INFINITY, sx, sy);
    for (size_t i = 10 * PARTS; i < (COUNT - 10) * PARTS; i++) {
        const double t = ((double)i / PARTS - 20) / 10.0;
        assert_float_equal(sx[i], 10.0 * (double)i / PARTS, 1e-4);
        assert_float_equal(sy[i], 20 + 30 * t - 12 * t * t + 8 * t * t * t, 5e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_peak_does_not_jitter),
        cmocka_unit_test(values_are_kept),
        cmocka_unit_test(strings_are_straight_at_their_ends),
        cmocka_unit_test(influence_ends),
        cmocka_unit_test(cubics_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
