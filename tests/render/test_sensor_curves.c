/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves in bounded memory: of each short stretch of time the first, the smallest, the largest and the last point, each once, in
 * the order of time, of samples as dense or as far apart as may be. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/view/sensor_curves.h"

enum { CURVES = 3, SAMPLES = 3000, STRETCHES = 4096 };
static double moment[SAMPLES], values[SAMPLES][CURVES];

static double any(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 40) / 0x1p24;
}

static bool is_sample(const struct bead_point *p, size_t from, size_t to, size_t curve)
{
    for (size_t i = from; i < to; i++) {
        if (moment[i] == p->time && values[i][curve] == p->value)
            return true;
    }
    return false;
}

/* Samples from `from` up to `to` are one stretch. */
static void assert_stretch(const struct bead_curves *curves, size_t stretch, size_t from, size_t to)
{
    for (size_t c = 0; c < CURVES; c++) {
        struct bead_point points[4];
        const size_t count = bead_curves_points(curves, stretch, c, points);
        double low = INFINITY, high = -INFINITY, least = INFINITY, most = -INFINITY;
        for (size_t i = from; i < to; i++)
            low = fmin(low, values[i][c]), high = fmax(high, values[i][c]);
        assert_true(count >= 1 && count <= (to - from < 4 ? to - from : 4));
        assert_true(points[0].time == moment[from] && points[count - 1].time == moment[to - 1]);
        for (size_t i = 0; i < count; i++) {
            assert_true((i == 0 || points[i].time > points[i - 1].time) && is_sample(&points[i], from, to, c));
            least = fmin(least, points[i].value), most = fmax(most, points[i].value);
        }
        assert_true(least == low && most == high);
    }
}

static void curves_keep_what_is_seen(void **)
{
    uint64_t state = 1;
    const double ends[2] = {-1e-3, 3e-3}, length = (ends[1] - ends[0]) / STRETCHES;
    for (int spacing = 0; spacing < 5; spacing++) { /* from many in a stretch to one in several; in the last the same values */
        struct bead_curves curves;
        double least = INFINITY, most = -INFINITY;
        bead_curves_init(&curves, CURVES, ends);
        for (size_t i = 0; i < SAMPLES; i++) {
            moment[i] = i ? moment[i - 1] + length * any(&state) * pow(4, spacing % 4 - 3) : ends[0];
            for (size_t c = 0; c < CURVES; c++) {
                values[i][c] = spacing == 4 ? 5 : c == 0 ? (double)i : c == 1 ? -(double)i : any(&state) - 0.5;
                least = fmin(least, values[i][c]), most = fmax(most, values[i][c]);
            }
            assert_int_equal(bead_curves_reserve(&curves, NULL), BEAD_OK);
            bead_curves_add(&curves, moment[i], values[i]);
        }
        size_t stretch = 0;
        for (size_t from = 0, to; from < SAMPLES; from = to, stretch++) {
            const double slot = floor((moment[from] - ends[0]) / (ends[1] - ends[0]) * STRETCHES);
            for (to = from + 1; to < SAMPLES && floor((moment[to] - ends[0]) / (ends[1] - ends[0]) * STRETCHES) == slot;)
                to++;
            assert_true(stretch < curves.count);
            assert_stretch(&curves, stretch, from, to);
        }
        assert_int_equal(stretch, curves.count);
        assert_true(curves.low == least && curves.high == most);
        bead_curves_free(&curves);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(curves_keep_what_is_seen)};
    return cmocka_run_group_tests_name("curves of sensors", tests, NULL, NULL);
}
