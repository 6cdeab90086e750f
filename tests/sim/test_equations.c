/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equations in scenes: bits that do not depend on the outputs, trajectories that draw the same again and describe their contents,
 * pictures and tables without units. */
#include "support.h"

#include "scratch.h"
#include "sessions.h"

#include <sys/stat.h>

#include "beadreel/trajectory.h"
#include "render/draw/axis.h"
#include "sim/chain/chain_internal.h"

#define STRING "{name: string, equation: fput, points: 31, start: {mode: 1}}"
#define KDV    "{equation: kdv, low: -10, length: 20, points: 128, start: {solitons: [{speed: 9, at: -3}]}}"

static void path_of(const char *part, const char *name, char path[512])
{
    snprintf(path, 512, "%s/%s/%s", directory, part, name);
}

static int empty_directory(void **state)
{
    char path[512];
    (void)state;
    path_of("a", "", path);
    remove_files(path);
    path_of("b", "", path);
    remove_files(path);
    return remove_directory(state);
}

static struct bead_counts play(const char *text, const char *part, int threads)
{
    char scene[512], out[512];
    write_scene(text, scene);
    path_of(part, "", out);
    return play_counts((struct bead_job){.input = scene, .output = out, .threads = threads});
}

static char *contents(const char *part, const char *name, size_t *length)
{
    char path[512];
    path_of(part, name, path);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s is not there", path);
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    char *bytes = calloc(*length + 1, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *length, file), *length);
    fclose(file);
    return bytes;
}

static void assert_same_file(const char *name)
{
    size_t la, lb;
    char *a = contents("a", name, &la), *b = contents("b", name, &lb);
    if (la != lb || memcmp(a, b, la) != 0)
        fail_msg("%s is not the same", name);
    free(a);
    free(b);
}

static void bits_do_not_depend_on_outputs(void **state)
{
    static const char *const chains[] = {STRING, KDV};
    static const char *const outputs[] = {
        "[{table: m.csv, show: measures}]", "[{trajectory: r.h5, every: 0.013}]",
        "[{image: a.png, size: [500, 400], trust: true}, {plot: p.svg, show: profiles, at: [0.1, 0.37]}]",
        "[{movie: m.gif, size: [320, 240], fps: 10, duration: 0.5 s}, {table: t.csv, show: modes, every: 0.01}]"};
    (void)state;
    for (size_t c = 0; c < 2; c++) {
        uint64_t hash = 0;
        for (size_t o = 0; o < sizeof outputs / sizeof *outputs; o++) {
            char text[1000];
            snprintf(text, sizeof text, "chain: %s\nsimulate: {until: 0.5}\noutputs: %s\n", chains[c], outputs[o]);
            struct bead_counts counts = play(text, "a", o % 2 ? 2 : 1);
            assert_true(counts.state_hash != 0);
            if (o > 0 && counts.state_hash != hash)
                fail_msg("chain %zu: outputs %zu changed the states", c, o);
            hash = counts.state_hash;
        }
    }
}

static void trajectories_draw_the_same_again(void **state)
{
    static const char *const names[] = {"a.png", "b.svg", "m.gif", "modes.svg", "profiles.svg", "modes.csv"};
    static const char *const chains[] = {STRING, KDV};
    char run[512], out[512];
    (void)state;
    for (size_t c = 0; c < 2; c++) {
        char text[2000];
        snprintf(text, sizeof text,
                 "chain: %s\nsimulate: {until: 1}\noutputs:\n"
                 "  - {trajectory: run.h5, every: 0.002}\n"
                 "  - {image: a.png, size: [300, 200]}\n"
                 "  - {image: b.svg, views: [profile], at: 0.5}\n"
                 "  - {movie: m.gif, size: [320, 240], views: [profile, modes], fps: 10, duration: 0.5 s}\n"
                 "  - {plot: modes.svg, show: modes}\n"
                 "  - {plot: profiles.svg, show: profiles, at: [0, 0.5, 1]}\n"
                 "  - {table: modes.csv, show: modes, uncertainty: false}\n",
                 chains[c]);
        play(text, "a", 1);
        path_of("a", "run.h5", run);
        path_of("b", "", out);
        mkdir(out, 0777);
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            path_of("b", names[i], out);
            bead_session_close(play_session((struct bead_job){.input = run, .output = out}));
            assert_same_file(names[i]);
        }
    }
}

