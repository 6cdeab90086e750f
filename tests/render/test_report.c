/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports: samples that read back, text that cannot break out of the page, and the parts of a page. */
#include <ctype.h>
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
#include "sessions.h"
#include "tests/pictures.h"

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

/* The JSON of a report's page, in which every bracket closes the one that was opened last. */
static char *data_of(const char *page)
{
    static const char head[] = "id=\"data\">";
    char stack[64], *data = strstr(page, head);
    int depth = 0;
    bool quoted = false;
    assert_non_null(data);
    data += strlen(head);
    *strstr(data, "</script>") = '\0';
    for (const char *c = data; *c; c++) {
        quoted ^= *c == '"';
        if (quoted || !strchr("{[]}", *c))
            continue;
        if (*c == '{' || *c == '[')
            stack[depth++] = *c == '{' ? '}' : ']';
        else
            assert_true(depth > 0 && stack[--depth] == *c);
        assert_true(depth < 64);
    }
    assert_true(depth == 0 && !quoted);
    return data;
}

/* The number that follows a name, NAN for null; `at` is behind it, and its comma. */
static double next_number(const char **at)
{
    char *end;
    *at += strspn(*at, " ,[");
    const bool null = strncmp(*at, "null", 4) == 0;
    const double number = null ? NAN : strtod(*at, &end);
    *at = null ? *at + 4 : end;
    return number;
}

static const char *after(const char *data, const char *name)
{
    const char *found = strstr(data, name);
    if (!found)
        fail_msg("no %s", name);
    return found + strlen(name);
}

/* Is `word`, of `length` characters, in `text` as a word? */
static bool has_word(const char *among, const char *before, const char *word, size_t length)
{
    const size_t lead = strlen(before);
    for (const char *at = among; (at = strstr(at, before)) != NULL; at += lead) {
        if (strncmp(at + lead, word, length) == 0 && !isalnum((unsigned char)at[lead + length]) && at[lead + length] != '_')
            return true;
    }
    return false;
}

/* A page has all of a file of assets/report but its licence, with something where the file has {{a name}}. */
static void assert_filled(const char *page, const char *file)
{
    char path[600];
    size_t length;
    snprintf(path, sizeof path, "%s/report/%s", getenv("BEADREEL_ASSETS"), file);
    char *whole = read_all(path, &length), *piece = strchr(whole, '\n') + 1;
    for (char *end = piece; end; piece = end) {
        end = strstr(piece, "{{");
        if (end)
            *end = '\0';
        page = strstr(page, piece);
        if (!page)
            fail_msg("%s: '%.60s' is not in the page, or not behind what is before it", file, piece);
        page += strlen(piece);
        end = end ? strstr(end + 1, "}}") + 2 : NULL;
    }
    if (strcmp(file, "page.html") == 0)
        assert_string_equal(page, "");
    free(whole);
}

/* The data of a page have all these keys and no others, and its scripts read each of them. */
static void assert_keys(const char *page, const char *keys)
{
    const char *data = strstr(page, "id=\"data\">"), *end = strstr(data, "</script>");
    for (const char *at = data; (at = strstr(at, "\":")) != NULL && at < end; at++) {
        const char *key = at;
        while (key[-1] != '"')
            key--;
        const size_t length = (size_t)(at - key);
        if (!has_word(keys, " ", key, length))
            fail_msg("'%.*s' is new", (int)length, key);
        if (!has_word(end, ".", key, length))
            fail_msg("no script reads '%.*s'", (int)length, key);
    }
    for (const char *key = keys + 1; *key; key += strcspn(key, " ") + 1) {
        if (!has_word(data, "\"", key, strcspn(key, " ")))
            fail_msg("'%.*s' is not in the data", (int)strcspn(key, " "), key);
    }
}

/* Peaks are those of the table, but for contacts that have met no force, which have none. Samples: as many as a page has room for.
 */
