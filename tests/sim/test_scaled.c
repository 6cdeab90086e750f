/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No law here knows a length, a mass or a time of its own: where all those of a scene are others, by powers of two, each number of
 * each table is another one as its unit says, and the same steps lead there. The equations have amplitudes instead of masses. */
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

#include "beadreel/play.h"
#include "sessions.h"
#include "tests/scratch.h"

enum { OUTPUTS_MOST = 24, BYTES_MOST = 1 << 17 };

/* Powers of a length, a mass (or an amplitude) and a time. */
struct dimension {
    double length, mass, time;
};
#define NONE    \
    {           \
        0, 0, 0 \
    }
#define LENGTH  \
    {           \
        1, 0, 0 \
    }
#define TIME    \
    {           \
        0, 0, 1 \
    }
#define FORCE    \
    {            \
        1, 1, -2 \
    }
#define ENERGY   \
    {            \
        2, 1, -2 \
    }
#define VELOCITY \
    {            \
        1, 0, -1 \
    }
#define HEIGHT  \
    {           \
        0, 1, 0 \
    }

/* The end of a column's name, or the whole of a measure's or column's. */
static const struct {
    const char *name;
    struct dimension is;
} known[] = {
    {"s", TIME},
    {"m", LENGTH},
    {"kg", {0, 1, 0}},
    {"N", FORCE},
    {"J", ENERGY},
    {"m/s", VELOCITY},
    {"Hz", {0, 0, -1}},
    {"1/s", {0, 0, -1}},
    {"kg m/s", {1, 1, -1}},
    {"N_per_kg", {1, 0, -2}},
    {"N_per_m", {0, 1, -2}},
    {"N_per_Pa", {2, 0, 0}},
    {"N_s_per_m", {0, 1, -1}},
    {"stiffness", {-0.5, 1, -2}}, /* of Hertz's contacts */
    {"bead", NONE},
    {"mode", NONE},
    {"band", NONE},
    {"configurations", NONE},
    {"wave_number_cell_pi", NONE},
    {"time", TIME},
    {"frequency", {0, 0, -1}},
    {"x", LENGTH},
    {"mass", {1, 1, 0}}, /* integrals of equations */
    {"momentum", {1, 2, 0}},
    {"hamiltonian", {2, 2, -1}},
    {"soliton 1: place", LENGTH},
    {"soliton 1: amplitude", HEIGHT},
    {"soliton 1: shift from free motion", LENGTH},
    {"energy", {1, 2, -2}},
    {"change of the integral of the strain", HEIGHT},
    {"change of the momentum", {1, 1, -1}},
    {"breaking time, extrapolated", TIME},
    {"breaking time, closed form", TIME},
};

/* Hertz's beads have masses; numbers of a scene are followed by the powers of their dimension. */
#define MATERIALS                                                                                                               \
    "materials:\n  a: {mass: <3.63e-3|0 1 0> kg, radius: <4.76e-3|1 0 0> m, modulus: <193e9|-1 1 -2> Pa, poisson: 0.3, yield: " \
    "<2e9|-1 1 -2> Pa}\n  b: {mass: <1.26e-3|0 1 0> kg, radius: <4e-3|1 0 0> m, modulus: <72.4e9|-1 1 -2> Pa, poisson: 0.33}\n"
