/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failing allocations: each one fails once, over every kind of scene and data. The request then works as usual, or is refused for
 * lack of memory, with a message, and leaves no memory and no file. */
#include "tests/support.h"

#include "tests/scratch.h"

#include "beadreel/trajectory.h"
#include "tests/allocations.h"

/* ---- scenes and chains ---- */

static const char beads[] =
    "title: All\n"
    "materials: {crystal: {modulus: 70 GPa, poisson: 0.2, density: 2500 kg/m3, radius: 5 mm}}\n"
    "chains:\n"
    "  - {name: a, striker: {bead: large-steel, velocity: 0.4 m/s}, wall: brass, precompression: 2 N,\n"
    "     beads: [{cell: [large-steel, aluminium], count: 3, spins: random, magnetism: 0.3, seed: 7}, {bead: crystal, sensor: "
    "s}]}\n"
    "  - {name: b, beads: [{bead: small-steel, count: 3}, {bead: ptfe, sensor: t}], damping: {coefficient: 1, exponent: 1}}\n"
    "simulate: {until: 12 us}\n"
    "outputs:\n"
    "  - {trajectory: run.h5, every: 5 us, fields: all}\n"
    "  - {table: peaks.csv, show: peaks}\n"
    "  - {table: sensors.csv, show: sensors}\n"
    "  - {table: measures.csv, show: measures}\n"
    "  - {table: profiles.csv, field: force, show: profiles, at: [5 us, 10 us]}\n"
    "  - {table: chain.csv, show: chain}\n";

static const char equations[] =
    "chains:\n"
    "  - {name: a, equation: fput, points: 16, alpha: 0.25, start: {mode: 1, amplitude: 1}}\n"
    "  - {name: b, equation: kdv, length: 32, points: 32, start: {solitons: [{speed: 0.3, at: 10}]}}\n"
    "  - {name: c, equation: shock, epsilon: 0.1, length: 32, points: 64, start: {pulse: 1, width: 5, at: 10}}\n"
    "simulate: {until: 2}\n"
    "outputs: [{table: measures.csv, show: measures}, {trajectory: run.h5, every: 1}]\n";

static const char sweep[] = "sweeps:\n"
                            "  - {name: a, cells: 2, magnetism: [0], configurations: 2}\n"
                            "  - {name: b, cells: 2, magnetism: [0], configurations: 2, measure: {decay: true}}\n"
                            "simulate: {accuracy: 1e-4}\n"
                            "outputs: [{sweep: sweep.h5}, {table: sweep.csv}]\n";

static const char decaying[] = "sweep: {cells: 7, magnetism: [0.1428571], configurations: 1, measure: {decay: true}}\n"
                               "outputs: [{table: decay.csv, show: decay}]\n";

/* Read, not drawn. */
static const char pictures[] =
    "chain: {striker: {bead: large-steel}, beads: [{bead: small-steel, count: 3}, {bead: ptfe, sensor: t}]}\n"
    "simulate: {until: 30 us}\n"
    "outputs:\n"
    "  - {movie: a.mp4, views: [beads, profile], card: {for: 1 s, text: All}, poster: a.png,\n"
    "     captions: [{at: 0, text: one}, {at: 10 us, text: two}]}\n"
    "  - {image: [b.pdf, b.svg], panels: [[{field: force}], [{show: sensors}]], caption: Two}\n"
    "  - {plot: c.svg, show: setup}\n";

static const char sheet[] = "chain:\n"
                            "  beads: [{cell: [large-steel, aluminium], count: 4, spins: random}, {bead: small-steel, sensor: s}]\n"
                            "sweep: {spins: [\"1100\", \"0110\"], seed: 1, measure: {sensor: [s]}}\n"
                            "outputs: [{sheet: a.png}, {plot: a.svg}]\n";

/* The ready scenes, and one of them found. */
static enum bead_error list_scenes(const void *name, struct bead_message *msg)
{
    struct bead_ready_scene *scenes = NULL;
    size_t count = 0;
    char path[4096];
    enum bead_error err = bead_scene_ready(&scenes, &count, msg);
    assert_true(err ? !scenes && count == 0 : count > 5);
    bead_scene_ready_free(scenes, count);
    return err ? err : bead_scene_find(name, path, sizeof path, msg);
}

static enum bead_error read_scene(const void *text, struct bead_message *msg)
{
    static const char *const settings[] = {"title=Other", "simulate.accuracy=1e-6"};
    struct bead_scene *scene = NULL;
    enum bead_error err = bead_scene_parse("test.yaml", text, strlen(text),
                                           &(struct bead_overrides){.settings = settings, .setting_count = 2}, &scene, msg);
    assert_true(err ? !scene : scene != NULL);
    for (size_t c = 0; c < (scene ? scene->chain_count : 0) && !err; c++) {
        struct bead_chain *chain = NULL;
        err = bead_chain_create(scene, c, &chain, msg);
        assert_true(err ? !chain : chain != NULL);
        bead_chain_destroy(chain);
    }
    bead_scene_free(scene);
    return err;
}

static void scenes(void **state)
{
    (void)state;
    assert_true(fail_each(read_scene, beads) > 50);
    assert_true(fail_each(read_scene, equations) > 50);
    assert_true(fail_each(read_scene, sweep) > 50);
    assert_true(fail_each(read_scene, pictures) > 50);
    assert_true(fail_each(read_scene, sheet) > 50);
    assert_true(fail_each(list_scenes, "sweep") > 50);
}

static void runs(void **state)
{
    (void)state;
    assert_true(fail_each_of_scene(beads, bead_data_sinks()) > 200);
    assert_true(fail_each_of_scene(equations, bead_data_sinks()) > 150);
}

static void runs_of_sweeps(void **state)
{
    (void)state;
    assert_true(fail_each_of_scene(sweep, bead_data_sinks()) > 200);
    assert_true(fail_each_of_scene(decaying, bead_data_sinks()) > 100);
}

/* Runs a scene, and keeps one of its files. */
static void make_file(const char *text, const char *name, char path[512])
{
    char scene[512], made[512];
    write_scene(text, scene);
    play_counts((struct bead_job){.input = scene, .output = directory, .threads = 1});
    snprintf(made, sizeof made, "%s/%s", directory, name);
    snprintf(path, 512, "%s/kept.h5", directory);
    assert_int_equal(rename(made, path), 0);
    clear();
}

static void files_of_runs(void **state)
{
    (void)state;
    char path[512], out[512];
    make_file(beads, "run.h5", path);
    snprintf(out, sizeof out, "%s/again.csv", directory);
    static const char *const settings[] = {"outputs=[{table: again.csv, show: sensors}]"};
    assert_true(fail_each_of_job((struct bead_job){.input = path, .output = out, .settings = settings, .setting_count = 1},
                                 bead_data_sinks()) > 100);
}

static void files_of_sweeps(void **state)
{
    (void)state;
    char path[512], out[512];
    make_file(sweep, "sweep.h5", path);
    snprintf(out, sizeof out, "%s/again.csv", directory);
    static const char *const settings[] = {"outputs=[{table: again.csv, show: configurations}]"};
    assert_true(fail_each_of_job((struct bead_job){.input = path, .output = out, .settings = settings, .setting_count = 1},
                                 bead_data_sinks()) > 100);
    assert_true(fail_each_of_job((struct bead_job){.input = path, .output = out, .configuration = "b:1"}, bead_data_sinks()) > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes),          cmocka_unit_test(runs),
        cmocka_unit_test(runs_of_sweeps),  cmocka_unit_test(files_of_runs),
        cmocka_unit_test(files_of_sweeps),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
