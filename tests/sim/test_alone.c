/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file does not depend on what else a scene asks for: each output alone is, byte for byte, what it is among all the others, with
 * their other samples, fields, beads, ends and accuracies; in any order, and with all threads. Nor does a chain depend on others.
 */
#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "beadreel/sink.h"
#include "sessions.h"
#include "tests/scratch.h"

enum { OUTPUTS_MOST = 20, BYTES_MOST = 1 << 18 };

#define STRUCK "striker: {bead: large-steel, velocity: 1 m/s}, "
static const struct {
    double rounding;                           /* of sums that are near 0 */
    const char *scene, *outputs[OUTPUTS_MOST]; /* without their files */
} scenes[] = {
    {0,
     "chain: {" STRUCK "wall: brass, beads: [{cell: [large-steel, aluminium], count: 4}, {bead: ptfe, sensor: s}, {bead: "
     "small-steel, count: 4}]}\nsimulate: {until: 80 us, step: 0.5 us}\n",
     {"show: sensors, every: 0.13 us", "show: sensors, field: velocity, every: 0.17 us, beads: [2, 5]", "show: peaks",
      "show: bead-peaks, beads: [3, 6]", "show: measures", "show: profiles, at: [50.2 us]",
      "show: profiles, at: [10 us, 20 us, 35 us], field: displacement", "show: energy, every: 2 us",
      "show: energy, parts: place, every: 1 us", "show: extremes, every: 1 us", "show: spreading", "show: chain",
      "show: spectrum, beads: [2, 5], every: 0.5 us", "show: profiles, at: [50.8 us], field: energy"}},
    {1e-15,
     "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 20}\n",
     {"show: modes", "show: modes, every: 0.5", "show: profiles, at: [3.3], field: velocity", "show: profiles, at: [7.7]",
      "show: profiles, at: [1, 2]", "show: sensors, beads: [3], every: 0.7"}},
    {1e-13,
     "chain: {equation: kdv, low: -12, length: 34, points: 320, start: {solitons: [{speed: 16, at: -8}, {speed: 4, at: 0}]}}\n"
     "simulate: {until: 0.08}\n",
     {"show: sensors, beads: [20, 40], every: 0.007", "show: profiles, at: [0.0123]", "show: profiles, at: [0.02, 0.05, 0.07]",
      "show: measures"}},
    {1e-13,
     "chain: {equation: shock, points: 60, epsilon: 0.5, length: 6.283185307179586, start: {simple-wave: 1, amplitude: 1}}\n"
     "simulate: {until: 5}\n",
     {"show: sensors, beads: [20, 40], every: 0.7", "show: profiles, at: [0.123]", "show: profiles, at: [1, 2, 4.5]",
      "show: measures"}},
    {0,
     "chains:\n  - {name: A, " STRUCK
     "cradle: {length: 20 cm}, damping: {coefficient: 1, exponent: 1.5}, beads: [{bead: large-steel, count: 3}]}\n"
     "  - {name: B, wall: rigid, tilt: 30 deg, " STRUCK
     "beads: [{bead: large-steel, count: 4}, {bead: ptfe, sensor: s}]}\nsimulate: {until: 60 us, step: 0.1 us}\n",
     {"show: sensors, beads: [1, 3], every: 0.7 us", "show: peaks", "show: profiles, at: [30.3 us]", "show: energy, every: 2 us",
      "show: bead-peaks"}},
};

static size_t read_file(const char *folder, size_t output, char *bytes)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s/%zu.csv", directory, folder, output);
    FILE *file = fopen(path, "r");
    if (!file)
        return 0;
    const size_t count = fread(bytes, 1, BYTES_MOST, file);
    fclose(file);
    assert_true(count < BYTES_MOST);
    bytes[count] = '\0';
    return count;
}

/* Are two texts the same but for the last digits of numbers? Times are those of either grid, where two coincide. */
static bool alike(const char *a, const char *b, double rounding)
{
    while (*a && *b) {
        char *after_a, *after_b;
        const double x = strtod(a, &after_a), y = strtod(b, &after_b);
        if (after_a == a || after_b == b) {
            if (*a++ != *b++)
                return false;
        } else if (!(fabs(x - y) <= 1e-11 * fabs(x) + rounding) && !(isnan(x) && isnan(y))) {
            return false;
        } else {
            a = after_a;
            b = after_b;
        }
    }
    return *a == *b;
}

/* All outputs, or only one of them, into a folder. */
static void play(size_t scene, const char *folder, const char *only, int threads)
{
    char text[4000], path[600], out[600];
    int used = snprintf(text, sizeof text, "%soutputs:\n", scenes[scene].scene);
    for (size_t i = 0; i < OUTPUTS_MOST && scenes[scene].outputs[i]; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, %s}\n", i, scenes[scene].outputs[i]);
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/%s", directory, folder);
    mkdir(out, 0777);
    write_text(path, text);
    play_counts((struct bead_job){.input = path, .output = out, .threads = threads, .only = &only, .only_count = only ? 1 : 0});
}