static void trajectories_hold_what_there_is(void **state)
{
    char path[512];
    struct bead_message msg;
    struct bead_trajectory *t = NULL;
    (void)state;
    play("chain: " STRING "\nsimulate: {until: 5}\noutputs: [{trajectory: run.h5, every: 1}]\n", "a", 1);
    path_of("a", "run.h5", path);
    assert_int_equal(bead_trajectory_open(path, NULL, &t, &msg), BEAD_OK);
    size_t count = 0;
    const struct bead_chain *chain = bead_trajectory_chains(t, &count)[0];
    const unsigned fields = bead_chain_fields(chain);
    assert_int_equal(fields, BEAD_FIELD_BIT(BEAD_FIELD_DISPLACEMENT) | BEAD_FIELD_BIT(BEAD_FIELD_VELOCITY) |
                                 BEAD_FIELD_BIT(BEAD_FIELD_STRAIN) | BEAD_FIELD_BIT(BEAD_FIELD_ENERGY));
    assert_int_equal(bead_trajectory_fields(t), fields);
    assert_true(bead_trajectory_complete(t));
    struct bead_sample sample;
    assert_int_equal(bead_trajectory_read(t, 0, 0, fields, &sample, &msg), BEAD_OK);
    double energy = 0;
    for (size_t j = 0; j < 31; j++) {
        double phase = 3.14159265358979323846 * (double)(j + 1) / 32;
        assert_near(sample.field[BEAD_FIELD_DISPLACEMENT][j], sin(phase), 1e-15);
        assert_near(sample.field[BEAD_FIELD_VELOCITY][j], 0, 0);
        energy += sample.field[BEAD_FIELD_ENERGY][j];
    }
    struct bead_outcome outcome;
    assert_int_equal(bead_trajectory_outcome(t, 0, &outcome, &msg), BEAD_OK);
    double end_spring = sin(3.14159265358979323846 / 32), half_ends = 0.5 * end_spring * end_spring; /* halves of both */
    assert_near(energy + half_ends, outcome.energy_start, 1e-3 * outcome.energy_start);
    bead_trajectory_close(t);
}

/* Words of a picture: titles and axes are the equation's, and nothing is metres, seconds or newtons. */
static void pictures_have_no_units(void **state)
{
    struct bead_message msg;
    struct bead_chain *chain = NULL;
    char text[200];
    (void)state;
    struct bead_scene *scene = NULL;
    const char *yaml = "chain: " KDV "\nsimulate: {until: 1}\noutputs: [{image: a.svg}]\n";
    assert_int_equal(bead_scene_parse("test", yaml, strlen(yaml), NULL, &scene, &msg), BEAD_OK);
    assert_int_equal(bead_chain_create(scene, 0, &chain, &msg), BEAD_OK);
    assert_string_equal(bead_chain_time_unit(chain), "");
    assert_string_equal(bead_chain_field(chain, BEAD_FIELD_DISPLACEMENT)->unit, "");
    assert_null(bead_chain_field(chain, BEAD_FIELD_FORCE));
    struct bead_chain_axis along = bead_chain_axis(chain, false);
    assert_string_equal(along.title, "x");
    assert_near(along.first, -10, 0);
    assert_near(along.spacing, 20. / 128, 0);
    assert_false(bead_chain_signed(chain, BEAD_FIELD_DISPLACEMENT)); /* one soliton above zero */
    bead_chain_describe(chain, text, sizeof text);
    assert_non_null(strstr(text, "+ 6 u"));
    bead_chain_destroy(chain);
    bead_scene_free(scene);
}

/* The recurrence through the whole program: the number in the table of measures. */
static void measures_are_in_the_table(void **state)
{
    size_t length;
    (void)state;
    play("chain: " STRING "\nsimulate: {until: 10000}\noutputs: [{table: m.csv, show: measures}]\n", "a", 1);
    char *text = contents("a", "m.csv", &length), *row = strstr(text, "recurrence time in periods,");
    assert_non_null(row);
    assert_near(atof(strchr(row, ',') + 1), 146.45, 0.1);
    free(text);
}

/* Small displacements are written as they are: no prefix makes them milli of nothing. */
static void numbers_take_no_prefixes(void **state)
{
    char text[64];
    (void)state;
    bead_quantity(0.00125, "", 3, text, sizeof text);
    assert_string_equal(text, "0.00125");
    bead_quantity(12500, "", 3, text, sizeof text);
    assert_null(strpbrk(text, "kmM"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_do_not_depend_on_outputs),   cmocka_unit_test(trajectories_draw_the_same_again),
        cmocka_unit_test(trajectories_hold_what_there_is), cmocka_unit_test(pictures_have_no_units),
        cmocka_unit_test(measures_are_in_the_table),       cmocka_unit_test(numbers_take_no_prefixes),
    };
    return cmocka_run_group_tests_name("equations", tests, make_directory, empty_directory);
}
