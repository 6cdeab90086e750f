/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text: they read back as the same double, and no text with fewer digits does. Texts in JSON and on a terminal. */
#include "tests/support.h"

#include <float.h>

#include "sim/base/json.h"
#include "sim/base/number.h"
#include "sim/base/random.h"
#include "sim/base/text.h"
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

/* Bytes of the character of UTF-8 that `text` begins with, by its number: the shortest form of U+0080..U+10FFFF but surrogates. */
static size_t bytes_of(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const size_t n = c[0] < 0x80 ? 1 : c[0] < 0xC0 ? 0 : c[0] < 0xE0 ? 2 : c[0] < 0xF0 ? 3 : c[0] < 0xF8 ? 4 : 0;
    uint32_t number = n > 1 ? c[0] & (0xFFu >> (n + 1)) : c[0];
    for (size_t i = 1; i < n; i++) {
        if ((c[i] & 0xC0) != 0x80)
            return 0;
        number = number << 6 | (c[i] & 0x3F);
    }
    return n > 0 && number >= least[n] && number <= 0x10FFFF && (number < 0xD800 || number > 0xDFFF) ? n : 0;
}

static void texts_in_json_are_valid(void **state)
{
    (void)state;
    static const unsigned char second[] = {0x61, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0}, more[] = {0x62, 0x80, 0xBF, 0xC2};
    char *found = NULL, expected[80];
    size_t size;
    FILE *out = open_memstream(&found, &size);
    for (unsigned i = 0; i < 128 * 8 * 4 * 4; i++) {
        const char text[] = {(char)(128 + i / 128), (char)second[i / 16 % 8], (char)more[i / 4 % 4], (char)more[i % 4], 'x', 0};
        struct bead_json json = {.out = out};
        char *to = expected;
        *to++ = '"';
        for (const char *c = text; *c;) {
            const size_t bytes = bytes_of(c);
            to += sprintf(to, "%.*s", bytes ? (int)bytes : 6, bytes ? c : "\\ufffd");
            c += bytes ? bytes : 1;
        }
        strcpy(to, "\"");
        rewind(out);
        bead_json_text(&json, NULL, text);
        fputc(0, out);
        fflush(out);
        assert_string_equal(found, expected);
    }
    for (int c = 1; c < 0x80; c++) { /* only what must be is written as a number */
        const bool plain = c >= ' ' && c != '"' && c != '\\' && c != 0x7F;
        struct bead_json json = {.out = out};
        snprintf(expected, sizeof expected, plain ? "\"%c\"" : "\"\\u%04x\"", c);
        rewind(out);
        bead_json_text(&json, NULL, (char[]){(char)c, 0});
        fputc(0, out);
        fflush(out);
        assert_string_equal(found, expected);
    }
    fclose(out);
    free(found);
}

static void json_is_nested(void **state)
{
    (void)state;
    static const double numbers[] = {1.5, NAN, -INFINITY, 1. / 3};
    static const char *const texts[] = {"a", "<b>&\"\\", NULL};
    for (int style = 0; style < 3; style++) {
        char *found = NULL;
        size_t size;
        struct bead_json json = {
            .out = open_memstream(&found, &size), .lines = style == 1, .html = style == 2, .digits = style == 2 ? 3 : 0};
        bead_json_open(&json, NULL, '{');
        bead_json_texts(&json, "t", texts);
        bead_json_open(&json, "o", '{');
        bead_json_flag(&json, "f", false);
        bead_json_null(&json, "n");
        bead_json_text(&json, "m", NULL);
        bead_json_open(&json, "e", '[');
        bead_json_close(&json, "]}");
        bead_json_numbers(&json, "x", numbers, 4);
        bead_json_close(&json, "}");
        fclose(json.out);
        assert_string_equal(
            found, style == 0
                       ? "{\"t\": [\"a\", \"<b>&\\u0022\\u005c\"], \"o\": {\"f\": false, \"n\": null, \"m\": null, \"e\": []}, "
                         "\"x\": [1.5, null, null, 0.3333333333333333]}"
                   : style == 1 ? "{\n \"t\": [\n  \"a\",\n  \"<b>&\\u0022\\u005c\"\n ],\n \"o\": {\n  \"f\": false,\n  \"n\": "
                                  "null,\n  \"m\": null,\n"
                                  "  \"e\": []\n },\n \"x\": [\n  1.5,\n  null,\n  null,\n  0.3333333333333333\n ]\n}"
                                : "{\"t\": [\"a\", \"\\u003cb\\u003e\\u0026\\u0022\\u005c\"], \"o\": {\"f\": false, \"n\": null, "
                                  "\"m\": null, \"e\": []}, "
                                  "\"x\": [1.5, null, null, 0.333]}");
        free(found);
    }
}

/* What is opened and not closed turns the text behind it: embeddings by PDF, isolates, with all within, by PDI (UAX 9). */
static void turns_are_closed(void **state)
{
    (void)state;
#define RLE "\u202b"
#define RLO "\u202e"
#define PDF "\u202c"
#define RLI "\u2067"
#define PDI "\u2069"
    static const char *const open[] = {"a" RLE "b", RLO,     RLI "a" PDF, RLE RLI PDF PDI,
                                       RLE RLE PDF, RLE PDI, RLI RLI PDI, RLI RLE PDF},
                             *const closed[] = {"",
                                                "a" RLE "b" PDF,
                                                RLI RLO PDI,
                                                PDF PDI,
                                                RLE RLI PDF PDI PDF,
                                                RLI RLE RLO PDI,
                                                RLI RLI RLE PDI PDI,
                                                "\u2066\u202a\u202d" PDF PDF PDI,
                                                ("\u2068" PDI),
                                                "\u2028"};
    for (size_t i = 0; i < sizeof open / sizeof *open; i++)
        assert_true(bead_text_turns(open[i]));
    for (size_t i = 0; i < sizeof closed / sizeof *closed; i++)
        assert_false(bead_text_turns(closed[i]));
}

/* No control characters, and no part of a character where it is cut. */
static void shown_texts_are_cut_between_characters(void **state)
{
    (void)state;
    static const struct {
        const char *text, *shown;
    } cases[] = {{"abc", "abc"},          {"abcd", "abcd"},         {"abcde", "abcd..."},
                 {"abc\u00b5", "abc..."}, {"ab\u00b5", "ab\u00b5"}, {"ab\u00b5d", "ab\u00b5..."},
                 {"a\tb\x7f", "a b "},    {"a\u202eb", "a b"},      {"\u20ac\u20ac", "\u20ac..."},
                 {"\xc2\x85\u061c", "  "}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char shown[8];
        assert_string_equal(bead_text_show(cases[i].text, shown, sizeof shown), cases[i].shown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_as_a_reader_expects_them),
        cmocka_unit_test(no_shorter_text_reads_back),
        cmocka_unit_test(errors_are_rounded_up),
        cmocka_unit_test(times_have_the_prefix_of_their_size),
        cmocka_unit_test(texts_in_json_are_valid),
        cmocka_unit_test(json_is_nested),
        cmocka_unit_test(turns_are_closed),
        cmocka_unit_test(shown_texts_are_cut_between_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
