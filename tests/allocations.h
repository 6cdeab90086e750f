/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of failing allocations, after support.h and scratch.h: something is done once for each of its allocations,
 * which fails. The program is linked with fail_alloc.c. */
#ifndef BEADREEL_TESTS_ALLOCATIONS_H
#define BEADREEL_TESTS_ALLOCATIONS_H

#include "beadreel/session.h"
#include "beadreel/sweep.h"
#include "tests/missing.h"
#include "tests/sessions.h"
#include "tests/torture/fail_alloc.h"

/* Something that is done and undone. */
typedef enum bead_error (*action)(const void *context, struct bead_message *msg);

/* Removes the files of an action, and returns how many of these are unfinished: a sweep's journal is meant to stay. */
static int clear(void)
{
    char path[1024];
    int unfinished = 0;
    DIR *dir = opendir(directory);
    assert_non_null(dir);
    for (struct dirent *e; (e = readdir(dir));) {
        const char *end = strrchr(e->d_name, '.');
        snprintf(path, sizeof path, "%s/%s", directory, e->d_name);
        if (*e->d_name == '.' || strncmp(e->d_name, "kept.", 5) == 0)
            continue;
        unfinished += strcmp(end, ".part") == 0 && strcmp(e->d_name, "sweep.h5.part") != 0;
        unlink(path);
    }
    closedir(dir);
    return unfinished;
}

enum { MOST_BYTES = 4 << 20 };

/* HDF5's files know when they were made. */
static int is_compared(const struct dirent *e)
{
    return *e->d_name != '.' && strncmp(e->d_name, "kept.", 5) != 0 && !strstr(e->d_name, ".h5");
}

/* All files that an action has made, one after the other; returns their bytes. */
static size_t read_files(char bytes[MOST_BYTES])
{
    struct dirent **entries;
    size_t used = 0;
    const int count = scandir(directory, &entries, is_compared, alphasort);
    assert_true(count >= 0);
    for (int i = 0; i < count; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", directory, entries[i]->d_name);
        FILE *file = fopen(path, "r");
        assert_non_null(file);
        used += fread(bytes + used, 1, MOST_BYTES - used, file);
        fclose(file);
        free(entries[i]);
    }
    free(entries);
    assert_true(used < MOST_BYTES);
    return used;
}

/* Number of allocations of `act`; each has failed once, or of those by the same functions the program's first two. */
static long fail_each(action act, const void *context)
{
    static char whole[MOST_BYTES], made_then[MOST_BYTES];
    static bool known[1 << 14];
    long made, kept;
    struct bead_message msg = {""};
#ifdef FAIL_ALLOC_SANITIZED
    skip_without("a build without sanitizers");
#endif
    if (act(context, &msg)) /* things made once for the whole program exist from now on */
        fail_msg("%s", msg.text);
    clear();
    memset(known, 0, sizeof known);
    fail_alloc_note(known, sizeof known);
    assert_int_equal(act(context, &msg), BEAD_OK);
    assert_true(fail_alloc_end(&kept) < (long)sizeof known);
    const size_t size = read_files(whole);
    for (long k = 1;; k++) {
        if (known[k - 1])
            continue;
        clear();
        msg.text[0] = '\0';
        fail_alloc_begin(k);
        enum bead_error err = act(context, &msg);
        made = fail_alloc_end(&kept);
        if (kept > 0) /* fewer than none: FFTW's memory, freed for it */
            fail_msg("allocation %ld of %ld: %ld are not freed (%s)", k, made, kept, msg.text);
        if (err && err != BEAD_ERROR_MEMORY && !strstr(msg.text, "HDF5"))
            fail_msg("allocation %ld: error %d: %s", k, err, msg.text);
        if (err && (!*msg.text || strchr(msg.text, '\n')))
            fail_msg("allocation %ld: the message is '%s'", k, msg.text);
        if (!err && (read_files(made_then) != size || memcmp(made_then, whole, size) != 0))
            fail_msg("allocation %ld changes a result, and nobody is told", k);
        if (clear() != 0)
            fail_msg("allocation %ld leaves unfinished files (%s)", k, msg.text);
        if (made < k && err != BEAD_ERROR_MEMORY) { /* the process that reads HDF5 files counts on from this one */
            assert_int_equal(err, BEAD_OK);
            return made;
        }
    }
}

/* A session of this job: opened, planned, run and closed. */
static enum bead_error play(const void *job, struct bead_message *msg)
{
    struct bead_session *session = NULL;
    FILE *plan = fopen("/dev/null", "w");
    assert_non_null(plan);
    enum bead_error err = bead_session_open(job, &session, msg);
    assert_true(err ? !session : session != NULL);
    if (!err)
        err = bead_session_plan(session, plan, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    fclose(plan);
    return err;
}

static long fail_each_of_job(struct bead_job job, const struct bead_sink_type *const *sinks)
{
    const struct bead_sink_type *const *const list[] = {sinks, NULL};
    job.size = sizeof job;
    job.sinks = list;
    job.canvas = "plain";
    job.threads = 1;
    return fail_each(play, &job);
}

static long fail_each_of_scene(const char *text, const struct bead_sink_type *const *sinks)
{
    char path[512];
    snprintf(path, sizeof path, "%s/kept.yaml", directory);
    write_text(path, text);
    return fail_each_of_job((struct bead_job){.input = path, .output = directory}, sinks);
}

#endif
