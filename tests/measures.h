/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of single runs, read from the tables of scenes. */
#ifndef BEADREEL_TESTS_MEASURES_H
#define BEADREEL_TESTS_MEASURES_H

#include "tests/support.h"

#include "tests/scratch.h"

#include "beadreel/session.h"
#include "sim/measure/measure.h"

/* Contacts f = d^1.5, masses of 1 kg a metre apart; and strikers of other masses. */
#define UNIT_OF(more)                                                                                                   \
    "materials:\n  unit: {mass: 1 kg, radius: 0.5 m, modulus: 1 GPa, poisson: 0}\n" more "chain:\n  law: {power: 1.5, " \
    "coefficient: 1}\n"
#define UNIT  UNIT_OF("")
#define TABLE "outputs: [{table: m.csv, show: measures}]\n"

static struct bead_measure found[256];
static char units[256][16];
static double uncertainties[256];
static size_t found_count;

/* Play a scene or draw a trajectory again; false: it failed, with a message in `msg`. */
static inline bool play(const char *input, const char *output, struct bead_message *msg)
{
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    struct bead_session *session = NULL;
    struct bead_job job = {.size = sizeof job, .input = input, .output = output, .sinks = lists};
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    return !err;
}

/* The rows of the table's block of `chain` (NULL: of the only one). */
static inline void read_measures(const char *name, const char *chain)
{
    char path[768], line[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    line[strcspn(line, "\n")] = '\0';
    const bool is_checked = strstr(line, ",uncertainty");
    line[strlen(line) - (is_checked ? strlen(",uncertainty") : 0)] = '\0';
    assert_string_equal(line, chain ? "chain,name,value,unit,note" : "name,value,unit,note");
    for (found_count = 0; fgets(line, sizeof line, file);) {
        char *rest = line, *owner = chain ? strsep(&rest, ",") : NULL;
        char *measure = strsep(&rest, ","), *value = strsep(&rest, ","), *unit = strsep(&rest, ","), *note = strsep(&rest, ",\n");
        if (chain && strcmp(owner, chain) != 0)
            continue;
        assert_true(found_count < 256);
        struct bead_measure *f = &found[found_count];
        snprintf(f->name, sizeof f->name, "%s", measure);
        snprintf(units[found_count], sizeof units[0], "%s", unit);
        snprintf(f->note, sizeof f->note, "%s", note);
        f->unit = units[found_count++];
        f->value = strtod(value, NULL);
        uncertainties[found_count - 1] = is_checked ? strtod(rest, NULL) : NAN;
    }
    fclose(file);
}

static inline void measure(const char *scene)
{
    struct bead_message msg = {""};
    char path[512];
    write_scene(scene, path);
    if (!play(path, directory, &msg))
        fail_msg("%s", msg.text);
    read_measures("m.csv", NULL);
}

/* NaN: no check run has told it. */
static inline double uncertainty_of(const char *name)
{
    for (size_t i = 0; i < found_count; i++)
        if (strcmp(found[i].name, name) == 0)
            return uncertainties[i];
    return NAN;
}

/* NaN: the run has none. */
static inline double value_of(const char *name)
{
    for (size_t i = 0; i < found_count; i++)
        if (strcmp(found[i].name, name) == 0)
            return found[i].value;
    return NAN;
}

static inline void noted(const char *name, const char *note)
{
    for (size_t i = 0; i < found_count; i++)
        if (strcmp(found[i].name, name) == 0 && strcmp(found[i].note, note) == 0)
            return;
    fail_msg("%s, %.9g, is not noted as: %s", name, value_of(name), note);
}

static inline void near(const char *name, double expected, double tolerance)
{
    double value = value_of(name);
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%s is %.9g instead of %.9g +- %.2g", name, value, expected, tolerance);
}

static inline void none(const char *name)
{
    if (!isnan(value_of(name)))
        fail_msg("there is a %s, of %.9g", name, value_of(name));
}

static inline void equal(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g instead of %.9g +- %.2g", value, expected, tolerance);
}

#endif
