/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a plan tells is what the run then does: steps, method, end, samples, and runs that are made for comparison. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "beadreel/chain.h"
#include "beadreel/play.h"
#include "beadreel/render.h"
#include "sessions.h"
#include "tests/scratch.h"

#define BEADS "chain: {beads: [{cell: [large-steel, ptfe], count: 6, spins: \"110101\"}]}\n"
#define TWO                                                                                                       \
    "chains: [{name: A, beads: [{bead: brass, count: 9}]}, {name: B, striker: {velocity: 1 m/s}, beads: [{bead: " \
    "ptfe, count: 4}]}]\n"
#define FIXED(until) "simulate: {until: " until ", step: 0.5 us, method: rk4}\n"
#define WHOLE(until) "simulate: {until: " until "}\n"
static const struct {
    const char *scene, *outputs, *says[3]; /* lines of the plan, whole or their beginnings */
} cases[] = {
    {BEADS FIXED("60 us"),
     "{table: 0.csv, show: sensors, beads: 3, every: 3 us, time: [5 us, 40 us]}",
     {"time: stops at 0.04 ms of 0.06 ms: no output needs more\n",
      "  samples: force of beads 3 to 3, 12 times every 3 us until 0.04 ms\n", "check run: uncertainties of "}},
    {BEADS FIXED("60 us"),
     "{table: 0.csv, show: sensors, beads: 3, every: 3 us, uncertainty: false}",
     {"time: 0.06 ms as asked\n", "  samples: force of beads 3 to 3, 21 times every 3 us until 0.06 ms\n"}},
    {BEADS FIXED("60 us"),
     "{table: 0.csv, show: peaks}",
     {"time: 0.06 ms as asked\n", "  samples: none\n", "comparison run: uncertainties of "}},
    {BEADS FIXED("60 us"),
     "{table: 0.csv, show: bead-peaks, uncertainty: false}",
     {"  maxima of every bead's force, found between steps\n"}},
    {BEADS,
     "{table: 0.csv, show: peaks}",
     {"time: until the first pulse has passed the end; no output needs the end time in advance: no scouting run\n",
      "  maxima of every contact's force until the front reaches the end, found between steps\n",
      "comparison run: uncertainties of "}},
    {BEADS,
     "{table: 0.csv, show: extremes, field: velocity, every: 10 us}",
     {"time: until the first pulse has passed the end, at "}},
    {BEADS, "{table: 0.csv, show: profiles, at: [3 ms]}", {"time: until 3 ms, the latest that an output asks for\n"}},
    {BEADS WHOLE("0.1 ms"),
     "{table: 0.csv, show: measures}",
     {"time: 0.1 ms as asked\n", "  samples: ", "check run: uncertainties of "}},
    {TWO WHOLE("2 ms"),
     "{table: 0.csv, show: energy, every: 0.25 ms}",
     {"time: 2 ms as asked\n", "accuracy: 1e-11 instead of the default, for ", "  samples: "}},
    {TWO WHOLE("0.2 ms"), "{table: 0.csv, show: sensitivities, contacts: [1]}", {"sensitivities of "}},
    {TWO WHOLE("0.2 ms"),
     "{trajectory: 0.h5, every: 10 us, beads: [1, 3]}",
     {"  samples: force, contact-force, velocity, displacement of beads 0 to 3, 21 times every 10 us until 0.2 ms\n"}},
    {"chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n" WHOLE("40"),
     "{table: 0.csv, show: modes, every: 5}",
     {"time: 40 as asked\n", "  samples: velocity, displacement of points 0 to 15, 9 times every 5 until 40\n"}},
    {"chain: {equation: shock, points: 60, epsilon: 0.5, length: 6.28, start: {simple-wave: 1, amplitude: 1}}\n" WHOLE("2"),
     "{table: 0.csv, show: measures}",
     {"check run: uncertainties of "}},
};

static bool has_line(const char *plan, const char *line)
{
    const char *found = strstr(plan, line);
    return found && (found == plan || found[-1] == '\n');
}

/* The number behind these words; NaN: they are not there. */
static double behind(const char *plan, const char *words)
{
    const char *found = strstr(plan, words);
    return found ? strtod(found + strlen(words), NULL) : NAN;
}

static bool to_digits(double said, double value, double digits)
{
    return fabs(said - value) <= 0.51 * pow(10, ceil(log10(fabs(value))) - digits);
}

