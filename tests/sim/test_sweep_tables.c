/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps of all kinds, byte for byte: parts merged in any order are the whole file; tables of that file are those made beside it,
 * with any number of threads; a configuration alone has the row that it has among others, and a sweep the rows. */
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

#include "beadreel/sweep.h"
#include "sessions.h"
#include "tests/scratch.h"

enum { BYTES_MOST = 1 << 18, PARTS = 3, TABLES_MOST = 8, TWO = 5 };

#define BEADS                                                                                                                   \
    "beads: [{cell: [large-steel, aluminium], count: 6, spins: random}, {bead: small-steel, sensor: end}, {bead: large-steel, " \
    "count: 4}]"
static const struct {
    const char *sweep, *tables[TABLES_MOST]; /* the last lists configurations */
    size_t configurations;                   /* that are run alone, too */
} sweeps[] = {
    {"sweep: {cells: 8, configurations: 3, magnetism: [0, 0.5, 1], seed: 3, measure: {peak: force, decay: true}}\n",
     {"show: magnetism", "show: statistics, threshold: half", "show: decay", "show: configurations"},
     7},
    {"chain: {" BEADS "}\nsweep: {over: {chain.striker.velocity: [0.1 m/s, 0.4 m/s], chain.beads.0.seed: 1..3}}\nsimulate: {until: "
     "0.25 ms}\n",
     {"show: statistics", "show: sensors, every: 5 us", "show: spectrum, every: 5 us", "show: spreading", "measure: front speed",
      "show: statistics, against: chain.beads.0.seed", "show: configurations"},
     6},
    {"chain: {wall: brass, precompression: 1 N, " BEADS "}\nsweep: {combine: pairs, over: {chain.precompression: {from: 1 N, to: 9 "
     "N, count: 4}, chain.beads.0.magnetism: [0, 0.3, 0.7, 1]}}\nsimulate: {until: 0.25 ms}\n",
     {"show: statistics", "show: dispersion, every: 4 us", "show: configurations"},
     4},
    {"chain:\n  beads:\n    - {cell: [large-steel, aluminium], count: 8, spins: random}\n    - {bead: small-steel, sensor: "
     "first}\n    - {cell: [large-steel, aluminium], count: 3}\n    - {bead: small-steel, sensor: second}\n    - {cell: "
     "[large-steel, aluminium], count: 4}\nsweep: {configurations: 4, seed: 2, magnetism: [0, 0.5], measure: {peak: force, sensor: "
     "[first, second]}}\n",
     {"show: magnetism", "show: configurations"},
     0},
    {"sweep: {cells: 24, configurations: 3, seed: 3, magnetism: [0, 0.5], measure: {peak: none, decay: true}}\n",
     {"show: decay"},
     0},
    {"sweeps: [{name: x, cells: 6, configurations: 2, magnetism: [0, 0.5], seed: 3, cell: [large-steel, 2 aluminium]}, {name: y, "
     "cells: 5, configurations: 3, magnetism: 0.2, seed: 4}]\n",
     {"show: magnetism", "show: configurations"},
     0},
};

static size_t read_file(const char *path, char *bytes)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    const size_t count = fread(bytes, 1, BYTES_MOST, file);
    fclose(file);
    assert_true(count > 40 && count < BYTES_MOST);
    bytes[count] = '\0';
    return count;
}

static void same_files(const char *one, const char *other, const char *what)
{
    static char bytes[2][BYTES_MOST];
    const size_t size = read_file(one, bytes[0]);
    if (read_file(other, bytes[1]) != size || memcmp(bytes[0], bytes[1], size) != 0)
        fail_msg("%s: %s is not %s", what, one, other);
}

static const char *path_of(const char *name)
{
    static char paths[4][600];
    static int turn;
    char *path = paths[turn = (turn + 1) % 4];
    snprintf(path, 600, "%s/%s", directory, name);
    return path;
}

static void write_sweep(size_t i, const char *sweep)
{
    char text[3000], path[512];
    int used = snprintf(text, sizeof text, "%soutputs:\n  - {sweep: s.h5}\n", sweep);
    for (size_t t = 0; t < TABLES_MOST && sweeps[i].tables[t]; t++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, %s}\n", t, sweeps[i].tables[t]);
    write_scene(text, path);
}

static void parts_make_the_whole(void)
{
    char files[PARTS][600];
    const char *parts[PARTS];
    struct bead_message msg = {""};
    struct bead_sweep *merged = NULL;
    for (size_t k = 0; k < PARTS; k++) {
        play_counts(
            (struct bead_job){.input = path_of("scene.yaml"), .output = directory, .part = k + 1, .parts = PARTS, .threads = 1});
        snprintf(files[k], sizeof files[k], "%s/s.%zuof%d.h5", directory, k + 1, PARTS);
        parts[(k + 2) % PARTS] = files[k];
    }
    if (bead_sweep_merge(parts, PARTS, &merged, &msg) || bead_sweep_write(merged, path_of("m.h5"), &msg))
        fail_msg("%s", msg.text);
    bead_sweep_close(merged);
}

