/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A measure of a chain of a sweep is that of the chain alone, to what both know; where it follows from states of the run, not from
 * samples, to the last bit, with its uncertainty. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sessions.h"
#include "tests/scratch.h"

#define CHAIN                                                                                                                  \
    "chain: {wall: brass, beads: [{cell: [large-steel, aluminium], count: 12, spins: \"101100101111\"}, {cell: [large-steel, " \
    "aluminium], count: 10}]}\n"
static const struct {
    const char *name;
    bool of_states;
} measures[] = {{"clean index", true},
                {"participation of forces", true},
                {"participation of energies", true},
                {"domain length", true},
                {"spin correlation", true},
                {"spin correlation at 2", true},
                {"front arrival", false},
                {"front speed", false},
                {"local front speed", false},
                {"peak contact force", false},
                {"peak velocity", false},
                {"force width", false},
                {"velocity width", false},
                {"pulse energy", false},
                {"pulse momentum", false},
                {"kinetic / potential", false},
                {"second pulse", false},
                {"force at wall", false},
                {"reflected force", false},
                {"striker's contact time", false},
                {"striker's velocity", false}};
enum { MEASURES = sizeof measures / sizeof *measures, VALUES = 2 };
static const char *const velocities[VALUES] = {"0.1 m/s", "0.4 m/s"};

static void read_file(const char *name, char *bytes, size_t size)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    bytes[fread(bytes, 1, size - 1, file)] = '\0';
    fclose(file);
}

/* The field of a line in the column of the head that begins with `column`. */
static double field(const char *head, const char *line, const char *column)
{
    for (; strncmp(head, column, strlen(column)) != 0; line = strchr(line, ',') + 1)
        head = strchr(head, ',') + 1;
    return strtod(line, NULL);
}

/* Value and uncertainty of each measure, for each velocity, of the sweep. */
static void measure_sweep(double found[VALUES][MEASURES][2])
{
    char text[4000], path[512], table[24], bytes[4000];
    int used = snprintf(text, sizeof text, CHAIN "sweep: {over: {chain.striker.velocity: [%s, %s]}}\noutputs:\n", velocities[0],
                        velocities[1]);
    for (size_t m = 0; m < MEASURES; m++)
        used += snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, measure: \"%s\"}\n", m, measures[m].name);
    write_scene(text, path);
    play_counts((struct bead_job){.input = path, .output = directory, .threads = 2});
    for (size_t m = 0; m < MEASURES; m++) {
        snprintf(table, sizeof table, "%zu.csv", m);
        read_file(table, bytes, sizeof bytes);
        const char *line = bytes;
        for (size_t v = 0; v < VALUES; v++) {
            line = strchr(line, '\n') + 1;
            assert_int_equal(strncmp(line, velocities[v], strlen(velocities[v])), 0);
            found[v][m][0] = field(bytes, line, "mean");
            found[v][m][1] = field(bytes, line, "uncertainty");
        }
    }
}

/* The same of the chain alone. */
static void measure_chain(const char *velocity, double found[MEASURES][2])
{
    char text[1000], path[512], bytes[8000], start[64];
    snprintf(text, sizeof text, CHAIN "outputs: [{table: m.csv, show: measures}]\n");
    snprintf(start, sizeof start, "chain.striker.velocity=%s", velocity);
    write_scene(text, path);
    play_counts((struct bead_job){
        .input = path, .output = directory, .threads = 1, .settings = (const char *const[]){start}, .setting_count = 1});
    read_file("m.csv", bytes, sizeof bytes);
    for (size_t m = 0; m < MEASURES; m++) {
        char begins[64];
        snprintf(begins, sizeof begins, "\n%s,", measures[m].name);
        const char *line = strstr(bytes, begins);
        assert_non_null(line);
        found[m][0] = field(bytes, line + 1, "value");
        found[m][1] = field(bytes, line + 1, "uncertainty");
    }
}

static void measures_are_those_of_chains_alone(void **)
{
    static double many[VALUES][MEASURES][2], one[MEASURES][2];
    measure_sweep(many);
    for (size_t v = 0; v < VALUES; v++) {
        measure_chain(velocities[v], one);
        for (size_t m = 0; m < MEASURES; m++) {
            const double *a = many[v][m], *b = one[m];
            if (measures[m].of_states ? a[0] != b[0] || a[1] != b[1] : !(fabs(a[0] - b[0]) <= a[1] + b[1] + 1e-6 * fabs(b[0])))
                fail_msg("%s at %s: %.17g +- %.3g of the sweep, %.17g +- %.3g alone", measures[m].name, velocities[v], a[0], a[1],
                         b[0], b[1]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(measures_are_those_of_chains_alone)};
    return cmocka_run_group_tests_name("sweep measured", tests, make_directory, remove_directory);
}
