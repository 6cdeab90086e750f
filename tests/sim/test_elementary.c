/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions and transforms with the same bits on every processor: they are right, and have these bits. */
#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "sim/base/elementary.h"
#include "sim/base/fingerprint.h"
#include "sim/base/wide.h"
#include "sim/equation/fourier.h"
#include "support.h"

static uint32_t random_bits(uint32_t *seed) /* xorshift: G. Marsaglia, J. Stat. Softw. 8 (2003), 14 */
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* From 2^-1000 to 2^1000, and near 1. */
static double number(uint32_t *seed, int i)
{
    const double part = 1 + random_bits(seed) * 0x1p-32;
    return i % 2 ? ldexp(part, (int)(random_bits(seed) % 2000) - 1000) : 0.75 * part;
}

static bool within(double x, bead_wide exact, double units)
{
    const double size = fabs((double)exact);
    return fabs((double)(x - exact)) <= units * (nextafter(size, INFINITY) - size);
}

static void functions_are_right(void **state)
{
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < 20000; i++) {
        const double x = number(&seed, i), root = sqrt(x), cube = bead_cbrt(x);
        assert_true(within(bead_log(x), BEAD_WIDE_NAME(log)(x), 2));
        assert_true(within(cube, BEAD_WIDE_NAME(cbrt)(x), 0.5));
        assert_true(within(bead_two_fifths(x), BEAD_WIDE_NAME(pow)(x, (bead_wide)2 / 5), 0.5));
        if (x < 0x1p600 && x > 0x1p-600)
            assert_true(within(bead_three_halves(x), x * (root + (x - (bead_wide)root * root) / (2 * root)), 0.5));
    }
}

/* Angles below a millionth, of some turns, and of 1e12 turns with what they have beyond a double. */
static void turns_are_right(void **state)
{
    (void)state;
    uint32_t seed = 5;
    for (int i = 0; i < 60000; i++) {
        static const double sizes[] = {1e-6, 1, 20, 1e5, 1e12};
        const double high = (random_bits(&seed) * 0x1p-31 - 1) * sizes[i % 5],
                     low = (random_bits(&seed) * 0x1p-31 - 1) * 0x1p-54 * high;
        double cosine, sine;
        bead_turn_to((struct bead_pair){high, low}, &cosine, &sine);
        const struct bead_turn exact = bead_turn_by((bead_wide)high + low);
        assert_true(fabs((double)(cosine - exact.re)) < 0x1p-53 && fabs((double)(sine - exact.im)) < 0x1p-53);
        assert_true(fabs(sine) > 1e-3 || fabs(high) > 1 || within(sine, exact.im, 2));
    }
    double cosine, sine;
    bead_turn_to((struct bead_pair){0, 0}, &cosine, &sine);
    assert_true(cosine == 1 && sine == 0);
}

static void products_of_pairs(void **state)
{
    (void)state;
    uint32_t seed = 6;
    for (int i = 0; i < 1000; i++) {
        const double high = number(&seed, 1), low = (random_bits(&seed) * 0x1p-31 - 1) * 0x1p-54 * high, b = number(&seed, 0);
        const struct bead_pair p = bead_pair_times((struct bead_pair){high, low}, b);
        const bead_wide exact = ((bead_wide)high + low) * b;
        if (high > 0x1p900 || high < 0x1p-900)
            continue;
        assert_true(bead_wide_abs((p.high - exact) + p.low) < 0x1p-100 * exact);
        assert_true(fabs(p.low) <= 0x1p-53 * p.high);
    }
}

static void ends_of_the_range(void **state)
{
    (void)state;
    assert_true(bead_log(1) == 0 && bead_log(0) == -INFINITY && isnan(bead_log(-1)) && bead_log(INFINITY) == INFINITY);
    assert_true(bead_cbrt(0) == 0 && bead_cbrt(27) == 3 && bead_cbrt(INFINITY) == INFINITY);
    assert_true(within(bead_cbrt(DBL_TRUE_MIN), BEAD_WIDE_NAME(cbrt)(DBL_TRUE_MIN), 0.5));
    assert_true(bead_two_fifths(0) == 0 && bead_two_fifths(32) == 4 && bead_two_fifths(INFINITY) == INFINITY);
    assert_true(within(bead_two_fifths(DBL_TRUE_MIN), BEAD_WIDE_NAME(pow)(DBL_TRUE_MIN, (bead_wide)2 / 5), 0.5));
    assert_true(bead_three_halves(0) == 0 && bead_three_halves(4) == 8 && bead_three_halves(1e-300) == 0);
    assert_true(bead_three_halves(1e300) == INFINITY);
}

