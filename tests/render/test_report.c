/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports: samples that read back, text that cannot break out of the page, and the parts of a page. */
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

#include "render/origin/origin.h"
#include "render/report/report_write.h"

/* What `write` writes, in a static buffer. */
#define WRITTEN(write)                                 \
    do {                                               \
        FILE *file = fmemopen(text, sizeof text, "w"); \
        assert_non_null(file);                         \
        struct bead_json json = REPORT_JSON(file);     \
        (void)json;                                    \
        write;                                         \
        fclose(file);                                  \
    } while (0)
static char text[4096];

static void html_is_escaped(void **state)
{
    (void)state;
    WRITTEN(bead_origin_escape("</title><script>a & 'b' \"c\"\x01\n\xc3\xa9", file));
    assert_string_equal(text, "&lt;/title&gt;&lt;script&gt;a &amp; &#39;b&#39; &quot;c&quot;\n\xc3\xa9");
}

static void strings_cannot_end_a_script(void **state)
{
    (void)state;
    WRITTEN(bead_json_text(&json, NULL, "</script><!-- \"a\\b\" \n\xc2\xb5"));
    assert_string_equal(text, "\"\\u003c/script\\u003e\\u003c!-- \\u0022a\\u005cb\\u0022 \\u000a\xc2\xb5\"");
}

static void numbers_are_json(void **state)
{
    (void)state;
    const double numbers[] = {0, -1.5, NAN, INFINITY, 1e-7};
    WRITTEN(bead_json_numbers(&json, NULL, numbers, 5));
    assert_string_equal(text, "[0, -1.5, null, null, 1e-07]");
}

/* RFC 4648, section 10. */
static void base64_as_in_the_standard(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"", ""},
                                           {"f", "Zg=="},
                                           {"fo", "Zm8="},
                                           {"foo", "Zm9v"},
                                           {"foob", "Zm9vYg=="},
                                           {"fooba", "Zm9vYmE="},
                                           {"foobar", "Zm9vYmFy"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        memset(text, 0, sizeof text);
        WRITTEN(report_base64(file, (const unsigned char *)pairs[i][0], strlen(pairs[i][0])));
        assert_string_equal(text, pairs[i][1]);
    }
}

static int digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = strchr(digits, c);
    return found && c ? (int)(found - digits) : 0;
}

/* The bytes of base64 text, of which there are enough. */
static void decode(const char *base64, unsigned char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *four = base64 + i / 3 * 4;
        unsigned word = (unsigned)(digit(four[0]) << 18 | digit(four[1]) << 12 | digit(four[2]) << 6 | digit(four[3]));
        bytes[i] = (unsigned char)(word >> (16 - 8 * (i % 3)));
    }
}

/* Written and read again, each is within half a step of what it was, and zero is zero. */
static void check_samples(const float *values, size_t count, bool has_sign)
{
    struct bead_message msg = {""};
    unsigned char bytes[64];
    WRITTEN(assert_int_equal(report_samples(&json, NULL, values, count, &msg), BEAD_OK));
    double step = strtod(strstr(text, "\"step\":") + 7, NULL), largest = 0;
    assert_true(strstr(text, has_sign ? "\"signed\": true" : "\"signed\": false") != NULL);
    decode(strstr(text, "\"data\": \"") + 9, bytes, 2 * count);
    for (size_t i = 0; i < count; i++) {
        unsigned whole = bytes[2 * i] | (unsigned)bytes[2 * i + 1] << 8;
        double value = step * (has_sign ? (double)(int16_t)whole : (double)whole);
        assert_true(fabs(value - (double)values[i]) <= 0.5000001 * step);
        assert_true(values[i] != 0 || value == 0);
        largest = fmax(largest, fabs((double)values[i]));
    }
    assert_true(step <= largest / 32766);
}

static void samples_read_back(void **state)
{
    (void)state;
    const float forces[] = {0, 84.3F, 0.001F, 12.5F, 0}, velocities[] = {0, -0.44F, 0.31F, -1e-6F, 0}, rest[] = {0, 0, 0};
    check_samples(forces, 5, false);
    check_samples(velocities, 5, true);
    check_samples(rest, 3, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(html_is_escaped),   cmocka_unit_test(strings_cannot_end_a_script),
        cmocka_unit_test(numbers_are_json),  cmocka_unit_test(base64_as_in_the_standard),
        cmocka_unit_test(samples_read_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