#define STRIKER    "striker: {bead: a, velocity: <0.443|1 0 -1> m/s}"
#define UNTIL(end) "simulate: {until: <" end "|0 0 1> s}\n"
#define EVERY(by)  ", every: <" by "|0 0 1> s"
static const struct {
    const char *scene;
    struct dimension by; /* powers of two, so large that a 1 among lengths and masses would be seen */
    struct {
        const char *output;     /* without its file */
        struct dimension plain; /* of columns whose name says none */
    } outputs[OUTPUTS_MOST];
} scenes[] = {
    {MATERIALS "chain: {" STRIKER ", precompression: <2|1 1 -2> N, wall: b, beads: [{cell: [a, b], count: 6}, {bead: b, sensor: "
               "s}]}\n" UNTIL("1e-4"),
     {4, 12, 6},
     {{"show: sensors" EVERY("5e-6") ", beads: [2, 5]", FORCE},
      {"show: sensors" EVERY("5e-6") ", beads: [2, 5], field: velocity", VELOCITY},
      {"show: sensors" EVERY("5e-6") ", contacts: [2, 5]", FORCE},
      {"show: peaks", NONE},
      {"show: bead-peaks", NONE},
      {"show: measures" EVERY("5e-7"), NONE},
      {"show: profiles, at: [<5e-5|0 0 1> s]", FORCE},
      {"show: profiles, at: [<5e-5|0 0 1> s], field: energy", ENERGY},
      {"show: chain", NONE},
      {"show: energy" EVERY("5e-6"), NONE},
      {"show: energy, parts: place" EVERY("5e-6"), NONE},
      {"show: sensitivities", NONE},
      {"show: extremes, field: displacement" EVERY("5e-6"), LENGTH},
      {"show: spreading" EVERY("5e-6"), NONE},
      {"show: spectrum, beads: [2]" EVERY("1e-6"), FORCE},
      {"show: spectrogram, beads: [2], segment: <4e-5|0 0 1> s" EVERY("1e-6"), FORCE},
      {"show: dispersion, field: velocity" EVERY("2e-6"), VELOCITY},
      {"show: bands", NONE},
      {"show: eigenmodes", NONE}}},
    /* To the end of the first pulse. */
    {MATERIALS "chain: {" STRIKER ", beads: [{cell: [a, b], count: 4, disorder: {radius: normal 2 %}}, {bead: b, "
               "count: 12}]}\nsimulate: {verify: true}\n",
     {-2, -9, -4},
     {{"show: peaks", NONE}, {"show: bead-peaks", NONE}, {"show: measures" EVERY("1e-6"), NONE}}},
    /* Collisions of few beads, whose later peaks are not known. */
    {MATERIALS "chain: {" STRIKER
               ", wall: rigid, beads: [{bead: b, count: 4, gap: <1e-8|1 0 0> m, spring: <1e5|0 1 -2> N/m}]}\n" UNTIL("3e-3"),
     {2, -3, -4},
     {{"show: peaks", NONE}, {"show: bead-peaks", NONE}, {"show: measures" EVERY("1e-6"), NONE}}},
    {MATERIALS
     "chains:\n  - {name: A, " STRIKER
     ", wall: rigid, damping: {coefficient: <1|-0.5 1 -0.5>, exponent: 1.5}, beads: [{bead: a, count: "
     "3}]}\n  - {name: B, law: {power: 2.25, coefficient: <1e9|-1.25 1 -2>}, " STRIKER
     ", beads: [{bead: a, count: 4}, {bead: b, sensor: s}]}\n  - {name: C, law: {fpu-alpha: <1e3|-1 0 0>, stiffness: <1e7|0 1 "
     "-2>}, " STRIKER ", beads: [{bead: a, count: 4}]}\n" UNTIL("2e-4"),
     {4, 14, 2},
     {{"show: peaks", NONE},
      {"show: measures" EVERY("1e-6"), NONE},
      {"show: energy" EVERY("5e-6"), NONE},
      {"show: sensors, beads: [1, 3], field: displacement" EVERY("5e-6"), LENGTH}}},
    /* Gravity is that of the earth, and a slope is allowed a millimetre of it. */
    {MATERIALS "chain: {" STRIKER ", cradle: {length: 0.2 m}, tilt: 30 deg, wall: rigid, beads: [{bead: a, count: 3}]}\n"
               "simulate: {until: 6e-5 s}\n",
     {0, 12, 0},
     {{"show: peaks", NONE}, {"show: energy, every: 5e-6", NONE}}},
    /* Driven, between an absorbing end and a bead that starts elsewhere. */
    {MATERIALS
     "chain: {striker: {bead: a, velocity: 0}, precompression: <20|1 1 -2> N, wall: absorbing, drive: {force: sine, amplitude: "
     "<1|1 1 -2> N, frequency: <5e3|0 0 -1> Hz, ramp: <1e-4|0 0 1> s}, start: [{bead: 3, displacement: <1e-8|1 0 0> m}], "
     "beads: [{bead: a, count: 8}]}\n" UNTIL("6e-4"),
     {4, -3, 6},
     {{"show: transfer, beads: [4]" EVERY("1e-5"), NONE},
      {"show: energy" EVERY("5e-6"), NONE},
      {"show: measures" EVERY("5e-6"), NONE},
      {"show: sensors, beads: [1, 3]" EVERY("5e-6"), FORCE}}},
    {MATERIALS
     "chain: {" STRIKER ", beads: [{cell: [a, b], count: 8, spins: random}, {bead: b, sensor: end}, {bead: a, count: 4}]}\n"
     "sweep: {over: {chain.striker.velocity: [<0.1|1 0 -1> m/s, <0.4|1 0 -1> m/s], chain.beads.0.seed: 1..3}}\n" UNTIL("3e-4"),
     {4, -3, 6},
     {{"show: statistics", NONE},
      {"show: configurations", NONE},
      {"show: sensors" EVERY("2e-6"), FORCE},
      {"show: spectrum" EVERY("2e-6"), FORCE},
      {"show: dispersion, field: velocity" EVERY("2e-6"), VELOCITY}}},
    {MATERIALS "chain: {" STRIKER
               ", beads: [{cell: [a, b], count: 12, spins: random}, {bead: b, count: 6}]}\nsweep: {magnetism: [0, 0.5], "
               "configurations: 3, seed: 3, measure: {decay: true}}\n",
     {4, -3, 6},
     {{"show: magnetism", NONE}, {"show: statistics", NONE}, {"show: configurations", NONE}, {"show: decay", NONE}}},
    /* u in lengths and times of its own. */
    {"chain: {equation: kdv, low: <-12|1 0 0>, length: <34|1 0 0>, points: 160, drift: <0.5|1 0 -1>, nonlinearity: <1|1 -1 -1>, "
     "dispersion: <1|3 0 -1>, start: {solitons: [{speed: <9|1 0 -1>, at: <-8|1 0 0>}]}}\nsimulate: {until: <0.08|0 0 1>}\n",
     {3, -2, 5},
     {{"show: sensors, beads: [20, 40], every: <0.007|0 0 1>", HEIGHT},
      {"show: profiles, at: [<0.0123|0 0 1>]", HEIGHT},
      {"show: measures, every: <0.001|0 0 1>", NONE},
      {"show: extremes, every: <0.01|0 0 1>", HEIGHT},
      {"show: modes, every: <0.01|0 0 1>", {0, 2, 0}}}},
    {"chain: {equation: fput, points: 16, alpha: <0.25|0 -1 0>, beta: <0.1|0 -2 0>, start: {mode: 1, amplitude: <1|0 1 0>}}\n"
     "simulate: {until: 40}\n",
     {0, 3, 0},
     {{"show: sensors, beads: [3, 7], every: 0.7", HEIGHT},
      {"show: profiles, at: [3.3], field: velocity", HEIGHT},
      {"show: measures", NONE},
      {"show: modes, every: 0.5", {0, 2, 0}}}},
    {"chain: {equation: shock, points: 60, speed: <2|1 0 -1>, epsilon: <0.2|1 -1 0>, length: <6.28|1 0 0>, start: {simple-wave: 1, "
     "amplitude: <0.5|-1 1 0>}}\nsimulate: {until: <2|0 0 1>}\n",
     {3, -2, 5},
     {{"show: sensors, beads: [20, 40], every: <0.07|0 0 1>", {-1, 1, 0}},
      {"show: profiles, at: [<1.1|0 0 1>], field: velocity", {0, 1, -1}},
      {"show: measures, every: <0.01|0 0 1>", NONE}}},
};