/* By the definition, with turns of 113 bits. */
static void slow_bin(const double *x, size_t n, size_t k, bead_wide sum[2])
{
    sum[0] = sum[1] = 0;
    for (size_t j = 0; j < n; j++) {
        const struct bead_turn turn = bead_turn_by(-2 * bead_wide_pi * (j * k % n) / n);
        sum[0] += x[j] * turn.re;
        sum[1] += x[j] * turn.im;
    }
}

enum { LONGEST = 77 };

static void transforms_of_every_length(void **state)
{
    (void)state;
    uint32_t seed = 2;
    struct bead_message msg = {""};
    for (size_t n = 2; n <= LONGEST; n++) {
        struct bead_fourier *fourier;
        double x[LONGEST], back[LONGEST];
        struct bead_complex bins[LONGEST / 2 + 1];
        assert_int_equal(bead_fourier_create(n, NULL, &fourier, &msg), BEAD_OK);
        for (size_t j = 0; j < n; j++)
            x[j] = random_bits(&seed) * 0x1p-32 - 0.5;
        bead_fourier_forward(fourier, x, bins);
        for (size_t k = 0; k <= n / 2; k++) {
            bead_wide sum[2];
            slow_bin(x, n, k, sum);
            assert_near(bins[k].re, (double)sum[0], 4e-15);
            assert_near(bins[k].im, (double)sum[1], 4e-15);
        }
        bead_fourier_backward(fourier, bins, back);
        for (size_t j = 0; j < n; j++)
            assert_near(back[j], (double)n * x[j], 1e-15 * (double)(n * n));
        bead_fourier_destroy(fourier);
    }
}

/* Lengths that are taken four numbers at a time in every stage but, perhaps, the first, and others. */
static void instruction_sets_transform_to_the_same_bits(void **state)
{
    (void)state;
    static const size_t lengths[] = {2, 30, 128, 512, 720, 840, 1000, 1024, 1001};
    enum { MOST = 1024 };
    uint32_t seed = 4;
    struct bead_message msg = {""};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        double x[MOST], back[2][MOST];
        struct bead_complex bins[2][MOST / 2 + 1];
        for (size_t j = 0; j < lengths[i]; j++)
            x[j] = random_bits(&seed) * 0x1p-32 - 0.5;
        for (int portable = 0; portable < 2; portable++) {
            struct bead_fourier *fourier;
            assert_int_equal(bead_fourier_create(lengths[i], portable ? "portable" : NULL, &fourier, &msg), BEAD_OK);
            bead_fourier_forward(fourier, x, bins[portable]);
            bead_fourier_backward(fourier, bins[portable], back[portable]);
            bead_fourier_destroy(fourier);
        }
        assert_memory_equal(bins[0], bins[1], (lengths[i] / 2 + 1) * sizeof bins[0][0]);
        assert_memory_equal(back[0], back[1], lengths[i] * sizeof back[0][0]);
    }
}

/* The hash was made on x86-64; a processor that fuses multiplications and additions somewhere has another one. */
static void bits_are_the_same_everywhere(void **state)
{
    (void)state;
    enum { POINTS = 60 };
    uint32_t seed = 3;
    uint64_t hash = BEAD_FINGERPRINT_START;
    struct bead_message msg = {""};
    struct bead_fourier *fourier;
    double x[POINTS];
    struct bead_complex bins[POINTS / 2 + 1];
    assert_int_equal(bead_fourier_create(POINTS, NULL, &fourier, &msg), BEAD_OK);
    for (int i = 0; i < 2000; i++) {
        const double y = number(&seed, i);
        double cosine, sine;
        bead_turn_to((struct bead_pair){fmod(y, 1e6), 0}, &cosine, &sine);
        const double values[] = {bead_log(y),
                                 bead_cbrt(y),
                                 bead_three_halves(y),
                                 bead_exp(fmod(y, 700)),
                                 bead_pow(y, 0.4),
                                 bead_sin(fmod(y, 7)),
                                 bead_sech2(fmod(y, 30)),
                                 cosine,
                                 sine};
        hash = bead_fingerprint(hash, values, sizeof values);
        x[i % POINTS] = bead_log(y);
    }
    bead_fourier_forward(fourier, x, bins);
    hash = bead_fingerprint(hash, bins, sizeof bins);
    bead_fourier_destroy(fourier);
    if (hash != UINT64_C(0x8a2bcfe1db2e6f5b))
        fail_msg("the hash is %016" PRIx64, hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_are_right),
        cmocka_unit_test(turns_are_right),
        cmocka_unit_test(products_of_pairs),
        cmocka_unit_test(ends_of_the_range),
        cmocka_unit_test(transforms_of_every_length),
        cmocka_unit_test(instruction_sets_transform_to_the_same_bits),
        cmocka_unit_test(bits_are_the_same_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
