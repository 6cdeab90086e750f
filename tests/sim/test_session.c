/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene computes only what it needs, as counts of evaluations, samples and files prove; and results do not depend on other
 * requests. */
#include "support.h"

#include "scratch.h"

#include <sys/stat.h>

#include "beadreel/render.h"
#include "beadreel/trajectory.h"
#include "sessions.h"
#include "sim/session/session_data.h"

static bool is_there(const char *name)
{
    char path[768];
    struct stat found;
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return stat(path, &found) == 0;
}

/* Run a scene text into `directory`. */
static struct bead_counts play(const char *text, struct bead_job job)
{
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    char path[512];
    write_scene(text, path);
    job.input = path;
    job.output = directory;
    job.sinks = lists;
    return play_counts(job);
}

#define CHAIN "chain: {beads: [{cell: [large-steel, aluminium], count: 34}], wall: brass}\n"
#define DRIFTING                                                                                                               \
    "materials: {light: {density: 3393.2, modulus: 257 GPa, poisson: 0.125, radius: 1.34 mm},\n"                               \
    "  soft: {density: 9840.9, modulus: 0.968 GPa, poisson: 0.065, radius: 2.53 mm},\n"                                        \
    "  heavy: {density: 1687.6, modulus: 493 GPa, poisson: 0.231, radius: 13.1 mm}}\n"                                         \
    "chain: {striker: {bead: soft, velocity: 0.051 m/s}, wall: rigid, precompression: 0.1 N,\n"                                \
    "  beads: [{cell: [soft, light, soft, light, soft, 2 light, soft, light, heavy, soft, light, soft, light, soft, 2 heavy]," \
    "  count: 6}]}\n"
#define ONE_MS CHAIN "simulate: {until: 1 ms, method: rkn8, step: 1 us}\n"

static void a_table_of_peaks_takes_no_samples(void **state)
{
    (void)state;
    struct bead_counts counts = play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){0});
    assert_int_equal(counts.samples, 0);
    assert_int_equal(counts.sample_values, 0);
    assert_int_equal(counts.passes, 1);
    assert_int_equal(counts.steps, 1000);
    assert_true(is_there("peaks.csv"));
    assert_false(is_there("run.h5"));
}