static void pages_hold_their_run(void **state)
{
    (void)state;
    char scene[512], output[512], path[512];
    size_t length;
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    write_text(scene,
               "chain: {striker: {bead: large-steel, velocity: 0.4 m/s}, wall: brass, beads: [{bead: large-steel, count: 6}, "
               "{bead: ptfe, sensor: s}, {cell: [large-steel, ptfe], count: 4}]}\n"
               "simulate: {until: 60 us}\noutputs: [{report: a.html}, {table: p.csv, show: peaks}]\n");
    play_counts((struct bead_job){.input = scene, .output = output});
    in_directory("a.html", path, sizeof path);
    char *page = read_all(path, &length);
    assert_keys(page,
                " program title time start every count unit held field name contacts range low high rest scale over under maps "
                "light dark magnify materials colour chains label tale first values firstBead beads total axis counts spacing "
                "radius position material sensors bead striker magnetism wall run method end arrival step energyError "
                "embeddedError eventError measures value uncertainty note peaks force open time_uncertainty signed data "
                "displacement ");
    static const char *const files[] = {"page.html", "report.css", "run.html", "data.js", "axes.js", "chain.js",
                                        "chart.js",  "page.js",    "save.js",  "run.js",  "start.js"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        assert_filled(page, files[i]);
    const char *data = data_of(page), *peaks = after(data, "\"peaks\": {"), *force = after(peaks, "\"force\": "),
               *time = after(peaks, "\"time\": "), *every = after(data, "\"every\": "), *count = after(data, "\"count\": ");
    assert_true(next_number(&count) == 1201);
    assert_true(fabs(next_number(&every) / (60e-6 / 1200) - 1) < 1e-9);
    in_directory("p.csv", path, sizeof path);
    char *table = read_all(path, &length);
    size_t contacts = 0, without = 0;
    for (const char *row = strchr(table, '\n') + 1; *row; row = strchr(row, '\n') + 1, contacts++) {
        char *end;
        const double expected = strtod(strchr(row, ',') + 1, &end), when = strtod(end + 1, NULL), found = next_number(&force),
                     then = next_number(&time);
        assert_true(isnan(when) ? isnan(found) && isnan(then) : fabs(found - expected) <= 1e-11 * expected);
        assert_true(isnan(when) || fabs(then - when) <= 1e-11 * when);
        without += isnan(when);
    }
    assert_true(contacts == 16 && without > 0 && without < 12 && *force == ']' && *time == ']');
    free(table);
    free(page);
}

/* With more beads, of all chains together, fewer times have room: 1.2 MB, of two bytes a number, forces and places of beads. */
static void pages_have_room_for_all_chains(void **)
{
    char scene[512], output[512], path[512];
    size_t length;
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    in_directory("a.html", path, sizeof path);
    snprintf(text, sizeof text,
             "chains:\n  - {name: a, beads: [{bead: ptfe, count: 199}]}\n  - {name: b, beads: [{bead: ptfe, count: 299}]}\n"
             "simulate: {until: 1 us}\noutputs: [{report: a.html}]\n");
    write_text(scene, text);
    play_counts((struct bead_job){.input = scene, .output = output});
    char *page = read_all(path, &length);
    const char *count = after(data_of(page), "\"count\": ");
    const double found = next_number(&count);
    if (found != floor(1.2e6 / (2 * 2 * (200 + 300))))
        fail_msg("%g times", found);
    free(page);
}

/* The grid of samples of a page, in microseconds. */
static void assert_times(const char *input, const char *const *settings, double start, double every, double count)
{
    char output[512];
    size_t length, setting_count = 0;
    in_directory("a.html", output, sizeof output);
    while (settings[setting_count])
        setting_count++;
    play_counts((struct bead_job){.input = input, .output = output, .settings = settings, .setting_count = setting_count});
    char *page = read_all(output, &length);
    const char *data = data_of(page), *at = after(data, "\"start\": "), *step = after(data, "\"every\": "),
               *number = after(data, "\"count\": ");
    const double found[] = {1e6 * next_number(&at), 1e6 * next_number(&step), next_number(&number)};
    if (!(fabs(found[0] - start) < 1e-6 && fabs(found[1] - every) < 1e-6 && found[2] == count))
        fail_msg("%s, %s: %g samples, every %g from %g on", settings[0], settings[1], found[2], found[1], found[0]);
    free(page);
}

/* Pages show the time asked for, in as many samples as there is room for, or as asked; of stored runs every sample, every second
 * one, and so on, from the first one within that time to the last. */
static void pages_show_the_time_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *settings[3];
        double computed[3], stored[3]; /* start, every, count */
    } cases[] = {{{"outputs.0.time=auto", NULL}, {0, 0.05, 1201}, {0, 2, 31}},
                 {{"outputs.0.time=[12 us, auto]", NULL}, {12, 0.04, 1201}, {12, 2, 25}},
                 {{"outputs.0.time=[13 us, 37 us]", NULL}, {13, 0.02, 1201}, {14, 2, 12}},
                 {{"outputs.0.time=[13 us, 36 us]", "outputs.0.every=2.3 us", NULL}, {13, 2.3, 11}, {14, 4, 6}},
                 {{"outputs.0.every=6 us", NULL}, {0, 6, 11}, {0, 6, 11}}};
    char scene[512], output[512], run[512];
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    in_directory("run.h5", run, sizeof run);
    write_text(scene, "chain: {striker: {velocity: 0.4 m/s}, beads: [{bead: large-steel, count: 6}]}\nsimulate: {until: 60 us}\n"
                      "outputs: [{report: a.html}, {trajectory: run.h5, every: 2 us}]\n");
    play_counts((struct bead_job){.input = scene, .output = output});
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double *c = cases[i].computed, *s = cases[i].stored;
        assert_times(scene, cases[i].settings, c[0], c[1], c[2]);
        assert_times(run, cases[i].settings, s[0], s[1], s[2]);
    }
}