/* "chain A: 10 beads, 9 contacts; rkn8 (why) with steps from 6.331 us, at most about 158 of them" */
static void chain_is_run(const char *line, const struct bead_chain *chain, const struct bead_outcome *run)
{
    char words[128];
    const char *const name = bead_chain_name(chain), *end = strchr(line, '\n');
    const bool fixed = strstr(line, "with steps of ") && strstr(line, "with steps of ") < end;
    snprintf(words, sizeof words, "chain %s%s", name, *name ? ": " : "");
    assert_int_equal(strncmp(line, words, strlen(words)), 0);
    snprintf(words, sizeof words, "%zu ", bead_chain_beads(chain));
    assert_non_null(strstr(line, words));
    snprintf(words, sizeof words, "; %s ", run->method);
    assert_non_null(strstr(line, words));
    const char *const step = strstr(line, fixed ? "with steps of " : "with steps from ");
    char *unit;
    const double said = strtod(step + strlen(fixed ? "with steps of " : "with steps from "), &unit);
    assert_true(to_digits(said, run->step * (strncmp(unit, " us", 3) == 0 ? 1e6 : strncmp(unit, " ms", 3) == 0 ? 1e3 : 1), 4));
    const double most = strtod(memchr(unit, ',', (size_t)(end - unit)) ? strpbrk(strchr(unit, ','), "0123456789") : "nan", NULL);
    if (isfinite(most)) /* steps that grow where forces are small */
        assert_true((double)run->steps <= (fixed ? most + 1 : 1.01 * most + 1) && (double)run->steps >= (fixed ? 1 : 0.1) * most);
}

static void chains_are_run(const char *plan, const struct bead_session *session)
{
    size_t count = 0;
    const struct bead_chain *const *chains = bead_session_chains(session, &count);
    const struct bead_outcome *runs = bead_session_outcomes(session, &count);
    for (size_t i = 0; i < count; i++, plan = strchr(plan, '\n') + 1)
        chain_is_run(plan, chains[i], &runs[i]);
}

static void time_is_run(const char *plan, const struct bead_outcome *run)
{
    const char *const line = strstr(plan, "\ntime: ") + 1, *const digit = strpbrk(line, "0123456789");
    char *unit = "";
    const double end = digit && digit < strchr(line, '\n') ? strtod(digit, &unit) : NAN;
    const double unit_of = strncmp(unit, " ms", 3) == 0 ? 1e-3 : 1;
    if (isfinite(end)) /* and at most a step more */
        assert_true(run->end >= unit_of * end * (1 - 1e-5) && run->end <= unit_of * end * (1 + 1e-5) + run->step);
}

/* A comparison of a run with fixed steps has steps as long as the plan says. */
static void comparisons_are_run(const char *plan, const struct bead_session *session)
{
    size_t count = 0;
    const struct bead_counts *counts = bead_session_counts(session);
    const struct bead_outcome *run = bead_session_outcomes(session, &count);
    const double longer = fmin(behind(plan, "for comparison: steps of ") * 1e-6 / run->step, behind(plan, "once more, with "));
    const bool again = has_line(plan, "comparison run: ") || has_line(plan, "check run: ") || has_line(plan, "sensitivities of ");
    assert_int_equal(counts->comparison_steps > 0, again);
    assert_int_equal(run->contact_uncertainty || run->bead_uncertainty, has_line(plan, "comparison run: "));
    if (again && strstr(plan, "with steps of ") && !strstr(plan, " of the tolerance"))
        assert_true(fabs((double)counts->comparison_steps - (double)run->steps / longer) <= 2);
    assert_int_equal(counts->passes, 1 + (strstr(plan, "found by a scouting run") || strstr(plan, "the latest that")));
    const char *const samples = strstr(plan, "\n  samples: ") + 1, *const line = strndupa(samples, strcspn(samples, "\n")),
                      *const times = strstr(line, " time");
    const double planned = times ? behind(strrchr(strndupa(line, (size_t)(times - line)), ','), ", ") : 0;
    assert_true((double)counts->samples == (double)count * planned);
    assert_int_equal(counts->samples == 0, has_line(plan, "skipped: samples"));
}

static struct bead_session *play(size_t i, char **plan)
{
    char path[512], text[1200];
    struct bead_message msg = {""};
    struct bead_session *session = NULL;
    size_t size;
    snprintf(text, sizeof text, "%soutputs: [%s]\n", cases[i].scene, cases[i].outputs);
    write_scene(text, path);
    static const struct bead_sink_type *const *sinks[2];
    sinks[0] = bead_data_sinks();
    struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .threads = 1, .sinks = sinks};
    FILE *file = open_memstream(plan, &size);
    if (bead_session_open(&job, &session, &msg) || bead_session_plan(session, file, &msg) || bead_session_run(session, &msg))
        fail_msg("%s: %s", cases[i].outputs, msg.text);
    fclose(file);
    return session;
}