static void peaks_of_a_first_passage_need_no_scouting(void **state)
{
    (void)state;
    struct bead_counts counts = play(CHAIN "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){0});
    assert_int_equal(counts.passes, 1);
    struct bead_counts both =
        play(CHAIN "outputs: [{table: peaks.csv, show: peaks}, {trajectory: run.h5, every: 5 us}]\n", (struct bead_job){0});
    assert_int_equal(both.passes, 2);
    assert_true(both.state_hash == counts.state_hash);
}

/* Work of the comparison runs of a table of peaks, in units of the run. */
static double comparison_work(const char *chain, const char *simulate)
{
    char text[4096];
    snprintf(text, sizeof text, "%s%soutputs: [{table: peaks.csv, show: peaks}]\n", chain, simulate);
    const struct bead_counts counts = play(text, (struct bead_job){0});
    assert_true(counts.comparison_steps > 0);
    return (double)counts.comparison_evaluations / (double)counts.evaluations;
}

/* The peak in the last row of the table. */
static double last_peak(void)
{
    char path[512], line[256];
    double peak = NAN;
    snprintf(path, sizeof path, "%s/peaks.csv", directory);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        sscanf(line, "%*[^,],%lf", &peak);
    fclose(file);
    return peak;
}

/* If only the last contacts are requested, beads far behind the front are dropped, unless another output shows them. A clean chain
 * then costs about the same per bead, whatever its length. */
static void beads_behind_the_front_are_dropped(void **state)
{
    (void)state;
    static const struct {
        const char *chain, *more;
        double part; /* of the evaluations */
    } cases[] = {{"beads: [{bead: large-steel, count: 600}]", "", 0.15},
                 {"beads: [{cell: [large-steel, aluminium], count: 300}]", "", 0.15},
                 {"beads: [{cell: [large-steel, aluminium], count: 300, spins: random, seed: 4}]", "", 0.6},
                 {"beads: [{bead: large-steel, count: 600}], precompression: 1 N", "", 1},
                 {"beads: [{bead: large-steel, count: 600}]", ", {table: measures.csv, show: measures}", 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        const char *const format = "chain: {%s}\noutputs: [{table: peaks.csv%s}%s]\n";
        snprintf(text, sizeof text, format, cases[i].chain, "", cases[i].more);
        const uint64_t whole = play(text, (struct bead_job){0}).evaluations;
        const double peak = last_peak();
        snprintf(text, sizeof text, format, cases[i].chain, ", contacts: [598, 599]", cases[i].more);
        const uint64_t cut = play(text, (struct bead_job){0}).evaluations;
        assert_near(last_peak() / peak, 1, 1.5e-8);
        if (cases[i].part < 1)
            assert_true((double)cut < cases[i].part * (double)whole);
        else
            assert_true(cut == whole);
    }
}

/* A second run gives the uncertainty of peaks, with fewer steps than the first, even if a few peaks respond strongly, as at 1e-6 in
 * the second chain. In the third one, where energy drifts, many do: a finer run measures them, and costs more than the run; as its
 * motion is lost before the end, two coarse ones look for later maxima. */
static void comparison_runs_are_cheaper(void **state)
{
    (void)state;
    static const char disordered[] = "chain: {beads: [{cell: [large-steel, aluminium], count: 250, spins: random, seed: 1}]}\n";
    static const char *const accuracies[] = {"simulate: {accuracy: 1e-4}\n", "simulate: {accuracy: 1e-6}\n",
                                             "simulate: {accuracy: 1e-8}\n"};
    for (size_t j = 0; j < sizeof accuracies / sizeof *accuracies; j++) {
        const double plain = comparison_work(CHAIN, accuracies[j]), few = comparison_work(disordered, accuracies[j]),
                     many = comparison_work(DRIFTING, accuracies[j]);
        if (!(plain < 0.8) || !(j != 1 || few < 0.6) || !(many > 1 && many < 4))
            fail_msg("%.3g, %.3g, %.3g of the run: %s", plain, few, many, accuracies[j]);
    }
}

static void a_run_stops_when_nobody_needs_more(void **state)
{
    (void)state;
    struct bead_counts counts =
        play(ONE_MS "outputs: [{trajectory: run.h5, time: [0, 0.3 ms], beads: [20, 40], every: 2 us, fields: [force]}]\n",
             (struct bead_job){0});
    assert_int_equal(counts.steps, 300);
    assert_int_equal(counts.samples, 151);
    /* Ahead of the front nothing is sampled either. */
    assert_true(counts.sample_values < 151 * 21);
    struct bead_counts whole = play(ONE_MS "outputs: [{trajectory: run.h5, every: 2 us, fields: [force]}]\n", (struct bead_job){0});
    assert_int_equal(whole.steps, 1000);
    assert_true(counts.evaluations < whole.evaluations / 3);
}

static void outputs_do_not_change_the_states(void **state)
{
    (void)state;
    uint64_t hash = play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){0}).state_hash;
    assert_true(hash != 0);
    assert_true(play(ONE_MS "outputs: [{trajectory: run.h5, every: 0.37 us}]\n", (struct bead_job){0}).state_hash == hash);
    assert_true(
        play(ONE_MS "outputs: [{table: a.csv, show: bead-peaks}, {trajectory: run.h5, every: 3 us}]\n", (struct bead_job){0})
            .state_hash == hash);
    assert_true(play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){.threads = 1}).state_hash == hash);
    assert_true(play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){.threads = 2}).state_hash == hash);
    assert_true(
        play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){.instructions = "portable"}).state_hash ==
        hash);
    assert_true(play(ONE_MS "outputs: [{table: peaks.csv, show: peaks}]\n", (struct bead_job){.full_window = true}).state_hash ==
                hash);
}

/* Ahead of the front a long chain costs nothing: contact forces evaluated, not seconds. */
static void the_window_skips_what_is_at_rest(void **state)
{
    (void)state;
    const char *text = "chain: {beads: [{bead: large-steel, count: 100000}]}\nsimulate: {until: 0.1 ms, method: rkn8, step: 2 us}\n"
                       "outputs: [{table: peaks.csv, show: peaks}]\n";
    struct bead_counts window = play(text, (struct bead_job){0}), full = play(text, (struct bead_job){.full_window = true});
    assert_true(window.state_hash == full.state_hash);
    assert_true(window.evaluations * 1000 < full.evaluations);
}

/* A sensors table on the trajectory's clock reads the very numbers the trajectory holds. */
static void grids_that_meet_share_samples(void **state)
{
    (void)state;
    const char *chain =
        "chain: {beads: [{bead: large-steel, count: 20}, {bead: small-steel, sensor: s}, {bead: large-steel, count: 5}]}\n"
        "simulate: {until: 0.4 ms, method: rkn8, step: 1 us}\n";
    char text[1024];
    snprintf(text, sizeof text, "%soutputs: [{trajectory: run.h5, every: 0.3 us}, {table: s.csv, show: sensors, every: 0.1 us}]\n",
             chain);
    struct bead_counts counts = play(text, (struct bead_job){0});
    assert_int_equal(counts.samples, 4001);
}

