/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeps that cannot be run, stored or merged say why, and leave existing files unchanged. */
#include "sweeps.h"

#include "scratch.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>

#include "sim/base/file.h"
#include "sim/sweep/sweep_internal.h"

static const char one_sweep[] = "sweep: {cells: 6, configurations: 2, seed: 2, magnetism: [0], measure: {decay: true}}" OUTPUT;

static void in_directory(const char *name, char path[512])
{
    snprintf(path, 512, "%s/%s", directory, name);
}

/* The sweep of the text is run and fails with a message of the text `expected`. */
static void refuse_run(const char *text, const struct bead_sweep_settings *settings, enum bead_error error, const char *expected)
{
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL;
    struct bead_scene *scene = parse(text);
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_run(sweep, settings, NULL, &msg), error);
    if (!strstr(msg.text, expected))
        fail_msg("'%s' is not in '%s'", expected, msg.text);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

static void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void journals_of_others_are_refused(void **state)
{
    (void)state;
    static char bytes[1 << 16];
    char path[512];
    in_directory("journal", path);
    const struct bead_sweep_settings all = {.size = sizeof all, .threads = 1, .journal = path},
                                     second = {.size = sizeof second, .threads = 1, .journal = path, .part = 2, .parts = 2};
    struct bead_scene *scene = parse(one_sweep);
    bead_sweep_close(compute(scene, &all));
    bead_scene_free(scene);
    refuse_run(one_sweep, &second, BEAD_ERROR_USAGE, "another part of the sweep");
    FILE *file = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, file);
    assert_true(size > 72 && size < sizeof bytes);
    fclose(file);
    int held = open(path, O_RDONLY);
    assert_int_equal(flock(held, LOCK_EX), 0);
    refuse_run(one_sweep, &all, BEAD_ERROR_USAGE, "another run is writing it");
    close(held);
    bytes[17] ^= 1; /* its format */
    write_bytes(path, bytes, size);
    refuse_run(one_sweep, &all, BEAD_ERROR_USAGE, "is not a journal of a sweep");
    write_bytes(path, bytes, 20); /* a beginning, but not of its journal */
    refuse_run(one_sweep, &all, BEAD_ERROR_USAGE, "is not the journal of this sweep");
    struct bead_sweep_progress progress;
    assert_false(bead_sweep_journal_look(path, &progress));
}

/* A journal that cannot grow: the sweep fails, and a later one continues from the journal. */
static void full_disks_are_errors(void **state)
{
    (void)state;
    char path[512];
    in_directory("full", path);
    const struct bead_sweep_settings settings = {.size = sizeof settings, .threads = 1, .journal = path};
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    for (rlim_t room = 0; room < 400; room += 100) {
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){room, before.rlim_max}), 0);
        refuse_run(one_sweep, &settings, BEAD_ERROR_IO, "cannot be written");
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    }
    signal(SIGXFSZ, handler);
    struct bead_scene *scene = parse(one_sweep);
    struct bead_sweep *sweep = compute(scene, &settings), *whole = compute(scene, NULL);
    assert_memory_equal(peak_of(sweep, 1), peak_of(whole, 1), sizeof(struct bead_sweep_peak));
    bead_sweep_close(sweep);
    bead_sweep_close(whole);
    bead_scene_free(scene);
}

static void settings_are_checked(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL;
    const struct bead_sweep_settings odd = {.size = sizeof odd, .threads = 1, .instructions = "mmx"};
    refuse_run(one_sweep, &odd, BEAD_ERROR_USAGE, "--instructions mmx");
    struct bead_scene *scene = parse("chain: {beads: [{bead: small-steel}]}\noutputs: [{table: a.csv}]");
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "has no sweep"));
    assert_null(sweep);
    bead_scene_free(scene);
    scene = parse(one_sweep);
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    struct bead_sweep_watch watch = {.index = 0};
    assert_int_equal(bead_sweep_watch(sweep, &watch, 1, &odd, &msg), BEAD_ERROR_USAGE);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

