/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: they read back as the same double, and no text with fewer digits does. */
#include "tests/support.h"

#include <float.h>

#include "sim/base/number.h"
#include "sim/base/random.h"
#include "sim/measure/sink_grid.h"

static const char *written(double value)
{
    static char text[64];
    FILE *file = fmemopen(text, sizeof text, "w");
    assert_non_null(file);
    bead_write_number(file, value);
    assert_int_equal(fclose(file), 0);
    return text;
}

static void texts_are_as_a_reader_expects_them(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},
                 {-0.0, "-0"},
                 {1e-6, "1e-06"},
                 {0.1, "0.1"},
                 {1.0 / 3, "0.3333333333333333"},
                 {0.1 + 0.2, "0.30000000000000004"},
                 {5, "5"},
                 {1e22, "1e+22"},
                 {2e-6 + 1e-6, "3e-06"},
                 {DBL_MAX, "1.7976931348623157e+308"},
                 {0x1p-1074, "5e-324"},
                 {0x1p-24, "5.960464477539063e-08"},
                 {-0x1p-44, "-5.684341886080802e-14"},
                 {0x1p53, "9007199254740992"},
                 {-NAN, "nan"},
                 {-INFINITY, "-inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(written(cases[i].value), cases[i].text);
}

/* From the first digit that is not 0 to the last. */
static int digits_of(const char *text)
{
    int digits = 0, sure = 0;
    for (; *text && *text != 'e'; text++) {
        digits += *text >= '0' && *text <= '9' && (digits > 0 || *text > '0');
        sure = *text > '0' && *text <= '9' ? digits : sure;
    }
    return sure;
}

/* The texts with one digit less next to the value on both sides. */
static void assert_shortest(double value)
{
    const char *text = written(value);
    if (strtod(text, NULL) != value)
        fail_msg("%s is not %a", text, value);
    for (int side = -1; side <= 1; side++) {
        char fewer[64];
        const double beside = side == 0 ? value : nextafter(value, side * INFINITY);
        snprintf(fewer, sizeof fewer, "%.*e", digits_of(text) > 1 ? digits_of(text) - 2 : 0, beside);
        if (digits_of(text) > 1 && strtod(fewer, NULL) == value)
            fail_msg("%s is longer than %s", text, fewer);
    }
}

static void no_shorter_text_reads_back(void **state)
{
    (void)state;
    for (int e = -1074; e < 1024; e++)
        assert_shortest(ldexp(1, e));
    for (uint64_t i = 0; i < 20000; i++) {
        uint64_t bits = bead_draw(2009, 0, i);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value))
            assert_shortest(value);
        assert_shortest((double)(bits >> 40) * 1e-9);
    }
}

/* Three digits above the value, of which the last is the least that is enough. */
static void errors_are_rounded_up(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{1e-6, "1.00e-06"},
                 {1.001, "1.01e+00"},
                 {8.432217097101848e-05, "8.44e-05"},
                 {9.991e-9, "1.00e-08"},
                 {3 * 1e-12, "3.00e-12"},
                 {0.5, "5.00e-01"},
                 {0, "0"},
                 {NAN, "nan"},
                 {INFINITY, "inf"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        FILE *file = tmpfile();
        char text[BEAD_NUMBER_ROOM] = "";
        assert_non_null(file);
        bead_write_uncertainty(file, cases[i].value);
        rewind(file);
        assert_non_null(fgets(text, sizeof text, file));
        assert_string_equal(text, cases[i].text);
        assert_int_equal(fclose(file), 0);
    }
}

static void times_have_the_prefix_of_their_size(void **state)
{
    (void)state;
    static const struct {
        double time;
        const char *unit, *text;
    } cases[] = {{0, "s", "0 s"},          {1.5, "s", "1.5 s"},         {1, "s", "1 s"},
                 {0.999, "s", "999 ms"},   {1e-3, "s", "1 ms"},         {3 * 1e-6, "s", "3 us"},
                 {0.99e-6, "s", "990 ns"}, {2.5e-12, "s", "0.0025 ns"}, {1e-6 / 3, "s", "333.3 ns"},
                 {0.25, "", "0.25"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[40] = "";
        bead_time_text(cases[i].time, cases[i].unit, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_as_a_reader_expects_them),
        cmocka_unit_test(no_shorter_text_reads_back),
        cmocka_unit_test(errors_are_rounded_up),
        cmocka_unit_test(times_have_the_prefix_of_their_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