/* Of a line of configurations, whose columns the head names: "force,time" into `text`; its bead. */
static size_t force_of(const char *head, const char *line, char text[80])
{
    size_t before = 0, bead = 0;
    char force[32], time[32];
    for (const char *c = head; c < strstr(head, "peak_force_N"); c++)
        before += *c == ',';
    for (; before > 0; before--)
        line = strchr(line, ',') + 1;
    assert_int_equal(sscanf(line, "%31[^,],%31[^,],%zu", force, time, &bead), 3);
    snprintf(text, 80, "%s,%s,", force, time);
    return bead;
}

static void configurations_are_those_alone(size_t i, size_t table)
{
    static char all[BYTES_MOST], peaks[BYTES_MOST];
    char name[24], number[24], force[80], row[120];
    snprintf(name, sizeof name, "%zu.csv", table);
    read_file(path_of(name), all);
    const char *line = all;
    for (size_t c = 0; c < sweeps[i].configurations; c++) {
        line = strchr(line, '\n') + 1;
        snprintf(number, sizeof number, "%zu", c);
        play_counts((struct bead_job){
            .input = path_of("scene.yaml"), .output = path_of("peaks.csv"), .configuration = number, .threads = 1});
        read_file(path_of("peaks.csv"), peaks);
        const size_t bead = force_of(all, line, force);
        snprintf(row, sizeof row, "\n%zu,%s", bead, force);
        if (strncmp(line, number, strlen(number)) != 0 || !strstr(peaks, row))
            fail_msg("sweep %zu, configuration %zu: no '%s' in '%s'", i, c, row + 1, peaks);
    }
}

static void sweeps_are_the_same_in_all_ways(void **)
{
    for (size_t i = 0; i < sizeof sweeps / sizeof *sweeps; i++) {
        char name[24], again[24];
        size_t tables = 0;
        write_sweep(i, sweeps[i].sweep);
        play_counts((struct bead_job){.input = path_of("scene.yaml"), .output = directory, .threads = 2});
        parts_make_the_whole();
        same_files(path_of("s.h5"), path_of("m.h5"), sweeps[i].sweep);
        for (; tables < TABLES_MOST && sweeps[i].tables[tables]; tables++) {
            snprintf(name, sizeof name, "%zu.csv", tables);
            snprintf(again, sizeof again, "again/%zu.csv", tables);
            play_counts((struct bead_job){.input = path_of("m.h5"), .output = path_of(again), .threads = 1});
            same_files(path_of(name), path_of(again), sweeps[i].tables[tables]);
        }
        configurations_are_those_alone(i, tables - 1);
        remove_files(path_of("again"));
    }
}

/* Of two sweeps the rows of the first are those of it alone. */
static void sweeps_are_those_alone(void **)
{
    static char both[BYTES_MOST], one[BYTES_MOST];
    write_sweep(TWO, sweeps[TWO].sweep);
    play_counts((struct bead_job){.input = path_of("scene.yaml"), .output = directory, .threads = 1});
    for (size_t t = 0; t < 2; t++) {
        char name[24];
        snprintf(name, sizeof name, "%zu.csv", t);
        read_file(path_of(name), both);
        write_sweep(TWO, "sweep: {cells: 6, configurations: 2, magnetism: [0, 0.5], seed: 3, cell: [large-steel, 2 aluminium]}\n");
        mkdir(path_of("again"), 0777);
        play_counts((struct bead_job){.input = path_of("scene.yaml"), .output = path_of("again"), .threads = 1});
        snprintf(name, sizeof name, "again/%zu.csv", t);
        read_file(path_of(name), one);
        const char *line = strchr(both, '\n') + 1;
        size_t rows = 0;
        for (const char *alone = strchr(one, '\n') + 1; *alone; alone = strchr(alone, '\n') + 1, rows++) {
            const size_t length = strcspn(alone, "\n");
            if (strncmp(line, "x,", 2) != 0 || strncmp(line + 2, alone, length + 1) != 0)
                fail_msg("'%.*s' alone, '%.*s' among two", (int)length, alone, (int)strcspn(line, "\n"), line);
            line = strchr(line, '\n') + 1;
        }
        assert_int_equal(rows, t == 0 ? 2 : 4);
        assert_int_equal(strncmp(line, "y,", 2), 0);
    }
    remove_files(path_of("again"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sweeps_are_the_same_in_all_ways), cmocka_unit_test(sweeps_are_those_alone)};
    return cmocka_run_group_tests_name("sweep tables", tests, make_directory, remove_directory);
}
