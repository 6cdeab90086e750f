/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A table of a stored run is, byte for byte, the one made beside it, also of a part of its beads and times; and a table of some
 * columns, rows or times has those of the whole one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "beadreel/render.h"
#include "sessions.h"
#include "tests/scratch.h"

enum { OUTPUTS_MOST = 24, BYTES_MOST = 1 << 18, COLUMNS_MOST = 64, ROWS_MOST = 400 };

#define PRESSED                                                                                                                 \
    "chains:\n  - {name: A, striker: {velocity: 1 m/s}, precompression: 1 N, wall: brass, beads: [{cell: [large-steel, "        \
    "aluminium], count: 5}, {bead: ptfe, sensor: s}, {bead: small-steel, count: 4}]}\n  - {name: B, striker: {velocity: 2 "     \
    "m/s}, precompression: 2 N, wall: rigid, beads: [{bead: brass, count: 9}, {bead: ptfe, sensor: s}]}\nsimulate: {until: 99 " \
    "us}\n"
#define DAMPED                                                                                                                  \
    "chain: {wall: rigid, damping: {coefficient: 2, exponent: 1.5}, beads: [{bead: brass, count: 6}, {bead: ptfe, sensor: s}, " \
    "{bead: large-steel, count: 4}]}\nsimulate: {until: 120 us}\n"
#define STRING "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 20}\n"
#define WAVE                                                                                                                  \
    "chain: {equation: shock, points: 60, epsilon: 0.5, length: 6.283, start: {simple-wave: 1, amplitude: 0.5}}\nsimulate: {" \
    "until: 3}\n"
#define SOLITONS                                                                                                              \
    "chain: {equation: kdv, low: -12, length: 34, points: 160, start: {solitons: [{speed: 9, at: -8}, {speed: 4, at: 0}]}}\n" \
    "simulate: {until: 0.08}\n"

static const struct {
    const char *scene, *trajectory, *outputs[OUTPUTS_MOST]; /* without their files */
} runs[] = {
    {PRESSED,
     "every: 1.5 us, fields: all",
     {"show: sensors", "show: sensors, field: velocity, beads: [2, 5]", "show: sensors, contacts: [0, 3, 9], beads: [4]",
      "show: sensors, every: 3 us", "show: sensors, time: [30 us, 60 us]", "show: extremes", "show: extremes, field: velocity",
      "show: extremes, field: compression, time: [15 us, 60 us]", "show: spreading, every: 1.5 us", "show: spectrum, every: 3 us",
      "show: spectrum, beads: [3], field: velocity, window: none, every: 1.5 us, segment: 30 us", "show: dispersion, every: 3 us",
      "show: spectrogram, beads: [3], every: 1.5 us, segment: 45 us", "show: measures, every: 1.5 us",
      "show: profiles, at: [19.5 us, 33 us, 99 us]", "show: profiles, at: [45 us], field: displacement", "show: bands",
      "show: eigenmodes", "show: chain"}},
    {PRESSED,
     "every: 1 us, fields: [displacement, velocity]",
     {"show: sensors", "show: extremes, field: contact-force", "show: sensors, field: compression, contacts: [2, 5]",
      "show: profiles, at: [20 us], field: contact-force", "show: spectrum, every: 2 us"}},
    {PRESSED,
     "every: 1.5 us, fields: all, beads: [2, 10], time: [15 us, 90 us]",
     {"show: sensors, beads: [2, 6, 10], every: 1.5 us, time: [15 us, 90 us]",
      "show: sensors, contacts: [2, 9], every: 1.5 us, time: [30 us, 75 us]",
      "show: sensors, every: 3 us, field: velocity, beads: [5], time: [15 us, 90 us]"}},
    {DAMPED,
     "every: 1.5 us, fields: all",
     {"show: sensors", "show: sensors, field: compression, contacts: [2, 5]", "show: extremes, field: energy",
      "show: measures, every: 1.5 us", "show: spreading, every: 1.5 us", "show: profiles, at: [60 us], field: contact-force"}},
    {STRING,
     "every: 0.25, fields: all",
     {"show: modes", "show: modes, modes: 3, time: [5, 15]", "show: sensors, beads: [3]", "show: extremes, field: strain",
      "show: profiles, at: [3.25, 7.5], field: velocity"}},
    {WAVE,
     "every: 0.05, fields: all",
     {"show: sensors, beads: [20, 40]", "show: sensors, beads: [20], field: velocity, every: 0.1", "show: extremes, field: energy",
      "show: profiles, at: [0.5, 1.25]"}},
    {SOLITONS,
     "every: 0.001, fields: all",
     {"show: sensors, beads: [20, 40], field: displacement", "show: extremes, field: displacement",
      "show: profiles, at: [0.012, 0.05], field: displacement"}},
};