/* What the page says of a sweep of two cells: with the clean chain, three configurations. */
static void assert_facts(const char *data)
{
    static const char *const facts[] = {"\"field\": {\"title\": \"bead force\", \"name\": \"force\", \"unit\": \"N\"",
                                        "\"configurations\": 3,",
                                        "\"cells\": 2,",
                                        "\"places\": [{\"name\": \"",
                                        "\"magnetism\": 1,",
                                        "\"spins\": \"11\"",
                                        "\"low\": 0,"};
    for (size_t i = 0; i < sizeof facts / sizeof *facts; i++) {
        if (!strstr(data, facts[i]))
            fail_msg("%s is not in %.3000s", facts[i], data);
    }
    char places[64];
    const char *values = strstr(data, "\"places\": ");
    values = strstr(values + 1, "\"places\": "); /* the first are those of forces */
    const int count = values ? atoi(strstr(values, ": ") + 2) : 0;
    assert_true(count > 4);
    snprintf(places, sizeof places, "\"places\": %d, \"values\": %d", count, count);
    assert_non_null(strstr(data, places)); /* one for each bead */
}

/* The page of a sweep: its range ends with the largest force of its images, which has the last colour, and little else has. */
static void colours_of_sweeps_reach_their_ends(void **state)
{
    (void)state;
    static unsigned char bytes[1 << 20];
    char scene[512], output[512], path[512];
    size_t length, images = 0, lit = 0, full = 0;
    in_directory("scene.yaml", scene, sizeof scene);
    in_directory("", output, sizeof output);
    write_text(scene, "sweep: {cells: 2, magnetism: [0, 1], configurations: 2}\noutputs: [{report: s.html}]\n");
    play_counts((struct bead_job){.input = scene, .output = output});
    in_directory("s.html", path, sizeof path);
    char *page = read_all(path, &length);
    assert_keys(page,
                " program title end times field name unit contacts range low high rest scale over under maps light dark panels "
                "configurations cells places clean rows values indices images index magnetism spins data ");
    static const char *const files[] = {"page.html", "report.css", "sweep.html", "data.js", "axes.js",
                                        "chart.js",  "page.js",    "save.js",    "sweep.js"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        assert_filled(page, files[i]);
    const char *data = data_of(page);
    assert_facts(data);
    for (const char *at = data; (at = strstr(at, "\"data\": \"")) != NULL; images++) {
        at += strlen("\"data\": \"");
        const size_t base64 = strcspn(at, "\""), count = base64 / 4 * 3 - (at[base64 - 1] == '=') - (at[base64 - 2] == '=');
        assert_true(count < sizeof bytes);
        decode(at, bytes, count);
        for (size_t i = 0; i + 1 < count;) { /* rows: how many, and their colours */
            const size_t row = bytes[i] | (size_t)bytes[i + 1] << 8;
            i += 2;
            for (size_t k = 0; k < row; k++)
                full += bytes[i + k] == 255;
            lit += row;
            assert_true(row == 0 || bytes[i + row - 1] > 0); /* the last is none of rest */
            i += row;
        }
    }
    assert_int_equal(images, 4); /* of each, and their mean */
    assert_true(full > 0 && 50 * full < lit);
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(html_is_escaped),
        cmocka_unit_test(strings_cannot_end_a_script),
        cmocka_unit_test(numbers_are_json),
        cmocka_unit_test(base64_as_in_the_standard),
        cmocka_unit_test(samples_read_back),
        cmocka_unit_test(pages_hold_their_run),
        cmocka_unit_test(pages_have_room_for_all_chains),
        cmocka_unit_test(pages_show_the_time_asked_for),
        cmocka_unit_test(colours_of_sweeps_reach_their_ends),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