static void runs_are_as_planned(void **)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *plan = NULL;
        size_t count;
        struct bead_session *session = play(i, &plan);
        for (size_t k = 0; k < 3 && cases[i].says[k]; k++) {
            if (!has_line(plan, cases[i].says[k]))
                fail_msg("'%s' is not in '%s'", cases[i].says[k], plan);
        }
        chains_are_run(plan, session);
        time_is_run(plan, bead_session_outcomes(session, &count));
        comparisons_are_run(plan, session);
        bead_session_close(session);
        free(plan);
    }
}

/* The plan of a job with all sinks; to be freed. */
static char *plan_of(struct bead_job job)
{
    static const struct bead_sink_type *const *sinks[3];
    struct bead_message msg = {""};
    struct bead_session *session = NULL;
    char *plan = NULL;
    size_t size;
    sinks[0] = bead_data_sinks();
    sinks[1] = bead_render_sinks();
    job.size = sizeof job;
    job.threads = 1;
    job.sinks = sinks;
    FILE *file = open_memstream(&plan, &size);
    if (bead_session_open(&job, &session, &msg) || bead_session_plan(session, file, &msg))
        fail_msg("%s", msg.text);
    fclose(file);
    bead_session_close(session);
    return plan;
}

/* A picture of a stored run shows forces, which follow from displacements where nothing is damped, or else what there is. */
static void stored_runs_show_what_they_hold(void **)
{
    static const struct {
        const char *damping, *fields, *shown;
    } stored[] = {{"", "force", "force"},
                  {"", "displacement", "force"},
                  {"", "velocity", "velocity"},
                  {"damping: {coefficient: 1}, ", "displacement", "displacement"},
                  {"damping: {coefficient: 1}, ", "force, displacement", "force"}};
    char scene[512], run[600], picture[600], text[1000], expected[100];
    snprintf(run, sizeof run, "%s/0.h5", directory);
    snprintf(picture, sizeof picture, "%s/0.png", directory);
    for (size_t i = 0; i < sizeof stored / sizeof *stored; i++) {
        snprintf(
            text, sizeof text,
            "chain: {%sbeads: [{bead: large-steel, count: 5}]}\nsimulate: {until: 50 us}\noutputs: [{trajectory: 0.h5, every: 5 "
            "us, fields: [%s]}]\n",
            stored[i].damping, stored[i].fields);
        write_scene(text, scene);
        play_counts((struct bead_job){.input = scene, .output = directory, .threads = 1});
        char *plan = plan_of((struct bead_job){.input = run, .output = picture});
        snprintf(expected, sizeof expected, "  samples: %s of beads 0 to 5, 11 times every 5 us until 0.05 ms", stored[i].shown);
        if (!has_line(plan, expected) || !has_line(plan, "time: samples of a run of 0.05 ms are read; nothing is simulated\n"))
            fail_msg("'%s' is not in '%s'", expected, plan);
        free(plan);
    }
}

/* A file that is asked for by its name alone is made like an output of the scene that can be one of its kind, else as by default: a
 * film from a film, pixels from any still, a page for print from another one. */