static size_t read_file(const char *folder, const char *name, char *bytes)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s/%s", directory, folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, BYTES_MOST, file);
    fclose(file);
    if (count < 20 || count >= BYTES_MOST)
        fail_msg("%zu bytes in %s", count, path);
    bytes[count] = '\0';
    return count;
}

/* Measures of the last sample have its time as their note, those of the end of a run have none. */
static void drop_notes(char *bytes)
{
    for (char *at = bytes; (at = strstr(at, ",at ")); at++)
        memmove(at + 1, at + strcspn(at, "\n"), strlen(at + strcspn(at, "\n")) + 1);
}

/* All outputs of a run, which are tables 0.csv, 1.csv, ... and a trajectory, if there is one, into a folder. */
static void play(const char *scene, const char *trajectory, const char *const *outputs, const char *folder)
{
    char text[6000], path[600], out[600];
    int used = snprintf(text, sizeof text, "%soutputs:\n", scene);
    if (trajectory)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {trajectory: run.h5, %s}\n", trajectory);
    for (size_t i = 0; i < OUTPUTS_MOST && outputs[i]; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, %s%s}\n", i, outputs[i],
                         strstr(outputs[i], "bands") || strstr(outputs[i], "eigenm") || strstr(outputs[i], "show: chain")
                             ? ""
                             : ", uncertainty: false");
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/%s", directory, folder);
    mkdir(out, 0777);
    write_text(path, text);
    play_counts((struct bead_job){.input = path, .output = out, .threads = 1});
}

static void stored_runs_say_the_same(void **)
{
    static char beside[BYTES_MOST], later[BYTES_MOST];
    char run[600], out[600], name[20];
    snprintf(run, sizeof run, "%s/all/run.h5", directory);
    snprintf(out, sizeof out, "%s/one", directory);
    mkdir(out, 0777);
    for (size_t r = 0; r < sizeof runs / sizeof *runs; r++) {
        play(runs[r].scene, runs[r].trajectory, runs[r].outputs, "all");
        for (size_t i = 0; i < OUTPUTS_MOST && runs[r].outputs[i]; i++) {
            snprintf(name, sizeof name, "%zu.csv", i);
            snprintf(out, sizeof out, "%s/one/%s", directory, name);
            play_counts((struct bead_job){.input = run, .output = out, .threads = 2});
            read_file("all", name, beside);
            read_file("one", name, later);
            drop_notes(beside);
            drop_notes(later);
            if (strcmp(beside, later) != 0)
                fail_msg("run %zu: '%s' of the stored run is not that beside it", r, runs[r].outputs[i]);
        }
    }
}

/* A table of numbers: a row of names, and lines of cells. */
struct lines {
    char *cell[ROWS_MOST][COLUMNS_MOST];
    size_t rows, columns;
};

static void split(char *bytes, struct lines *to)
{
    memset(to, 0, sizeof *to);
    for (char *line; (line = strsep(&bytes, "\n")) && *line; to->rows++) {
        assert_true(to->rows < ROWS_MOST);
        to->columns = 0;
        for (char *cell; (cell = strsep(&line, ",")); to->cell[to->rows][to->columns++] = cell)
            assert_true(to->columns < COLUMNS_MOST);
    }
}

static size_t column_of(const struct lines *table, const char *name)
{
    for (size_t c = 0; c < table->columns; c++) {
        if (strcmp(table->cell[0][c], name) == 0)
            return c;
    }
    return SIZE_MAX;
}

static bool same_cell(const char *a, const char *b)
{
    char *end[2];
    const double x = strtod(a, &end[0]), y = strtod(b, &end[1]);
    return *end[0] || *end[1] ? strcmp(a, b) == 0 : (isnan(x) && isnan(y)) || fabs(x - y) <= 1e-9 * fabs(x) + 1e-18;
}

/* Do the cells of a row, by the names of their columns, stand in that row of the whole? */
static bool is_part(const struct lines *whole, size_t row, const struct lines *part, size_t line)
{
    for (size_t c = 0; c < part->columns; c++) {
        const size_t column = column_of(whole, part->cell[0][c]);
        if (column == SIZE_MAX || !same_cell(whole->cell[row][column], part->cell[line][c]))
            return false;
    }
    return true;
}