static void bad_names_are_refused(void **state)
{
    (void)state;
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    struct bead_message msg = {""};
    struct bead_session *session = NULL;
    const char *only = "nothing.csv";
    struct bead_job job = {
        .size = sizeof job, .input = "assets/scenes/thesis/imagesc.yaml", .only = &only, .only_count = 1, .sinks = lists};
    assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "nothing.csv"));
    assert_null(session);
    job =
        (struct bead_job){.size = sizeof job, .input = "assets/scenes/thesis/imagesc.yaml", .instructions = "mmx", .sinks = lists};
    assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_ERROR_USAGE);
}

/* An ending has two to eight letters and digits, not only digits: others belong to names of directories. */
static void files_are_told_from_directories(void **state)
{
    (void)state;
    static const char *const files[] = {"a.xy", "a.abcdefgh", "b.c/a.7z", ".a.png", "a.v25"};
    static const char *const directories[] = {"a", "a.d", "a.abcdefghi", "run.25", ".ab", "a.x-y", "a.xy/b", "a."};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        assert_true(bead_session_names_file(files[i], NULL));
    for (size_t i = 0; i < sizeof directories / sizeof *directories; i++)
        assert_false(bead_session_names_file(directories[i], NULL));
    assert_false(bead_session_names_file(NULL, NULL));
}

/* What does not go together, or names nothing; nothing is computed for it. */
static void jobs_that_make_no_sense(void **state)
{
    (void)state;
#define SWEEPS \
    "sweeps: [{name: a, cells: 4, configurations: 2}, {name: bb, cells: 5, configurations: 3}]\noutputs: [{table: a.csv}]\n"
#define TWO "chains: [{name: left, beads: [{bead: brass}]}, {name: right, beads: [{bead: ptfe}]}]\noutputs: [{table: a.csv}]\n"
#define RANDOM                                                                                                                  \
    "chain: {beads: [{cell: [large-steel, aluminium], count: 9, spins: random}, {bead: brass, count: 20}]}\noutputs: [{table: " \
    "a.csv}]\n"
#define FILM(x) CHAIN "simulate: {until: 1 ms}\noutputs: [{movie: a.mp4}" x "]\n"
    static const char *const other[] = {"b.h5"}, *const table[] = {"b.csv"};
    static const struct {
        const char *scene;
        struct bead_job job;
        const char *says;
    } cases[] = {
        {NULL, {0}, "no scene given"},
        {CHAIN, {.sheet = true, .configuration = "1", .output = "a.png"}, "--sheet shows many configurations, --configuration one"},
        {CHAIN, {.still = "frame"}, "--still: there is no `frame`; must be poster"},
        {CHAIN, {.frame = "peak", .sheet = true}, "--frame: has no effect with --sheet"},
        {CHAIN, {.still = "poster", .configuration = "1", .output = "a.png"}, "--frame: has no effect with --configuration"},
        {CHAIN, {.sheet = true, .part = 1, .parts = 2}, "--sheet: there is no part of a sheet"},
        {CHAIN, {.sheet = true}, "--sheet: say where it goes"},
        {CHAIN, {.configuration = "1"}, "--configuration: say what to make of it"},
        {CHAIN, {.others = other, .other_count = 1}, "one file at a time: `%s` and `b.h5`"},
        {CHAIN, {.difference = true}, "--diff: needs two trajectories"},
        {SWEEPS, {.configuration = "1", .output = "a.png"}, "--configuration 1: there are 2 sweeps; say which, as in a:1"},
        {SWEEPS,
         {.configuration = "b:1", .output = "a.png"},
         "--configuration b:1: no sweep has this name; there is a, and others"},
        {SWEEPS, {.configuration = "bb:x", .output = "a.png"}, "--configuration bb:x: must be a number from 0 to "},
        {SWEEPS, {.configuration = "bb:", .output = "a.png"}, "--configuration bb:: must be a number from 0 to "},
        {SWEEPS, {.part = 1, .parts = 2}, "--shard: the scene has no output {sweep: FILE.h5}"},
        {"sweep: {cells: 4}\noutputs: [{sweep: s.h5}, {table: b.csv}]\n",
         {.part = 1, .parts = 2, .only = table, .only_count = 1},
         "--shard: the scene has no output {sweep: FILE.h5}"},
        {TWO,
         {.configuration = "middle", .output = "a.png"},
         "--configuration middle: no chain has this name; there are left, right"},
        {RANDOM, {.configuration = "12345", .output = "a.png"}, "--configuration 12345: must be a number from 0 to "},
        {FILM(""), {.frame = "2 kg"}, "--frame: "},
        {FILM(""), {.frame = "101%"}, "--frame: "},
        {FILM(", {table: b.csv}"), {.frame = "peak", .only = table, .only_count = 1}, "--frame: --only b.csv names no movie of "},
        {ONE_MS "outputs: [{table: b.csv}]\n", {.still = "poster"}, "--still: %s has no movie"},
    };
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct bead_message msg = {""};
        struct bead_session *session = NULL;
        struct bead_job job = cases[i].job;
        char path[512], says[1024];
        job.size = sizeof job;
        job.sinks = lists;
        if (cases[i].scene) {
            write_scene(cases[i].scene, path);
            job.input = path;
        }
        snprintf(says, sizeof says, cases[i].says, path);
        const enum bead_error err = bead_session_open(&job, &session, &msg);
        if (err != BEAD_ERROR_USAGE || !strstr(msg.text, says))
            fail_msg("job %zu: %d: '%s' is not in '%s'", i, (int)err, says, msg.text);
        assert_null(session);
    }
}

