/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and jobs that are refused, or given up, say why, with the numbers of the scene and of its run. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "sessions.h"
#include "tests/scratch.h"

#define BEADS       "beads: [{bead: large-steel, count: 9}]"
#define CHAIN       "chain: {" BEADS "}\n"
#define SENSOR      "chain: {beads: [{bead: large-steel, count: 9}, {bead: ptfe, sensor: end}]}\n"
#define UNTIL(text) "simulate: {until: " text "}\n"
#define SHOCK(keys) "chain: {equation: shock, points: 60, length: 6.28, " keys "}\n"
#define KDV(points)                                      \
    "chain: {equation: kdv, length: 34, points: " points \
    ", start: {solitons: [{speed: 16, at: 10}]}}\nsimulate: {until: 1, step: 0.5}\n"
static const struct {
    const char *scene, *output, *says;
} runs[] = {
    {CHAIN UNTIL("1 s"), "table: a.csv, show: extremes, every: 1e-12",
     "every: 1e-12 gives 1e+12 samples; at most 1e+10 are allowed"},
    {SENSOR UNTIL("1 ms"), "table: a.csv, show: spectrum, every: 0.1 ms",
     "segment: has 11 of 11 samples, every 0.0001; must have 16 or more, and no more than there are"},
    {SENSOR UNTIL("1 ms"), "table: a.csv, show: spectrum, every: 1 us, segment: 2 ms",
     "segment: has 2000 of 1001 samples, every 1e-06; must"},
    {"chain: {damping: {coefficient: 1, exponent: 1}, " BEADS "}\nsimulate: {until: 1 ms, method: rkn8}\n", "table: a.csv",
     "simulate.method: `rkn8` is for forces without damping; must be auto, rk8 or rk4 here"},
    {"chain: {law: {fpu-alpha: 1e6, stiffness: 1e7}, " BEADS "}\n" UNTIL("1 ms"), "table: a.csv",
     " s the spring of contact 0 has collapsed: beyond a compression of 1 / alpha"},
    {CHAIN "simulate: {until: 10 ms, step: 1e-15}\n", "table: a.csv",
     "simulate.step: gives 1e+13 steps; must be at least 1e-14 s for this"},
    {"chain: {precompression: 1 N, beads: [{bead: ptfe, count: 20000}]}\n" UNTIL("1 ms"), "table: a.csv, show: eigenmodes",
     "eigenmodes of 20001 beads: at most 20000 are found"},
    {SHOCK("epsilon: 0.5, start: {simple-wave: 1, amplitude: 0.5}") "simulate: {until: 1, step: 0.5}\n",
     "table: a.csv, show: measures", "simulate.step: 0.5 is too long for cells of 0.105: at most 0.0"},
    {SHOCK("epsilon: 0.5, start: {simple-wave: 3, amplitude: 0.9}") UNTIL("50"), "table: a.csv, show: measures",
     ", before the wave breaks, a grid of 60 points has lost 0.002 of its energy, more than 0.002: it needs more points"},
    {KDV("60"), "table: a.csv, show: measures",
     "a grid of 60 points is too coarse for the start: it loses 0.035 of the integral of u^2"},
    {KDV("320"), "table: a.csv, show: measures", "at 0.5 the integral of u^2 has a relative error of "},
    {KDV("320"), "table: a.csv, show: measures", ": steps of 0.5 are too long, or a grid of 320 points is too coarse"},
    {"chain: {equation: fput, points: 16, alpha: 9, start: {mode: 1, amplitude: 1}}\n" UNTIL("40"), "table: a.csv, show: modes",
     " the energy of the string has a relative error of "},
    {"chain: {equation: fput, points: 16, alpha: 900, start: {mode: 1, amplitude: 100}}\n" UNTIL("40"), "table: a.csv, show: modes",
     " the energy of the string has a relative error of inf: a spring has torn"}, /* it has overflowed */
    {"chain: {drive: {force: '0 0', amplitude: 1 N}, " BEADS "}\n" UNTIL("1 ms"), "table: a.csv",
     "chain.drive.force: has 1 points; must be "},
    {"materials: {m: {density: 1e-5 kg/m3, radius: 1e-9 m, modulus: 1 GPa, poisson: 0.3}}\n" CHAIN, "table: a.csv", /* 4 pi / 3 */
     "materials.m.density: gives a mass of 4.19e-32 kg; must be from 1e-30 to 1e15 kg"},
    {CHAIN UNTIL("1 ms"), "trajectory: a.h5, beads: [12, 14]", "outputs.0.beads.0: is 12, but the last bead is 9"},
};

