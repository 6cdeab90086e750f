/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PDF files with their update: every object is where the tables say, streams are as long as they say, and what a viewer follows
 * from the end leads to the scene and to the words for those who cannot see. By ISO 32000-1, 7.5. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sessions.h"
#include "tests/pictures.h"

static const char scene[] = "title: A wave\nchain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, "
                            "count: 6}]}\nsimulate: {until: 0.1 ms}\noutputs: [{image: a.pdf}, {plot: b.pdf, show: peaks}]\n";

static const char *after(const char *text, const char *words)
{
    const char *found = strstr(text, words);
    if (!found)
        fail_msg("no '%s' in '%.200s'", words, text);
    return found + strlen(words);
}

/* The objects that a table lists are at their places; returns the number of them. */
static size_t follow_table(const char *pdf, size_t length, size_t at)
{
    size_t listed = 0;
    assert_true(at < length && !strncmp(pdf + at, "xref\n", 5));
    const char *line = pdf + at + 5;
    while (strncmp(line, "trailer", 7) != 0) {
        char *end;
        const long first = strtol(line, &end, 10), count = strtol(end, &end, 10);
        assert_true(*end++ == '\n');
        for (long n = first; n < first + count; n++, end += 20, listed++) {
            char head[32];
            const size_t place = strtoul(end, NULL, 10);
            assert_true(end[10] == ' ' && end[16] == ' ' && (end[17] == 'n' || end[17] == 'f'));
            if (end[17] == 'f')
                continue;
            snprintf(head, sizeof head, "%ld 0 obj\n", n);
            if (place >= length || strncmp(pdf + place, head, strlen(head)) != 0)
                fail_msg("object %ld is not at %zu, but '%.20s'", n, place, pdf + place);
        }
        line = end;
    }
    return listed;
}

static void check(const char *name)
{
    char path[512], text[40];
    size_t length;
    in_directory(name, path, sizeof path);
    char *pdf = read_all(path, &length);
    for (size_t i = 0; i < length; i++) /* as text: what streams hold does not matter */
        pdf[i] = pdf[i] ? pdf[i] : ' ';
    const char *last = NULL;
    for (const char *at = pdf; (at = strstr(at, "startxref\n")); at++)
        last = at + strlen("startxref\n");
    char *end;
    assert_non_null(last);
    const size_t table = strtoul(last, &end, 10);
    assert_string_equal(end, "\n%%EOF\n");
    assert_int_equal(follow_table(pdf, length, table), 4);
    const char *trailer = after(pdf + table, "trailer\n"), *size = after(trailer, "/Size ");
    const size_t before = follow_table(pdf, length, strtoul(after(trailer, "/Prev "), NULL, 10));
    assert_int_equal(strtoul(size, NULL, 10), before + 2); /* two of its objects are new */
    /* From the catalogue to the file within, as long as it says. */
    snprintf(text, sizeof text, "\n%ld 0 obj\n", strtol(after(trailer, "/Root "), NULL, 10));
    const char *root = NULL;
    for (const char *at = pdf; (at = strstr(at, text)); at++)
        root = at;
    assert_non_null(root);
    assert_true(after(root, "/Lang (en)") < strstr(root, "endobj") && after(root, "/Marked true") < strstr(root, "endobj"));
    snprintf(text, sizeof text, "\n%ld 0 obj\n", strtol(after(root, "[(scene.yaml) "), NULL, 10));
    snprintf(text, sizeof text, "\n%ld 0 obj\n", strtol(after(after(pdf, text), "/EF << /F "), NULL, 10));
    const char *stored = after(after(pdf, text), "/Length ");
    const size_t bytes = strtoul(stored, NULL, 10);
    const char *begins = after(stored, "stream\n");
    assert_true(!strncmp(begins + bytes, "\nendstream\nendobj\n", 18));
    assert_true(strstr(begins, scene) && strstr(begins, scene) + strlen(scene) <= begins + bytes);
    assert_true(!strncmp(begins, "# ", 2));
    /* The figure of the page has the words of the description of the file. */
    const char *figure = NULL;
    for (const char *at = pdf; (at = strstr(at, "/S /Figure\n")); at++)
        figure = at;
    assert_non_null(figure);
    const char *subject = after(pdf, "/Subject "), *alternative = after(figure, "/Alt ");
    const size_t line = strcspn(subject, "\n");
    assert_true(line > 20 && !strncmp(subject, alternative, line) && alternative[line] == '\n');
    free(pdf);
}

static void files_can_be_followed_from_their_end(void **)
{
    char path[512], out[512];
    in_directory("scene.yaml", path, sizeof path);
    in_directory("", out, sizeof out);
    write_text(path, scene);
    play_counts((struct bead_job){.input = path, .output = out, .threads = 1});
    check("a.pdf");
    check("b.pdf");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(files_can_be_followed_from_their_end)};
    return cmocka_run_group_tests_name("PDF", tests, make_directory, remove_directory);
}
