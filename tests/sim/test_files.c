/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that appear whole or not at all: never through links, never over another run's, with names of any length. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "sim/base/assets.h"
#include "sim/base/file.h"
#include "sim/hdf5/h5_private.h"
#include "support.h"

#include "scratch.h"

/* A file's path in the scratch directory; every test has different names. */
static void in_directory(const char *name, char path[PATH_MAX])
{
    snprintf(path, PATH_MAX, "%s/%s", directory, name);
}

static enum bead_error fill(void *context, FILE *file, const char *part, struct bead_message *msg)
{
    (void)part, (void)msg;
    fputs(context, file);
    return BEAD_OK;
}

static bool holds(const char *path, const char *text)
{
    char read[64] = "";
    FILE *file = fopen(path, "r");
    if (!file)
        return false;
    size_t n = fread(read, 1, sizeof read - 1, file);
    fclose(file);
    return n == strlen(text) && memcmp(read, text, n) == 0;
}

static void links_are_not_followed(void **state)
{
    (void)state;
    char victim[PATH_MAX], path[PATH_MAX], part[PATH_MAX];
    struct bead_message msg = {.text = ""};
    struct bead_claim *claim;
    in_directory("victim", victim);
    in_directory("linked.csv", path);
    in_directory("linked.csv.part", part);
    assert_int_equal(bead_file_write(victim, fill, "precious", NULL, &msg), BEAD_OK);
    assert_int_equal(symlink(victim, part), 0);
    assert_int_equal(bead_file_write(path, fill, "new", NULL, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "symbolic link"));
    assert_int_equal(bead_file_claim(path, &claim, &msg), BEAD_ERROR_IO);
    assert_int_equal(unlink(part), 0);
    assert_int_equal(link(victim, part), 0);
    assert_int_equal(bead_file_write(path, fill, "new", NULL, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "hard links"));
    assert_true(holds(victim, "precious"));
}

static void fifos_do_not_block(void **state)
{
    (void)state;
    char path[PATH_MAX], part[PATH_MAX];
    struct bead_message msg = {.text = ""};
    in_directory("peaks.csv", path);
    in_directory("peaks.csv.part", part);
    assert_int_equal(mkfifo(part, 0600), 0);
    assert_int_equal(bead_file_write(path, fill, "new", NULL, &msg), BEAD_ERROR_IO);
    assert_non_null(strstr(msg.text, "regular file"));
    assert_int_equal(access(part, F_OK), 0); /* it is somebody else's */
}

static void names_of_any_length_can_be_written(void **state)
{
    (void)state;
    char path[PATH_MAX], name[NAME_MAX + 2];
    for (size_t length = NAME_MAX - 8; length <= NAME_MAX; length++) {
        for (size_t i = 0; i < length; i++) /* "é" is two bytes: cuts between characters */
            name[i] = i + 1 < length ? (i % 2 ? '\xa9' : '\xc3') : 'e';
        if (length % 2 == 0)
            name[length - 2] = 'e';
        name[length] = '\0';
        in_directory(name, path);
        char *part;
        assert_int_equal(bead_file_part_name(path, &part, NULL), BEAD_OK);
        const char *base = strrchr(part, '/') + 1;
        assert_true(strlen(base) <= NAME_MAX);
        assert_string_equal(base + strlen(base) - 5, ".part");
        const char *cut = strchr(base, '~');
        assert_true(!cut || (unsigned char)cut[-1] == 0xa9);
        free(part);
        assert_int_equal(bead_file_write(path, fill, "x", NULL, NULL), BEAD_OK);
        assert_true(holds(path, "x"));
    }
}

static void a_second_claim_is_refused_and_removes_nothing(void **state)
{
    (void)state;
    char path[PATH_MAX], part[PATH_MAX];
    struct bead_message msg = {.text = ""};
    struct bead_claim *first, *second;
    in_directory("force.png", path);
    in_directory("force.png.part", part);
    assert_int_equal(bead_file_claim(path, &first, &msg), BEAD_OK);
    assert_int_equal(bead_file_claim(path, &second, &msg), BEAD_ERROR_USAGE);
    assert_null(second);
    assert_non_null(strstr(msg.text, "another run"));
    assert_int_equal(access(part, F_OK), 0);
    assert_int_equal(bead_file_write(path, fill, "done", NULL, &msg), BEAD_OK); /* the claim does not block itself */
    assert_int_equal(bead_file_claim(path, &second, &msg), BEAD_OK);            /* the finished file is nobody's */
    bead_file_release(first, false);
    assert_int_equal(access(part, F_OK), 0); /* that is the second's now */
    bead_file_release(second, false);
    assert_int_not_equal(access(part, F_OK), 0);
    assert_true(holds(path, "done"));
}