static void files_are_made_like_those_of_the_scene(void **)
{
    static const struct {
        const char *output, *file;
        bool like;
        const char *look;
    } pairs[] = {
        {"image: a.png", "b.png", true, NULL},
        {"image: a.png", "b.webp", true, NULL},
        {"image: a.png", "a.pdf", false, NULL},
        {"image: a.png", "b.svg", false, NULL},
        {"image: a.pdf", "b.svg", true, NULL},
        {"image: a.pdf", "b.jpg", true, NULL},
        {"image: a.png", "b.mp4", false, NULL},
        {"movie: a.mp4", "b.mp4", true, NULL},
        {"movie: a.mp4", "b.webm", true, NULL},
        {"movie: a.mp4", "b.gif", true, NULL},
        {"movie: a.gif", "b.mp4", true, NULL},
        {"movie: a.mp4", "b.pdf", false, NULL},
        {"plot: a.svg", "b.pdf", true, NULL},
        {"plot: a.png", "b.pdf", false, NULL},
        {"table: a.csv, show: sensors", "b.csv", true, NULL},
        {"plot: a.svg", "b.csv", false, NULL},
        {"movie: a.mp4", "b.csv", false, NULL},
        {"plot: a.pdf, panels: [[{field: velocity}]]", "b.pdf", true, "--colormap=grey"},
        {"image: a.png", "b.webp", true, "--colormap=grey"},
        {"image: a.pdf, panels: [[{field: velocity}, {field: energy}], [{field: velocity}]]", "b.pdf", true, "--colormap=grey"},
        {"plot: a.svg", "b.svg", false, "--colormap=grey"}};
    char scene[512], run[600], file[600], text[1000];
    const char *const only = "run.h5";
    snprintf(run, sizeof run, "%s/run.h5", directory);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        snprintf(text, sizeof text,
                 "chain: {beads: [{bead: large-steel, count: 5}, {bead: brass, sensor: s}]}\nsimulate: {until: 50 us}\n"
                 "outputs: [{trajectory: run.h5, every: 1 us, fields: all}, {%s%s}]\n",
                 pairs[i].output, strstr(pairs[i].output, "field") ? "" : ", field: velocity");
        write_scene(text, scene);
        play_counts((struct bead_job){.input = scene, .output = directory, .threads = 1, .only = &only, .only_count = 1});
        snprintf(file, sizeof file, "%s/%s", directory, pairs[i].file);
        char *plan =
            plan_of((struct bead_job){.input = run, .output = file, .looks = &pairs[i].look, .look_count = pairs[i].look != NULL});
        if (!strstr(plan, "velocity") == pairs[i].like)
            fail_msg("%s of %s: %s", pairs[i].file, pairs[i].output, plan);
        free(plan);
    }
}

/* A frame is one of the scene's film, or of that of a setting which replaces all outputs. */
static void frames_are_of_films(void **)
{
    static const struct {
        const char *setting, *frame, *says[2];
    } frames[] = {{NULL, "20us", {"/a-20us.png: one frame ", "velocity"}},
                  {NULL, "50%", {"/a-50percent.png: one frame ", "velocity"}},
                  {"outputs=[{table: c.csv}, {movie: b.mp4, field: energy}]", "20us", {"/b-20us.png: one frame ", "energy"}},
                  {"outputs.1.field=energy", "peak", {"/a-peak.png: one frame ", "energy"}}};
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++) {
        char scene[512];
        write_scene("chain: {beads: [{bead: large-steel, count: 5}]}\nsimulate: {until: 50 us}\n"
                    "outputs: [{table: c.csv}, {movie: a.mp4, field: velocity}]\n",
                    scene);
        char *plan = plan_of((struct bead_job){.input = scene,
                                               .output = directory,
                                               .frame = frames[i].frame,
                                               .settings = &frames[i].setting,
                                               .setting_count = frames[i].setting != NULL});
        if (!strstr(plan, frames[i].says[0]) || !strstr(plan, frames[i].says[1]))
            fail_msg("%s", plan);
        free(plan);
    }
}

/* Pictures without room are refused before a chain is run, wherever they are among the outputs of a sweep. */
static void pictures_of_sweeps_are_looked_at_first(void **)
{
    static const char *const outputs[] = {"{sheet: a.png, size: [20, 10]}, {table: b.csv}",
                                          "{table: b.csv}, {plot: a.png, size: [30, 20]}"};
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), bead_render_sinks(), NULL};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        char path[512], text[400];
        struct bead_message msg = {""};
        struct bead_session *session = NULL;
        snprintf(text, sizeof text, "sweep: {cells: 4, configurations: 1, magnetism: 0}\noutputs: [%s]\n", outputs[i]);
        write_scene(text, path);
        struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .threads = 1, .sinks = sinks};
        assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_ERROR_SCENE);
        assert_non_null(strstr(msg.text, "size: "));
    }
}