/* The whole has the rows of its parts, and as many more as it should. */
static void parts_are_in_the_whole(void **)
{
    static const struct {
        const char *scene, *whole, *part;
        size_t rows;
    } cuts[] = {
        {PRESSED, "show: sensors, every: 2 us, beads: [2, 5, 6, 10]", "show: sensors, every: 2 us, beads: [10, 5]", 50},
        {PRESSED, "show: sensors, every: 2 us, beads: [2, 5]", "show: sensors, every: 2 us, beads: [2, 5], time: [10 us, 31 us]",
         11},
        {PRESSED, "show: sensors, every: 2 us, contacts: [0..9], beads: 4", "show: sensors, every: 4 us, contacts: [9, 3]", 25},
        {PRESSED, "show: extremes, every: 2 us", "show: extremes, every: 2 us, time: [50 us, 99 us]", 50},
        {PRESSED, "show: extremes, every: 2 us, field: velocity", "show: extremes, every: 6 us, field: velocity", 34},
        {PRESSED, "show: energy, every: 3 us, beads: [4, 9]", "show: energy, every: 3 us, time: [0 us, 60 us]", 21},
        {PRESSED, "show: energy, every: 3 us, parts: place", "show: energy, every: 9 us, parts: place", 12},
        {PRESSED, "show: peaks", "show: peaks, contacts: [2, 4..6, 9]", 10},
        {PRESSED, "show: bead-peaks", "show: bead-peaks, beads: [1, 8]", 4},
        {PRESSED, "show: profiles, at: [20 us, 30 us, 50.5 us]", "show: profiles, at: [30 us]", 27},
        {PRESSED, "show: spectrum, every: 2 us", "show: spectrum, every: 2 us, frequencies: [20 kHz, 90 kHz]", 8},
        {DAMPED, "show: sensors, every: 2 us, beads: [2, 5, 6]", "show: sensors, every: 4 us, beads: [5], time: [8 us, 40 us]", 9},
        {STRING, "show: sensors, every: 0.5, beads: [2, 5, 6]", "show: sensors, every: 1, beads: [5], time: [8, 12]", 5},
        {STRING, "show: modes, every: 0.5, modes: 4", "show: modes, every: 0.5, modes: 2, time: [5, 9]", 9},
    };
    static char bytes[2][BYTES_MOST];
    static struct lines whole, part;
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        play(cuts[i].scene, NULL, (const char *const[]){cuts[i].whole, NULL}, "all");
        play(cuts[i].scene, NULL, (const char *const[]){cuts[i].part, NULL}, "one");
        read_file("all", "0.csv", bytes[0]);
        read_file("one", "0.csv", bytes[1]);
        split(bytes[0], &whole);
        split(bytes[1], &part);
        size_t row = 1;
        for (size_t line = 1; line < part.rows; line++, row++) {
            for (; row < whole.rows && !is_part(&whole, row, &part, line);)
                row++;
            if (row >= whole.rows)
                fail_msg("line %zu of '%s' is not in '%s'", line, cuts[i].part, cuts[i].whole);
        }
        if (part.rows - 1 != cuts[i].rows)
            fail_msg("'%s': %zu rows, not %zu", cuts[i].part, part.rows - 1, cuts[i].rows);
    }
}

/* A table of one stored run, or of two, or of their difference. */
static void table_of(const char *run, const char *other, bool difference, const char *show, struct lines *to)
{
    static char bytes[4][BYTES_MOST];
    static int turn;
    char path[2][600], out[600], setting[200];
    const char *const others[] = {path[1]};
    snprintf(path[0], sizeof path[0], "%s/all/%s", directory, run);
    snprintf(path[1], sizeof path[1], "%s/all/%s", directory, other ? other : "");
    snprintf(out, sizeof out, "%s/one/t.csv", directory);
    snprintf(setting, sizeof setting, "outputs=[{table: t.csv, show: sensors, %s: [2, 5]}]", show);
    play_counts((struct bead_job){.input = path[0],
                                  .others = others,
                                  .other_count = other != NULL,
                                  .difference = difference,
                                  .output = out,
                                  .threads = 1,
                                  .settings = (const char *const[]){setting},
                                  .setting_count = 1});
    read_file("one", "t.csv", bytes[turn = (turn + 1) % 4]);
    split(bytes[turn], to);
}