static double factor(size_t scene, struct dimension d)
{
    const struct dimension *by = &scenes[scene].by;
    return exp2(d.length * by->length + d.mass * by->mass + d.time * by->time);
}

/* The scene as it is, or scaled: its numbers are in angle brackets, each with the powers of its dimension. */
static void expand(size_t scene, const char *from, bool scaled, char *to, size_t size)
{
    size_t used = 0;
    while (*from && used + 64 < size) {
        double number;
        struct dimension d;
        int length = 0;
        if (sscanf(from, "<%lf|%lf %lf %lf>%n", &number, &d.length, &d.mass, &d.time, &length) == 4 && length > 0) {
            used += (size_t)snprintf(to + used, size - used, "%.17g", number * (scaled ? factor(scene, d) : 1));
            from += length;
        } else {
            to[used++] = *from++;
        }
    }
    to[used] = '\0';
    assert_true(*from == '\0');
}

static struct bead_session *play(size_t scene, bool scaled)
{
    static char text[8000], whole[8000];
    char path[600], out[600];
    size_t used = (size_t)snprintf(text, sizeof text, "%soutputs:\n", scenes[scene].scene);
    for (size_t i = 0; i < OUTPUTS_MOST && scenes[scene].outputs[i].output; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "  - {table: %zu.csv, %s}\n", i, scenes[scene].outputs[i].output);
    expand(scene, text, scaled, whole, sizeof whole);
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    snprintf(out, sizeof out, "%s/%d", directory, scaled);
    mkdir(out, 0777);
    write_text(path, whole);
    return play_session((struct bead_job){.input = path, .output = out, .threads = 1});
}