/* A signal may come before any output has begun: while the ranges of a movie are looked for. */
static void a_run_may_stop_while_scouting(void **state)
{
    (void)state;
    const struct bead_sink_type *const *const sinks[] = {bead_render_sinks(), NULL};
    volatile sig_atomic_t stop = 0;
    char path[512];
    write_scene(ONE_MS "outputs: [{movie: beads.mp4, duration: 0.2 s, size: [160, 120], fps: 10}]\n", path);
    const struct bead_job job = {
        .size = sizeof job, .input = path, .output = directory, .sinks = sinks, .threads = 1, .stop = &stop};
    struct bead_session *session = NULL;
    struct bead_message msg = {""};
    assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_OK);
    stop = 1;
    assert_int_equal(bead_session_run(session, &msg), BEAD_ERROR_STOPPED);
    bead_session_close(session);
    assert_false(is_there("beads.mp4"));
    assert_false(is_there("beads.mp4.part"));
}

/* A step far too long is refused; one that is too long but stable for a while stops with a message, not with nonsense. */
static void nonsense_is_stopped(void **state)
{
    (void)state;
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    char path[512];
    snprintf(path, sizeof path, "%s/wild.yaml", directory);
    static const char *const steps[] = {"1 ms", "25 us"};
    static const enum bead_error wanted[] = {BEAD_ERROR_SCENE, BEAD_ERROR_NUMBERS};
    for (int i = 0; i < 2; i++) {
        FILE *file = fopen(path, "w");
        fprintf(file, CHAIN "simulate: {until: 20 ms, method: rk4, step: %s}\noutputs: [{trajectory: wild.h5}]\n", steps[i]);
        fclose(file);
        struct bead_message msg = {""};
        struct bead_session *session = NULL;
        struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .sinks = lists};
        enum bead_error err = bead_session_open(&job, &session, &msg);
        if (!err)
            err = bead_session_run(session, &msg);
        bead_session_close(session);
        assert_int_equal(err, wanted[i]);
        assert_non_null(strstr(msg.text, "step"));
        assert_false(is_there("wild.h5"));
        assert_false(is_there("wild.h5.part"));
    }
}

#define BUDGET CHAIN "simulate: {until: 1 ms}\noutputs: [{table: peaks.csv, show: peaks}, {table: energy.csv, show: energy}]\n"

/* A budget needs more accuracy of the run, and only if it is made; the plan says so. */
static void a_budget_left_out_changes_nothing(void **state)
{
    (void)state;
    const char *peaks = "peaks.csv";
    struct bead_counts alone = play(CHAIN "simulate: {until: 1 ms}\noutputs: [{table: peaks.csv, show: peaks}]\n",
                                    (struct bead_job){0}),
                       left_out = play(BUDGET, (struct bead_job){.only = &peaks, .only_count = 1}),
                       made = play(BUDGET, (struct bead_job){0});
    assert_int_equal(left_out.state_hash, alone.state_hash);
    assert_int_equal(left_out.steps, alone.steps);
    assert_true(made.steps > alone.steps);
    for (int only = 0; only < 2; only++) {
        static const struct bead_sink_type *const *lists[2];
        lists[0] = bead_data_sinks();
        char path[512], plan[4096] = "";
        write_scene(BUDGET, path);
        const struct bead_job job = {
            .size = sizeof job, .input = path, .output = directory, .sinks = lists, .only = &peaks, .only_count = (size_t)only};
        struct bead_session *session = NULL;
        struct bead_message msg = {""};
        FILE *out = fmemopen(plan, sizeof plan, "w");
        assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_OK);
        assert_int_equal(bead_session_plan(session, out, &msg), BEAD_OK);
        fclose(out);
        bead_session_close(session);
        assert_int_equal(strstr(plan, "accuracy: 1e-11 instead of the default, for energy.csv\n") == NULL, only);
    }
}

