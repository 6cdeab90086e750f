/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maxima and crossings between samples: exact for polynomials up to the order of the curve's points. */
#include "support.h"

#include <math.h>

#include "sim/measure/measure_private.h"

enum { COUNT = 20 };

/* 10 - (x - m)^2 (1 + 0.01 (x - m)): its maximum is 10 at m. */
static double hill(double x, double m)
{
    return 10 - (x - m) * (x - m) * (1 + 0.01 * (x - m));
}

static void assert_close(double got, double expected)
{
    if (!(fabs(got - expected) < 1e-9))
        fail_msg("%.15g, not %.15g", got, expected);
}

static void maxima_lie_between_samples(void **)
{
    for (double m = 0.6; m < COUNT - 1.6; m += 0.13) {
        double values[COUNT], largest;
        for (int i = 0; i < COUNT; i++)
            values[i] = hill(i, m);
        const double at = bead_samples_maximum(values, COUNT, &largest);
        assert_true(fabs(at - m) < 1e-6); /* flat there */
        assert_close(largest, 10);
    }
    double largest, values[3] = {1, 3, 2};
    assert_close(bead_samples_maximum(values, 3, &largest), 1 + 0.5 / 3); /* of a parabola */
    assert_close(largest, 3 + 1.0 / 24);
    assert_true(isnan(bead_samples_maximum(values + 1, 2, &largest)) && largest == 3); /* at an end there is none */
    assert_true(isnan(bead_samples_maximum(values, 2, &largest)) && largest == 3);
    assert_true(isnan(bead_samples_maximum(values, 0, &largest)) && isnan(largest));
}

/* The next place, up or down from a sample above the level, where the curve falls below it. */
static void crossings_lie_between_samples(void **)
{
    for (double m = 6; m < 13; m += 0.17) {
        for (double level = -3; level < 9.7; level += 0.9) {
            double values[COUNT], low = m - 5, high = m, other_high = m + 5, other_low = m;
            for (int i = 0; i < COUNT; i++)
                values[i] = hill(i, m);
            for (int k = 0; k < 80; k++) { /* the crossings of the hill itself */
                const double left = (low + high) / 2, right = (other_low + other_high) / 2;
                *(hill(left, m) < level ? &low : &high) = left;
                *(hill(right, m) < level ? &other_high : &other_low) = right;
            }
            const size_t from = (size_t)lround(m);
            assert_close(bead_samples_crossing(values, COUNT, from, 1, level), other_low);
            assert_close(bead_samples_crossing(values, COUNT, from, -1, level), low);
            assert_true(isnan(bead_samples_crossing(values, COUNT, from, 1, -1000)));
            assert_true(isnan(bead_samples_crossing(values, COUNT, from, -1, -1000)));
        }
    }
    static const double steps[] = {5, 3, 1};
    assert_close(bead_samples_crossing(steps, 3, 0, 1, 2), 1.5);
    assert_close(bead_samples_crossing(steps, 3, 0, 1, 3), 1); /* still on it at the sample */
    assert_true(isnan(bead_samples_crossing(steps, 3, 2, 1, 2)) && isnan(bead_samples_crossing(steps, 3, 0, -1, 2)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(maxima_lie_between_samples),
                                       cmocka_unit_test(crossings_lie_between_samples)};
    return cmocka_run_group_tests_name("curves of measures", tests, NULL, NULL);
}