/* One field of a line of CSV, without its quotes; returns what follows it. */
static const char *take_field(const char *line, char *field, size_t size)
{
    bool quoted = false;
    size_t used = 0;
    for (; *line && *line != '\n' && (quoted || *line != ','); line++) {
        quoted = quoted != (*line == '"');
        if (*line != '"' && used + 1 < size)
            field[used++] = *line;
    }
    field[used] = '\0';
    return *line == ',' ? line + 1 : line;
}

static const struct dimension *find(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strlen(known[i].name) == length && strncmp(known[i].name, name, length) == 0)
            return &known[i].is;
    }
    return NULL;
}

static size_t without(const char *end, const char *name, size_t length)
{
    const size_t less = strlen(end);
    return length > less && strncmp(name + length - less, end, less) == 0 ? length - less : length;
}

/* That of a column: the longest end of its name that is known. */
static struct dimension of_column(const char *name, struct dimension plain)
{
    const size_t length = without("_error", name, without("_uncertainty", name, strlen(name)));
    for (size_t at = 0; at < length; at++) {
        const struct dimension *found = at == 0 || name[at - 1] == '_' ? find(name + at, length - at) : NULL;
        if (found)
            return *found;
    }
    return plain;
}

/* That of a measure, by its unit or its name. */
static struct dimension of_measure(const char *name, const char *unit)
{
    const struct dimension *found = *unit ? find(unit, strlen(unit)) : find(name, strlen(name));
    return found ? *found : (struct dimension)NONE;
}

/* Numbers agree to the rounding of logarithms, uncertainties to their three digits. */
static bool agree(const char *before, const char *after, double by, bool rough)
{
    char *end[2];
    const double x = strtod(before, &end[0]), y = strtod(after, &end[1]);
    if (!*before || !*after || *end[0] || *end[1])
        return strcmp(before, after) == 0;
    return fabs(y - by * x) <= (rough ? 0.01 : 1e-11) * fabs(by * x) || (isnan(x) && isnan(y));
}

/* Columns of a table that have a number other than 0 somewhere, or a word. */
static bool told[64];

static void compare_lines(size_t scene, size_t output, const char *header, const char *const line[2])
{
    char column[200], field[2][200], name[200] = "", unit[200] = "", *end = "";
    const char *at[2] = {line[0], line[1]};
    bool *tells = told;
    for (const char *rest = header; *rest;) {
        rest = take_field(rest, column, sizeof column);
        for (int s = 0; s < 2; s++)
            at[s] = take_field(at[s], field[s], sizeof field[s]);
        assert_true(*column);
        *tells = *tells || fabs(strtod(field[0], &end)) > 0 || *end;
        tells++;
        const bool rough = strstr(column, "uncertainty") != NULL;
        if (strcmp(column, "name") == 0)
            strcpy(name, field[0]);
        struct dimension d = of_column(column, scenes[scene].outputs[output].plain);
        if (strcmp(column, "value") == 0)
            take_field(at[0], unit, sizeof unit);
        if (*name && (strcmp(column, "value") == 0 || rough))
            d = of_measure(name, unit);
        if (strchr(column, '.') || strcmp(column, "curve") == 0)
            continue; /* settings of the scene, as it has them */
        if (!agree(field[0], field[1], factor(scene, d), rough))
            fail_msg("scene %zu, %s: %s %s: %s becomes %s", scene, scenes[scene].outputs[output].output, name, column, field[0],
                     field[1]);
    }
    if (*at[0] && *at[0] != '\n')
        fail_msg("scene %zu, %s: more fields than columns: %s", scene, scenes[scene].outputs[output].output, at[0]);
}

/* What one scene or another need not have: a kind of energy, a state, a threshold, a limit, an error of what is exact. */
static const char *const unsaid[] = {"wall_J",
                                     "gravity_J",
                                     "springs_J",
                                     "dissipated_J",
                                     "work_J",
                                     "state",
                                     "front_uncertainty",
                                     "found_Hz_uncertainty",
                                     "exact_Hz",
                                     "curve",
                                     "slope",
                                     "plateau",
                                     "threshold",
                                     "_exponent",
                                     "unit",
                                     "note"};