static void two_are_those_alone(const char *show, const char *column)
{
    static struct lines alone[2], both, difference;
    for (int k = 0; k < 2; k++)
        table_of(k ? "b.h5" : "a.h5", NULL, false, show, &alone[k]);
    table_of("a.h5", "b.h5", false, show, &both);
    table_of("a.h5", "b.h5", true, show, &difference);
    assert_true(alone[0].rows == 302 && alone[1].rows == 302 && both.rows == 302 && difference.rows == 302);
    for (size_t row = 1; row < 302; row++) {
        for (int place = 2; place <= 5; place += 3) {
            char name[2][400];
            double value[3];
            snprintf(name[0], sizeof name[0], column, place);
            for (int k = 0; k < 2; k++) {
                const char *cell = alone[k].cell[row][column_of(&alone[k], name[0])];
                snprintf(name[1], sizeof name[1], "%s/all/%c/%.20s", directory, 'a' + k, name[0]);
                assert_string_equal(both.cell[row][column_of(&both, name[1])], cell);
                value[k] = strtod(cell, NULL);
            }
            value[2] = strtod(difference.cell[row][column_of(&difference, name[0])], NULL);
            assert_true(value[2] == value[1] - value[0]);
        }
    }
}

/* Two runs in one table have the columns that each has alone, and their difference is that of these. They have more samples than
 * are read at a time. */
static void two_runs_are_those_alone(void **)
{
    char path[600], out[600];
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/all", directory);
    for (int k = 0; k < 2; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "chain: {striker: {velocity: %g m/s}, beads: [{bead: brass, count: %d}]}\nsimulate: {until: 60 us}\n"
                 "outputs: [{trajectory: %s.h5, every: 0.2 us, fields: [velocity, contact-force]}]\n",
                 k ? 0.5 : 0.3, 6, k ? "b" : "a");
        write_text(path, text);
        play_counts((struct bead_job){.input = path, .output = out, .threads = 1});
    }
    two_are_those_alone("field: velocity, beads", "bead_%d_velocity");
    two_are_those_alone("contacts", "contact_%d"); /* one fewer than beads */
}

/* The file for ParaView beside a trajectory is a tree of tags: each is closed, in order, and there is a grid for each time. */
static void files_beside_are_trees(void **)
{
    static char bytes[BYTES_MOST];
    char open[16][32];
    size_t depth = 0, grids = 0, deepest = 0;
    play(DAMPED, "every: 20 us, fields: all, xdmf: true", (const char *const[]){NULL}, "all");
    read_file("all", "run.xdmf", bytes);
    for (const char *at = bytes; (at = strchr(at, '<')); at++) {
        const char *const end = strchr(at, '>');
        const size_t length = strcspn(at + 1, " >/");
        assert_non_null(end);
        if (at[1] == '?' || at[1] == '!')
            continue;
        if (at[1] == '/') {
            assert_true(depth > 0 && strncmp(at + 2, open[depth - 1], strlen(open[depth - 1])) == 0);
            assert_true(at + 2 + strlen(open[--depth]) == end);
        } else if (end[-1] != '/') {
            assert_true(depth < 16 && length < sizeof open[0]);
            snprintf(open[depth++], sizeof open[0], "%.*s", (int)length, at + 1);
            grids += strncmp(at, "<Grid Name=\"beads\"", 18) == 0;
            deepest = depth > deepest ? depth : deepest;
        }
    }
    assert_true(depth == 0 && deepest == 7 && grids == 7);
}

/* An image of some beads is drawn of those that the file has, if there are any. */
static void beads_are_shown_where_they_are_stored(void **)
{
    static const struct bead_sink_type *const *sinks[3];
    char run[600], out[600];
    sinks[0] = bead_data_sinks();
    sinks[1] = bead_render_sinks();
    snprintf(run, sizeof run, "%s/all/run.h5", directory);
    snprintf(out, sizeof out, "%s/x.png", directory);
    play(PRESSED, "every: 1 us, fields: all, beads: [3, 6]", (const char *const[]){"show: chain", NULL}, "all");
    for (int first = 0; first <= 9; first++) {
        for (int last = first; last <= 9; last++) {
            char setting[100];
            struct bead_message msg = {""};
            struct bead_session *session = NULL;
            snprintf(setting, sizeof setting, "outputs=[{image: x.png, beads: [%d, %d]}]", first, last);
            const struct bead_job job = {.size = sizeof job,
                                         .input = run,
                                         .output = out,
                                         .sinks = sinks,
                                         .settings = (const char *const[]){setting},
                                         .setting_count = 1};
            const enum bead_error err = bead_session_open(&job, &session, &msg);
            bead_session_close(session);
            if (!err != (first <= 6 && last >= 3) || (err && !strstr(msg.text, "holds beads 3 to 6 only")))
                fail_msg("%s: '%s'", setting, msg.text);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stored_runs_say_the_same), cmocka_unit_test(parts_are_in_the_whole),
                                       cmocka_unit_test(two_runs_are_those_alone), cmocka_unit_test(files_beside_are_trees),
                                       cmocka_unit_test(beads_are_shown_where_they_are_stored)};
    return cmocka_run_group_tests_name("stored", tests, make_directory, remove_directory);
}