static void what_a_killed_run_left_stays_until_it_is_written_over(void **state)
{
    (void)state;
    char path[PATH_MAX], part[PATH_MAX];
    struct bead_claim *claim;
    in_directory("run.h5", path);
    in_directory("run.h5.part", part);
    assert_int_equal(bead_file_write(part, fill, "left", NULL, NULL), BEAD_OK);
    assert_int_equal(bead_file_claim(path, &claim, NULL), BEAD_OK);
    assert_true(holds(part, "left"));
    bead_file_release(claim, false);
    assert_true(holds(part, "left"));
}

/* ---- file systems without locks ---- */

static int lock_error; /* 0: flock works */
int __real_flock(int, int);
int __wrap_flock(int, int);
int __wrap_flock(int descriptor, int operation)
{
    if (!lock_error)
        return __real_flock(descriptor, operation);
    errno = lock_error;
    return -1;
}

static void without_locks(int error, const char *name, char path[PATH_MAX], char beside[PATH_MAX])
{
    char claimed[64];
    lock_error = error;
    snprintf(claimed, sizeof claimed, "%s.part.lock", name);
    in_directory(name, path);
    in_directory(claimed, beside);
}

static void claims_hold_without_locks(void **state)
{
    (void)state;
    static const int errors[] = {ENOLCK, ENOTSUP, ENOSYS};
    char path[PATH_MAX], beside[PATH_MAX];
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        struct bead_message msg = {.text = ""};
        struct bead_claim *first, *second;
        without_locks(errors[i], "unlocked.csv", path, beside);
        assert_int_equal(bead_file_claim(path, &first, &msg), BEAD_OK);
        assert_string_equal(bead_file_claimed_by(first), beside);
        assert_int_equal(bead_file_claim(path, &second, &msg), BEAD_ERROR_USAGE);
        assert_non_null(strstr(msg.text, "another run"));
        assert_non_null(strstr(msg.text, beside));
        bead_file_release(first, false);
        assert_int_not_equal(access(beside, F_OK), 0);
        assert_int_equal(bead_file_claim(path, &first, &msg), BEAD_OK);
        bead_file_abandon(first); /* as a fault does */
        assert_int_not_equal(access(beside, F_OK), 0);
        bead_file_release(first, false);
    }
    lock_error = 0;
}

/* In a process that ends without giving up its claim, as one that is killed. */
static void claim_and_end(const char *path)
{
    struct bead_claim *claim;
    const pid_t child = fork();
    if (child == 0)
        _exit(bead_file_claim(path, &claim, NULL) == BEAD_OK ? 0 : 1);
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

static void the_claim_of_a_killed_run_is_taken_over_by_one(void **state)
{
    (void)state;
    enum { RUNS = 8 };
    char path[PATH_MAX], beside[PATH_MAX];
    int begin[2];
    pid_t runs[RUNS];
    without_locks(ENOLCK, "killed.csv", path, beside);
    claim_and_end(path);
    assert_int_equal(access(beside, F_OK), 0);
    assert_int_equal(pipe(begin), 0);
    for (int i = 0; i < RUNS; i++) {
        runs[i] = fork();
        if (runs[i] == 0) {
            char byte;
            struct bead_claim *claim;
            close(begin[1]);
            (void)!read(begin[0], &byte, 1); /* until all are there */
            const bool mine = bead_file_claim(path, &claim, NULL) == BEAD_OK;
            usleep(300000); /* the others find a living process */
            if (mine)
                bead_file_release(claim, false);
            _exit(mine ? 1 : 0);
        }
    }
    close(begin[0]);
    close(begin[1]);
    int winners = 0, status = 0;
    for (int i = 0; i < RUNS; i++) {
        assert_int_equal(waitpid(runs[i], &status, 0), runs[i]);
        winners += WEXITSTATUS(status);
    }
    assert_int_equal(winners, 1);
    assert_int_not_equal(access(beside, F_OK), 0);
    lock_error = 0;
}

static void a_claim_of_another_machine_is_left_alone(void **state)
{
    (void)state;
    static char *const foreign[] = {"1 elsewhere 00000000-0000-0000-0000-000000000000 pid:[1]\n", "999999 elsewhere", ""};
    char path[PATH_MAX], beside[PATH_MAX];
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        struct bead_message msg = {.text = ""};
        struct bead_claim *claim;
        without_locks(ENOLCK, "foreign.csv", path, beside);
        assert_int_equal(bead_file_write(beside, fill, foreign[i], NULL, NULL), BEAD_OK);
        assert_int_equal(bead_file_claim(path, &claim, &msg), BEAD_ERROR_USAGE);
        assert_non_null(strstr(msg.text, beside));
        assert_true(holds(beside, foreign[i]));
        assert_int_equal(unlink(beside), 0);
    }
    lock_error = 0;
}