/* Each other column has a number or a word in some line. */
static void check_told(size_t scene, size_t output, const char *header)
{
    char column[200];
    const bool *tells = told;
    for (const char *rest = header; *rest; tells++) {
        bool may_be_silent = false;
        rest = take_field(rest, column, sizeof column);
        for (size_t i = 0; i < sizeof unsaid / sizeof *unsaid; i++)
            may_be_silent = may_be_silent || strstr(column, unsaid[i]);
        if (!*tells && !may_be_silent)
            fail_msg("scene %zu, %s: nothing in column %s", scene, scenes[scene].outputs[output].output, column);
    }
}

static void compare(size_t scene, size_t output)
{
    static char text[2][BYTES_MOST];
    char path[600], header[2000];
    for (int scaled = 0; scaled < 2; scaled++) {
        snprintf(path, sizeof path, "%s/%d/%zu.csv", directory, scaled, output);
        FILE *file = fopen(path, "r");
        assert_non_null(file);
        text[scaled][fread(text[scaled], 1, BYTES_MOST - 1, file)] = '\0';
        fclose(file);
    }
    const char *line[2] = {text[0], text[1]};
    snprintf(header, sizeof header, "%.*s", (int)strcspn(line[0], "\n"), line[0]);
    while (*line[0] && *line[1]) {
        compare_lines(scene, output, header, line);
        if (line[0] == text[0])
            memset(told, 0, sizeof told); /* names are no numbers */
        for (int s = 0; s < 2; s++) {
            line[s] += strcspn(line[s], "\n");
            line[s] += *line[s] == '\n';
        }
    }
    assert_true(!*line[0] && !*line[1]);
    check_told(scene, output, header);
}

static const struct {
    const char *name;
    size_t offset; /* of a number in struct bead_outcome */
    struct dimension is;
} numbers[] = {
#define NUMBER(name, is)                               \
    {                                                  \
#name, offsetof(struct bead_outcome, name), is \
    }
    NUMBER(end, TIME),
    NUMBER(front_arrival, TIME),
    NUMBER(step, TIME),
    NUMBER(predictable_until, TIME),
    NUMBER(energy_start, ENERGY),
    NUMBER(energy_end, ENERGY),
    NUMBER(energy_error, NONE),
    NUMBER(embedded_error, NONE),
    NUMBER(event_error, NONE),
    NUMBER(worst_contact, NONE),
    NUMBER(worst_bead, NONE),
    NUMBER(worst_force, FORCE),
    NUMBER(absorbed, ENERGY),
    NUMBER(worst_uncertainty, FORCE),
};

static double number_of(const struct bead_outcome *outcome, size_t i)
{
    return *(const double *)((const char *)outcome + numbers[i].offset);
}

/* What a run says of itself; equations have energies of their own. */
static void compare_runs(size_t scene, const struct bead_session *const session[2])
{
    size_t count = 0;
    const struct bead_outcome *a = bead_session_outcomes(session[0], &count), *b = bead_session_outcomes(session[1], &count);
    for (size_t c = 0; a && c < count; c++) {
        assert_int_equal(a[c].steps, b[c].steps);
        assert_int_equal(a[c].evaluations, b[c].evaluations);
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            const double x = number_of(&a[c], i), y = number_of(&b[c], i), f = factor(scene, numbers[i].is);
            const bool equations = strstr(scenes[scene].scene, "equation") && strncmp(numbers[i].name, "energy_", 7) == 0;
            if (!equations && !(y == f * x) && !(isnan(x) && isnan(y)))
                fail_msg("scene %zu, chain %zu: %s: %.17g becomes %.17g", scene, c, numbers[i].name, x, y);
        }
    }
    const struct bead_counts *before = bead_session_counts(session[0]), *after = bead_session_counts(session[1]);
    assert_int_equal(before->comparison_steps, after->comparison_steps);
    assert_int_equal(before->comparison_evaluations, after->comparison_evaluations);
    assert_int_equal(before->samples, after->samples);
    assert_int_equal(before->passes, after->passes);
}

static void numbers_scale_as_their_units_say(void **)
{
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        struct bead_session *const session[2] = {play(s, false), play(s, true)};
        compare_runs(s, (const struct bead_session *const *)session);
        for (size_t i = 0; i < OUTPUTS_MOST && scenes[s].outputs[i].output; i++)
            compare(s, i);
        for (int k = 0; k < 2; k++)
            bead_session_close(session[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_scale_as_their_units_say)};
    return cmocka_run_group_tests_name("scaled", tests, make_directory, remove_directory);
}