/* Whatever came of the first run, a second one says that it does nothing. */
static void a_session_runs_once(void **state)
{
    (void)state;
    static const struct bead_sink_type *const *lists[2];
    lists[0] = bead_data_sinks();
    char path[512], part[512];
    snprintf(part, sizeof part, "%s/once.csv.part", directory);
    write_scene(ONE_MS "outputs: [{table: once.csv}]\n", path);
    for (int good = 0; good < 2; good++) {
        assert_int_equal(good ? unlink(part) : mkfifo(part, 0600), 0); /* no table can be written there */
        const struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .sinks = lists};
        struct bead_session *session = NULL;
        struct bead_message msg = {""};
        assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_OK);
        assert_int_equal(bead_session_run(session, &msg), good ? BEAD_OK : BEAD_ERROR_IO);
        assert_int_equal(bead_session_run(session, &msg), BEAD_ERROR_USAGE);
        assert_non_null(strstr(msg.text, "runs once"));
        bead_session_close(session);
        assert_int_equal(is_there("once.csv"), good);
    }
}

/* A row that lacks a function must not be found out by a user. */
static void every_sink_is_whole(void **state)
{
    (void)state;
    const struct bead_sink_type *const *const lists[] = {bead_data_sinks(), bead_render_sinks(), NULL};
    for (size_t l = 0; lists[l]; l++) {
        for (const struct bead_sink_type *const *t = lists[l]; *t; t++) {
            const struct bead_sink_type *s = *t;
            assert_true(s->name && s->help);
            assert_true(s->write || (s->create && s->needs && s->begin && s->sample && s->end && s->destroy));
        }
    }
}

static void a_result_has_the_bytes_of_its_file(void **state)
{
    (void)state;
    struct bead_sink_type silent;
    const struct bead_sink_type *const list[] = {&silent, NULL}, *const *const lists[] = {list, NULL},
                                       *const *t = bead_data_sinks();
    while ((*t)->kind != BEAD_OUTPUT_TABLE)
        t++;
    silent = **t;
    silent.result = NULL; /* says nothing of what it wrote */
    char path[512];
    write_scene(ONE_MS "outputs: [{table: silent.csv}]\n", path);
    const struct bead_job job = {.size = sizeof job, .input = path, .output = directory, .sinks = lists};
    struct bead_session *session = NULL;
    struct bead_message msg = {""};
    const struct bead_result *results = NULL;
    struct stat found;
    assert_int_equal(bead_session_open(&job, &session, &msg), BEAD_OK);
    assert_int_equal(bead_session_run(session, &msg), BEAD_OK);
    assert_int_equal(bead_session_results(session, &results), 1);
    assert_int_equal(stat(results[0].path, &found), 0);
    assert_true(found.st_size > 100);
    assert_int_equal(results[0].bytes, found.st_size);
    bead_session_close(session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_of_peaks_takes_no_samples),
        cmocka_unit_test(peaks_of_a_first_passage_need_no_scouting),
        cmocka_unit_test(beads_behind_the_front_are_dropped),
        cmocka_unit_test(comparison_runs_are_cheaper),
        cmocka_unit_test(a_run_stops_when_nobody_needs_more),
        cmocka_unit_test(outputs_do_not_change_the_states),
        cmocka_unit_test(the_window_skips_what_is_at_rest),
        cmocka_unit_test(grids_that_meet_share_samples),
        cmocka_unit_test(bad_names_are_refused),
        cmocka_unit_test(files_are_told_from_directories),
        cmocka_unit_test(jobs_that_make_no_sense),
        cmocka_unit_test(a_run_may_stop_while_scouting),
        cmocka_unit_test(nonsense_is_stopped),
        cmocka_unit_test(a_session_runs_once),
        cmocka_unit_test(a_budget_left_out_changes_nothing),
        cmocka_unit_test(every_sink_is_whole),
        cmocka_unit_test(a_result_has_the_bytes_of_its_file),
    };
    return cmocka_run_group_tests_name("session", tests, make_directory, remove_directory);
}