/* What there is: trajectories of ten beads, of six, and of an equation, and a sweep. */
static const struct {
    const char *scene, *output;
} files[] = {
    {CHAIN UNTIL("0.1 ms"), "trajectory: ten.h5, every: 10 us, fields: [velocity]"},
    {"chain: {beads: [{bead: large-steel, count: 5}]}\n" UNTIL("0.1 ms"), "trajectory: six.h5, every: 30 us"},
    {"chain: {equation: fput, points: 16, alpha: 0.1, start: {mode: 1, amplitude: 1}}\n" UNTIL("4"),
     "trajectory: string.h5, every: 1"},
    {"sweep: {cells: 4, configurations: 1, magnetism: 0}\n", "sweep: swept.h5"},
    {CHAIN UNTIL("0.1 ms"), "table: a.csv, show: extremes"},
};
static const struct {
    const char *input, *output, *other, *setting;
    bool sheet, difference, part;
    const char *says;
} jobs[] = {
    {"ten.h5", NULL, NULL, NULL, false, false, false,
     "ten.h5 is a trajectory: say what to draw with -o FILE (png, pdf, svg, mp4, ...)"},
    {"ten.h5", "a.csv", NULL, "outputs.0={table: a.csv, show: peaks}", false, false, false,
     "a.csv: peaks are found while simulating, not from samples: run the scene"},
    {"ten.h5", "a.csv", NULL, "outputs.0={table: a.csv, show: extremes, field: displacement}", false, false, false,
     "needs the field `displacement`, which "},
    {"ten.h5", "a.csv", NULL, "outputs.0={table: a.csv, show: measures}", false, false, false,
     "needs the fields `contact-force, displacement`, "},
    {"ten.h5", "a.csv", NULL, "outputs.0={table: a.csv, show: extremes, field: velocity, time: [0.2 ms, auto]}", false, false,
     false, "outputs.0.time: begins at 0.0002 s; must begin before the run ends at 0.0001 s"},
    {"ten.h5", "a.csv", NULL, "outputs.0={table: a.csv, show: extremes, field: velocity, time: [11 us, 12 us]}", false, false,
     false, "time: there are no samples from 1.1e-05 to 1.2e-05"},
    {"ten.h5", "a.csv", NULL, NULL, false, false, true, "--shard: "},
    {"ten.h5", "a.csv", NULL, NULL, true, false, false, "ten.h5 is the trajectory of a single run"},
    {"ten.h5", "a.csv", "string.h5", NULL, false, false, false, "string.h5: is of an equation, and "},
    {"string.h5", "a.csv", "ten.h5", NULL, false, false, false, "ten.h5: is of beads, and "},
    {"ten.h5", "a.csv", "six.h5", NULL, false, true, false,
     "--diff: needs two trajectories of as many chains, each of as many beads: "},
    {"swept.h5", NULL, NULL, NULL, false, false, false, "swept.h5 is the file of a sweep: say what to draw with -o FILE"},
    {"swept.h5", "a.csv", NULL, NULL, false, false, true, "swept.h5 is computed already"},
    {"swept.h5", "a.csv", "ten.h5", NULL, false, false, false, "only trajectories are shown together"},
    {"swept.h5", "a.csv", NULL, NULL, false, true, false, "--diff: needs two trajectories, as in "},
    {"swept.h5", "a.csv", "ten.h5", NULL, false, true, false, "only trajectories are shown together"},
    {"scene.yaml", "a.csv", "ten.h5", NULL, false, false, false, "only trajectories are shown together"},
    {"none.yaml", "a.csv", "ten.h5", NULL, false, false, false, "none.yaml: cannot be read: "},
    {"scene.yaml", "a.csv", NULL, NULL, false, false, true, "scene.yaml has no sweep to divide"},
    {"scene.yaml", "b.h5", NULL, "outputs.0={trajectory: b.h5, beads: [3, 12]}", false, false, false,
     "beads.1: is 12, but the last bead is 9"},
};

static enum bead_error play(struct bead_job job, struct bead_message *msg)
{
    static const struct bead_sink_type *const *sinks[2];
    struct bead_session *session = NULL;
    sinks[0] = bead_data_sinks();
    job.size = sizeof job;
    job.threads = 1;
    job.sinks = sinks;
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    return err;
}

static enum bead_error play_scene(const char *scene, const char *output, struct bead_message *msg)
{
    char path[512], text[1000];
    snprintf(text, sizeof text, "%soutputs: [{%s}]\n", scene, output);
    write_scene(text, path);
    return play((struct bead_job){.input = path, .output = directory}, msg);
}

static void what_cannot_be_run_says_why(void **)
{
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        struct bead_message msg = {""};
        if (!play_scene(runs[i].scene, runs[i].output, &msg) || !strstr(msg.text, runs[i].says))
            fail_msg("%s: '%s', not '%s'", runs[i].output, msg.text, runs[i].says);
    }
}

static void what_cannot_be_asked_says_why(void **)
{
    char path[3][600];
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        struct bead_message msg = {""};
        if (play_scene(files[i].scene, files[i].output, &msg))
            fail_msg("%s", msg.text);
    }
    for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
        struct bead_message msg = {""};
        const char *const names[] = {jobs[i].input, jobs[i].output, jobs[i].other}, *const other = path[2];
        for (int k = 0; k < 3; k++)
            snprintf(path[k], sizeof path[k], "%s/%s", directory, names[k] ? names[k] : "");
        struct bead_job job = {.input = path[0],
                               .output = jobs[i].output ? path[1] : NULL,
                               .others = &other,
                               .other_count = jobs[i].other != NULL,
                               .settings = &jobs[i].setting,
                               .setting_count = jobs[i].setting != NULL,
                               .sheet = jobs[i].sheet,
                               .difference = jobs[i].difference,
                               .part = jobs[i].part,
                               .parts = 2 * (size_t)jobs[i].part};
        if (!play(job, &msg) || !strstr(msg.text, jobs[i].says))
            fail_msg("job %zu, %s: '%s', not '%s'", i, jobs[i].input, msg.text, jobs[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_cannot_be_run_says_why),
                                       cmocka_unit_test(what_cannot_be_asked_says_why)};
    return cmocka_run_group_tests_name("reasons", tests, make_directory, remove_directory);
}