/* An output takes the samples of a trajectory in the same scene where these hold all that it shows, and no fewer than it needs. */
static void samples_are_shared_where_they_suffice(void **)
{
#define PRESSED                                                                                                               \
    "chain: {precompression: 1 N, wall: brass, beads: [{cell: [large-steel, aluminium], count: 5}, {bead: ptfe, sensor: s}, " \
    "{bead: small-steel, count: 4}]}\nsimulate: {until: 150 us}\n"
#define STRING "chain: {equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\nsimulate: {until: 20}\n"
    static const struct {
        const char *scene, *trajectory, *output;
        bool shared;
    } pairs[] = {{PRESSED, "every: 4 us", "image: a.png", true},
                 {PRESSED, "every: 8 us", "image: a.png", false},
                 {PRESSED, "every: 1 us, time: [0, 100 us]", "image: a.png, time: [0, 100 us]", true},
                 {PRESSED, "every: 1 us, time: [0, 100 us]", "image: a.png, time: [0, 101 us]", false},
                 {PRESSED, "every: 1 us, time: [0, 100 us]", "image: a.png", false},
                 {PRESSED, "every: 1 us, time: [10 us, 100 us]", "image: a.png, time: [10 us, 100 us]", true},
                 {PRESSED, "every: 1 us, time: [10 us, 100 us]", "image: a.png, time: [9 us, 100 us]", false},
                 {PRESSED, "every: 1 us, beads: [2, 9]", "image: a.png, beads: [2, 9]", true},
                 {PRESSED, "every: 1 us, beads: [2, 9]", "image: a.png, beads: [1, 9]", false},
                 {PRESSED, "every: 1 us, beads: [2, 9]", "image: a.png, beads: [2, 10]", false},
                 {PRESSED, "every: 1 us, fields: [velocity]", "image: a.png, field: velocity", true},
                 {PRESSED, "every: 1 us, fields: [velocity]", "image: a.png", false},
                 /* forces follow from the displacements of all beads */
                 {PRESSED, "every: 1 us, fields: [displacement]", "image: a.png", true},
                 {PRESSED, "every: 1 us, fields: [displacement]", "image: a.png, field: energy", false},
                 {PRESSED, "every: 1 us, fields: [displacement], beads: [0, 9]", "image: a.png, beads: [0, 9]", false},
                 {PRESSED, "every: 1 us, fields: [displacement], beads: [1, last]", "image: a.png, beads: [1, last]", false},
                 {PRESSED, "every: 1 us, fields: [force]", "table: a.csv, show: sensors, contacts: [3]", false},
                 {PRESSED, "every: 1 us, fields: [contact-force, force]", "table: a.csv, show: sensors, contacts: [3]", true},
                 {PRESSED, "every: 1 us, fields: [force]", "table: a.csv, show: sensors", true},
                 {PRESSED, "every: 1 us, fields: [force]", "table: a.csv, show: sensors, every: 2 us", false},
                 {PRESSED, "every: 1 us, fields: [energy]", "plot: a.svg, show: spreading", false},
                 {STRING, "every: 0.1, fields: [displacement]", "table: a.csv, show: modes", false},
                 {STRING, "every: 0.1, fields: [displacement, velocity]", "table: a.csv, show: modes", true},
                 {STRING, "every: 0.1, fields: [displacement]", "movie: a.mp4, views: [modes]", false},
                 {STRING, "every: 0.1, fields: [displacement, velocity]", "movie: a.mp4, views: [modes]", true},
                 {STRING, "every: 0.1, fields: [displacement]", "movie: a.mp4, views: [spacetime]", true}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        char path[512], text[1000];
        snprintf(text, sizeof text, "%soutputs: [{%s}, {trajectory: 0.h5, %s}]\n", pairs[i].scene, pairs[i].output,
                 pairs[i].trajectory);
        write_scene(text, path);
        char *plan = plan_of((struct bead_job){.input = path, .output = directory});
        if (!strstr(plan, "(shared with the trajectory)") == pairs[i].shared)
            fail_msg("%s: %s", text, plan);
        free(plan);
    }
}

/* More numbers than are transformed at once, of few samples of many curves or of many samples of few, are counted and refused. */
static void spectra_of_too_many_numbers_are_refused(void **)
{
    static const char *const outputs[] = {"beads: [1, 2, 3, 4], every: 50 ns", "beads: [1], every: 10 ns"};
    static const char *const says[] = {"gives 20000001 samples of 4 curves; at most 67108864 numbers",
                                       "gives 100000001 samples of 1 curves; at most 67108864 numbers"};
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), NULL};
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        char path[512], text[400];
        struct bead_message msg = {""};
        struct bead_session *session = NULL;
        snprintf(text, sizeof text, BEADS "simulate: {until: 1 s}\noutputs: [{table: 0.csv, show: spectrum, %s}]\n", outputs[i]);
        write_scene(text, path);
        struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .threads = 1, .sinks = sinks};
        assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_ERROR_SCENE);
        if (!strstr(msg.text, says[i]))
            fail_msg("%s", msg.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(runs_are_as_planned),
                                       cmocka_unit_test(stored_runs_show_what_they_hold),
                                       cmocka_unit_test(samples_are_shared_where_they_suffice),
                                       cmocka_unit_test(frames_are_of_films),
                                       cmocka_unit_test(spectra_of_too_many_numbers_are_refused),
                                       cmocka_unit_test(files_are_made_like_those_of_the_scene),
                                       cmocka_unit_test(pictures_of_sweeps_are_looked_at_first)};
    return cmocka_run_group_tests_name("plan", tests, make_directory, remove_directory);
}