/* The directory that the environment names is the first, however short its name; nothing is found below one too long. */
static void assets_are_where_the_environment_says(void **state)
{
    (void)state;
    char was[PATH_MAX], here[PATH_MAX], path[PATH_MAX], *too_long = malloc(PATH_MAX + 10);
    struct bead_message msg = {""};
    assert_non_null(too_long);
    snprintf(was, sizeof was, "%s", getenv("BEADREEL_ASSETS"));
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(was), 0);
    setenv("BEADREEL_ASSETS", ".", 1);
    assert_int_equal(bead_asset_path("materials.yaml", path, sizeof path, &msg), BEAD_OK);
    assert_string_equal(path, "./materials.yaml");
    memset(too_long, '/', PATH_MAX + 9);
    too_long[PATH_MAX + 9] = '\0';
    setenv("BEADREEL_ASSETS", too_long, 1);
    assert_int_equal(bead_asset_path("no such file", path, sizeof path, &msg), BEAD_ERROR_IO);
    setenv("BEADREEL_ASSETS", was, 1);
    assert_int_equal(chdir(here), 0);
    free(too_long);
}

static int unfinished = -1, waited;

/* Whoever waits finds that the head has been written meanwhile. */
int __wrap_nanosleep(const struct timespec *, struct timespec *);
int __wrap_nanosleep(const struct timespec *, struct timespec *)
{
    assert_int_equal(pwrite(unfinished, "\211HDF\r\n\032\n", 8, 0), 8);
    waited++;
    return 0;
}

/* A run begins its file with a head of zeros: readers wait for the other, if the file is new; that of a killed run has none. */
static void readers_wait_for_the_head_of_a_new_file(void **state)
{
    (void)state;
    static const struct {
        const char *name, *begins;
        time_t age;
        int waited;
    } files[] = {{"a.h5.part", "\0\0\0\0\0\0\0\0", 0, 1},
                 {"b.h5.part", "\0\0\0\0\0\0\0\0", 60, 0},
                 {"c.h5.part", "\211HDF\r\n\032\n", 0, 0},
                 {"d.h5", "\0\0\0\0\0\0\0\0", 0, 0}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[PATH_MAX];
        in_directory(files[i].name, path);
        unfinished = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
        assert_int_equal(write(unfinished, files[i].begins, 8), 8);
        const struct timespec then = {.tv_sec = time(NULL) - files[i].age};
        futimens(unfinished, (const struct timespec[]){then, then});
        waited = 0;
        const int file = bead_h5_look(path);
        assert_true(file >= 0);
        assert_int_equal(waited, files[i].waited);
        close(file);
        close(unfinished);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(links_are_not_followed),
        cmocka_unit_test(fifos_do_not_block),
        cmocka_unit_test(names_of_any_length_can_be_written),
        cmocka_unit_test(a_second_claim_is_refused_and_removes_nothing),
        cmocka_unit_test(what_a_killed_run_left_stays_until_it_is_written_over),
        cmocka_unit_test(claims_hold_without_locks),
        cmocka_unit_test(the_claim_of_a_killed_run_is_taken_over_by_one),
        cmocka_unit_test(a_claim_of_another_machine_is_left_alone),
        cmocka_unit_test(readers_wait_for_the_head_of_a_new_file),
        cmocka_unit_test(assets_are_where_the_environment_says),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
