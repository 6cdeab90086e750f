/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is at rest stays there, in all systems: every row of a table is the first at another time, no number is missing for want of
 * energy, and nothing is in error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/play.h"
#include "sessions.h"
#include "tests/scratch.h"

#define PRESSED(more) \
    "{striker: {velocity: 0}, precompression: 2 N, wall: rigid, beads: [{cell: [brass, ptfe], count: 3}]" more "}", "1e-4"
static const struct {
    const char *chain, *until, *outputs[8];
} scenes[] = {
    {"{equation: fput, points: 8, alpha: 0.25, start: {mode: 1, amplitude: 0}}",
     "5",
     {"show: modes", "show: sensors, beads: [3]", "show: extremes, field: energy", "show: measures"}},
    {"{equation: fput, points: 8, ends: periodic, beta: 0.25, start: {mode: 1, amplitude: 0}}",
     "5",
     {"show: modes", "show: measures"}},
    {"{equation: kdv, low: -12, length: 34, points: 160, start: {cosine: 1, amplitude: 0}}",
     "0.1",
     {"show: sensors, beads: [3], every: 0.01", "show: extremes, every: 0.02", "show: measures"}},
    {"{equation: shock, points: 60, epsilon: 0.5, length: 6, start: {simple-wave: 1, amplitude: 0}}",
     "1",
     {"show: sensors, beads: [3], every: 0.1", "show: extremes, field: velocity, every: 0.1", "show: measures"}},
    {PRESSED(""),
     {"show: sensors, beads: [3]", "show: sensors, contacts: [0, 6]", "show: extremes, field: displacement", "show: energy",
      "show: energy, parts: place", "show: spreading", "show: measures"}},
    {PRESSED(", damping: {coefficient: 2, exponent: 1.5}"), {"show: sensors, beads: [3]", "show: extremes", "show: energy"}},
    {PRESSED(", law: {power: 2, coefficient: 1e9}"), {"show: sensors, beads: [3]", "show: extremes", "show: energy"}},
};

/* The line behind its first number, which is a time. */
static const char *behind_time(const char *line)
{
    return line + strcspn(line, ",");
}

static void check_table(size_t output)
{
    static char bytes[1 << 16];
    char path[600];
    snprintf(path, sizeof path, "%s/%zu.csv", directory, output);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    bytes[fread(bytes, 1, sizeof bytes - 1, file)] = '\0';
    fclose(file);
    if (strstr(bytes, "nan") || strstr(bytes, "inf"))
        fail_msg("%s", bytes);
    char *rest = bytes;
    const char *const header = strsep(&rest, "\n"), *const first = strsep(&rest, "\n");
    size_t rows = 0;
    for (char *line; strncmp(header, "time", 4) == 0 && (line = strsep(&rest, "\n")) && *line; rows++) {
        if (strcmp(behind_time(line), behind_time(first)) != 0)
            fail_msg("%s is at first %s", line, first);
    }
    if (rows < 2 && strncmp(header, "time", 4) == 0)
        fail_msg("%zu.csv has %zu rows behind its first", output, rows);
}

static void what_is_at_rest_stays(void **)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char text[2000], path[512];
        size_t chains = 0, count = 0;
        int used = snprintf(text, sizeof text, "chain: %s\nsimulate: {until: %s}\noutputs:\n", scenes[i].chain, scenes[i].until);
        for (; count < 8 && scenes[i].outputs[count]; count++)
            used +=
                snprintf(text + used, sizeof text - (size_t)used, "  - {table: %zu.csv, %s}\n", count, scenes[i].outputs[count]);
        write_scene(text, path);
        struct bead_session *session = play_session((struct bead_job){.input = path, .output = directory, .threads = 1});
        const struct bead_outcome *run = bead_session_outcomes(session, &chains);
        assert_true(run->energy_error == 0 && run->energy_end == run->energy_start && !(fabs(run->momentum_end) > 0));
        for (size_t k = 0; k < count; k++)
            check_table(k);
        bead_session_close(session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_at_rest_stays)};
    return cmocka_run_group_tests_name("rest", tests, make_directory, remove_directory);
}