static void files_do_not_depend_on_others(void **)
{
    static char among[BYTES_MOST], alone[BYTES_MOST];
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        play(s, "all", NULL, 2);
        for (size_t i = 0; i < OUTPUTS_MOST && scenes[s].outputs[i]; i++) {
            char name[20];
            snprintf(name, sizeof name, "%zu.csv", i);
            play(s, "one", name, 1);
            if (read_file("all", i, among) < 40 || read_file("one", i, alone) < 40 || !alike(among, alone, scenes[s].rounding))
                fail_msg("scene %zu: '%s' alone differs from that among others", s, scenes[s].outputs[i]);
        }
    }
}

/* Three chains in two orders: tables of which each row has its chain, and those with columns for each. */
static const char *const chains[] = {
    "{name: A, " STRUCK
    "wall: brass, precompression: 1 N, beads: [{cell: [large-steel, aluminium], count: 4}, {bead: ptfe, sensor: s}]}",
    "{name: B, wall: rigid, " STRUCK "precompression: 2 N, beads: [{cell: [brass, ptfe], count: 3}, {bead: ptfe, sensor: s}]}",
    "{name: C, " STRUCK "precompression: 3 N, beads: [{cell: [small-steel, ptfe], count: 5}, {bead: large-steel, sensor: s}]}"};
static const char *const tables[] = {"show: sensors, every: 1 us",
                                     "show: sensors, field: velocity, every: 1 us, beads: [1, 5]",
                                     "show: peaks",
                                     "show: bead-peaks",
                                     "show: measures, every: 1 us",
                                     "show: profiles, at: [20 us, 35 us]",
                                     "show: chain",
                                     "show: energy, every: 2 us",
                                     "show: energy, parts: place, every: 2 us",
                                     "show: extremes, every: 1 us",
                                     "show: spreading, every: 1 us",
                                     "show: bands",
                                     "show: eigenmodes",
                                     "show: sensitivities, contacts: [1]",
                                     "show: spectrum, every: 0.5 us",
                                     "show: dispersion, every: 0.5 us"};

static void play_order(const int order[3], const char *folder)
{
    char text[4000], path[600], out[600];
    int used = snprintf(text, sizeof text, "chains:\n");
    for (int c = 0; c < 3; c++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - %s\n", chains[order[c]]);
    used += snprintf(text + used, sizeof text - (size_t)used, "simulate: {until: 60 us}\noutputs:\n");
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, %s}\n", i, tables[i]);
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/%s", directory, folder);
    mkdir(out, 0777);
    write_text(path, text);
    play_counts((struct bead_job){.input = path, .output = out, .threads = 1});
}

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Its cells, each behind the name of its column and behind its row: the first field, or, where that is the chain, as it is. Sorted.
 */
static size_t cells_of(char *bytes, char **cells, size_t most)
{
    static char spare[2][4 * BYTES_MOST];
    static int turn;
    char *header[200], *put = spare[turn = !turn], *line = strtok(bytes, "\n");
    size_t columns = 0, count = 0;
    for (char *name; (name = strsep(&line, ",")) && columns < 200;)
        header[columns++] = name;
    const bool whole = strcmp(header[0], "chain") == 0;
    while ((line = strtok(NULL, "\n"))) {
        const char *const first = whole ? "" : line;
        const size_t length = strcspn(first, ",");
        for (size_t i = 0; i < (whole ? 1 : columns) && count < most; i++) {
            const size_t width = whole ? strlen(line) : strcspn(line, ",");
            cells[count++] = put;
            put += 1 + snprintf(put, 2000, "%s %.*s %.*s", whole ? "" : header[i], (int)length, first, (int)width, line);
            line += width + (line[width] == ',');
            assert_true(put < spare[turn] + sizeof spare[0] - 2000);
        }
    }
    qsort(cells, count, sizeof *cells, by_text);
    return count;
}

static void chains_do_not_depend_on_their_order(void **)
{
    static char text[2][BYTES_MOST], *cells[2][20000];
    play_order((const int[]){0, 1, 2}, "all");
    play_order((const int[]){2, 0, 1}, "one");
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        size_t count[2];
        for (int k = 0; k < 2; k++) {
            assert_true(read_file(k ? "one" : "all", i, text[k]) > 40);
            count[k] = cells_of(text[k], cells[k], 20000);
        }
        for (size_t c = 0; c < count[0] || c < count[1]; c++) {
            if (count[0] != count[1] || strcmp(cells[0][c], cells[1][c]) != 0)
                fail_msg("%s: '%s' in one order, '%s' in another", tables[i], cells[0][c], cells[1][c]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(files_do_not_depend_on_others),
                                       cmocka_unit_test(chains_do_not_depend_on_their_order)};
    return cmocka_run_group_tests_name("outputs alone", tests, make_directory, remove_directory);
}