/* Statistics need the chain with all cells up, and a threshold that there is; decays need to have been measured. */
static void statistics_need_results(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    struct bead_sweep *sweep = NULL;
    struct bead_sweep_statistics statistics;
    struct bead_sweep_decay *decays;
    size_t count;
    struct bead_scene *scene = parse(one_sweep), *plain = parse("sweep: {cells: 2, configurations: 1, magnetism: [0]}" OUTPUT);
    assert_int_equal(bead_sweep_create(scene, &sweep, &msg), BEAD_OK);
    assert_int_equal(bead_sweep_statistics(sweep, 0, 0, NULL, &statistics, &msg), BEAD_ERROR_NUMBERS);
    assert_int_equal(bead_sweep_decays(sweep, 0, &decays, &count, &msg), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "is not known here"));
    bead_sweep_close(sweep);
    sweep = compute(plain, NULL);
    assert_int_equal(bead_sweep_statistics(sweep, 0, 1, NULL, &statistics, &msg), BEAD_ERROR_NUMBERS);
    assert_int_equal(bead_sweep_statistics(sweep, 0, 0, "average", &statistics, &msg), BEAD_ERROR_USAGE);
    assert_non_null(strstr(msg.text, "average"));
    assert_int_equal(bead_sweep_decays(sweep, 0, &decays, &count, &msg), BEAD_ERROR_NUMBERS);
    assert_non_null(strstr(msg.text, "not measured"));
    assert_null(decays);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
    bead_scene_free(plain);
}

/* The part `part` of `parts` of the sweep of this text, in a file. */
static void write_part(const char *text, size_t part, size_t parts, const char *path)
{
    struct bead_message msg = {""};
    struct bead_scene *scene = parse(text);
    struct bead_sweep *sweep = compute(scene, &(struct bead_sweep_settings){.threads = 1, .part = part, .parts = parts});
    if (bead_sweep_write(sweep, path, &msg))
        fail_msg("%s", msg.text);
    bead_sweep_close(sweep);
    bead_scene_free(scene);
}

static void refuse_merge(const char *const *paths, size_t count, const char *expected)
{
    struct bead_message msg = {""};
    struct bead_sweep *sweep = (void *)&msg; /* no sweep: it must be cleared */
    assert_int_equal(bead_sweep_merge(paths, count, &sweep, &msg), BEAD_ERROR_USAGE);
    assert_null(sweep);
    if (!strstr(msg.text, expected))
        fail_msg("'%s' is not in '%s'", expected, msg.text);
}

static void parts_with_profiles_make_the_whole(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    char one[512], two[512], other[512];
    in_directory("one.h5", one);
    in_directory("two.h5", two);
    in_directory("other.h5", other);
    write_part(one_sweep, 1, 2, one);
    write_part(one_sweep, 2, 2, two);
    write_part("title: Other\nsweep: {cells: 6, configurations: 2, seed: 2, magnetism: [0], measure: {decay: true}}" OUTPUT, 2, 2,
               other);
    refuse_merge(NULL, 0, "no parts");
    refuse_merge((const char *[]){one}, 1, "part 2 of 2 is missing");
    refuse_merge((const char *[]){one, other}, 2, "another scene");
    struct bead_sweep *sweep = NULL;
    assert_int_equal(bead_sweep_merge((const char *[]){two, one}, 2, &sweep, &msg), BEAD_OK);
    struct bead_scene *scene = parse(one_sweep);
    struct bead_sweep *whole = compute(scene, NULL);
    for (size_t i = 0; i < 2; i++) {
        struct bead_sweep_configuration merged, computed;
        assert_true(bead_sweep_configuration(sweep, 0, i, &merged) && bead_sweep_configuration(whole, 0, i, &computed));
        size_t bytes = bead_sweep_panel(whole, 0)->beads * sizeof(double);
        assert_memory_equal(merged.bead_force, computed.bead_force, bytes);
        assert_memory_equal(merged.last_energy, computed.last_energy, bytes);
    }
    bead_sweep_close(sweep);
    bead_sweep_close(whole);
    bead_scene_free(scene);
    /* In four parts, two are missing. */
    write_part(one_sweep, 1, 4, one);
    write_part(one_sweep, 3, 4, two);
    refuse_merge((const char *[]){one, two}, 2, "parts 2, 4 of 4 are missing");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(journals_of_others_are_refused),
        cmocka_unit_test(full_disks_are_errors),
        cmocka_unit_test(settings_are_checked),
        cmocka_unit_test(statistics_need_results),
        cmocka_unit_test(parts_with_profiles_make_the_whole),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
