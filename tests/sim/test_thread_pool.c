/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One chain per thread: for any number of threads, the same numbers and the same error. */
#include "support.h"

#include <stdatomic.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sessions.h"
#include "sim/base/thread_pool.h"

static const int threads[] = {1, 2, 5};
enum { COUNTS = sizeof threads / sizeof *threads, JOBS = 40 };

static enum bead_error count_job(void *context, size_t index, bool calling, struct bead_message *msg)
{
    atomic_int *done = context;
    (void)calling;
    (void)msg;
    atomic_fetch_add(&done[index], 1);
    return BEAD_OK;
}

static void every_job_is_done_once(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNTS; t++) {
        atomic_int done[JOBS] = {0};
        struct bead_message msg = {""};
        assert_int_equal(bead_thread_pool_run(JOBS, threads[t], count_job, done, &msg), BEAD_OK);
        for (size_t i = 0; i < JOBS; i++)
            assert_int_equal(done[i], 1);
    }
}

/* The lowest that fails takes longest. */
static enum bead_error fail_job(void *context, size_t index, bool calling, struct bead_message *msg)
{
    (void)context;
    (void)calling;
    if (index < 7)
        return BEAD_OK;
    if (index == 7)
        usleep(20000);
    return bead_fail(msg, BEAD_ERROR_NUMBERS, "job %zu", index);
}

static void the_error_is_that_of_the_lowest(void **state)
{
    (void)state;
    for (size_t t = 0; t < COUNTS; t++) {
        struct bead_message msg = {""};
        assert_int_equal(bead_thread_pool_run(JOBS, threads[t], fail_job, NULL, &msg), BEAD_ERROR_NUMBERS);
        assert_string_equal(msg.text, "job 7");
    }
}

static void *tell_priority(void *context)
{
    *(int *)context = getpriority(PRIO_PROCESS, 0);
    return NULL;
}

static int start_child(void *context)
{
    pthread_t child;
    assert_int_equal(bead_thread_start(&child, tell_priority, context), 0);
    return pthread_join(child, NULL) ? -1 : 42;
}

/* 19 is the lowest that there is. */
static void children_inherit_a_lower_priority(void **state)
{
    (void)state;
    const int own = getpriority(PRIO_PROCESS, 0), lower = own + 10 < 19 ? own + 10 : 19;
    int child = own;
    assert_int_equal(bead_thread_call_below(start_child, &child), 42);
    assert_int_equal(child, lower);
    assert_int_equal(getpriority(PRIO_PROCESS, 0), own);
}

static void nothing_to_do(void **state)
{
    (void)state;
    struct bead_message msg = {""};
    assert_int_equal(bead_thread_pool_run(0, 4, fail_job, NULL, &msg), BEAD_OK);
}

#define CHAIN(seed) \
    "  - {name: c" #seed ", beads: [{cell: [large-steel, aluminium], count: 12, spins: random, magnetism: 0, seed: " #seed "}]}\n"
static const char scene[] = "chains:\n" CHAIN(1) CHAIN(2) CHAIN(3) CHAIN(4) CHAIN(5) "outputs: [{table: peaks.csv, show: peaks}]\n";

/* A number that all bits of all chains' states at all steps go into. */
static uint64_t hash_of(const char *directory, int count)
{
    char path[512];
    snprintf(path, sizeof path, "%s/scene.yaml", directory);
    write_text(path, scene);
    uint64_t hash = play_counts((struct bead_job){.input = path, .output = directory, .threads = count}).state_hash;
    unlink(path);
    snprintf(path, sizeof path, "%s/peaks.csv", directory);
    assert_int_equal(unlink(path), 0);
    return hash;
}

static void an_ensemble_does_not_depend_on_threads(void **state)
{
    (void)state;
    char directory[256];
    snprintf(directory, sizeof directory, "%s/beadreel-crew-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(directory));
    uint64_t one = hash_of(directory, 1);
    assert_true(one != 0);
    for (size_t t = 1; t < COUNTS; t++)
        assert_true(hash_of(directory, threads[t]) == one);
    assert_int_equal(rmdir(directory), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_job_is_done_once),
        cmocka_unit_test(the_error_is_that_of_the_lowest),
        cmocka_unit_test(children_inherit_a_lower_priority),
        cmocka_unit_test(nothing_to_do),
        cmocka_unit_test(an_ensemble_does_not_depend_on_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
