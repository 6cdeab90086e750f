/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the fuzz targets: files, promises, sessions with a watchdog, random numbers. */
#include "tests/fuzz/fuzz.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "beadreel/render.h"
#include "beadreel/scene.h"
#include "beadreel/session.h"
#include "beadreel/sweep.h"
#include "sim/hdf5/h5.h"
#include "sim/scene/scene_internal.h"

static uint32_t state = 1;
static volatile sig_atomic_t stop;
static _Atomic double began; /* s; 0: no session */

void fuzz_must(bool kept, const char *promise)
{
    if (kept)
        return;
    fprintf(stderr, "broken promise: %s\n", promise);
    abort();
}

void fuzz_result(enum bead_error err, const struct bead_message *msg, bool made)
{
    fuzz_must(!err == made, "success makes something, failure nothing");
    if (!err)
        return;
    int status = bead_error_status(err);
    fuzz_must(status == 1 || status == 2, "a failure has status 1 or 2");
    fuzz_must(msg->text[0] && memchr(msg->text, 0, sizeof msg->text), "a failure has a message");
    size_t breaks = 0;
    for (const char *c = msg->text; *c; c++)
        breaks += *c == '\n';
    fuzz_must(breaks <= (err == BEAD_ERROR_SCENE ? 9 : 0), "a message is one line, of a scene at most ten");
}

/* Of the leak sanitizer, where there is one. */
void __lsan_do_leak_check(void) __attribute__((weak));

void fuzz_leaks(void)
{
    static unsigned executions;
    if (++executions % 1000 == 0 && __lsan_do_leak_check)
        __lsan_do_leak_check();
}

const char *fuzz_path(const char *name)
{
    static char path[4096];
    const char *directory = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/beadreel-fuzz-%d-%s", directory ? directory : "/dev/shm", (int)getpid(), name);
    return path;
}

void fuzz_write(const char *path, const uint8_t *data, size_t size)
{
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    bool whole = file >= 0 && write(file, data, size) == (ssize_t)size;
    if (!whole || close(file) != 0) {
        perror(path);
        exit(1);
    }
}

FILE *fuzz_null(void)
{
    static FILE *null;
    if (!null && !(null = fopen("/dev/null", "w")))
        exit(1);
    return null;
}

/* Of libFuzzer: before the first input. Without the ready materials every scene would be refused, and nothing tried. */
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    struct bead_scene *scene = NULL;
    struct bead_message msg = {""};
    (void)argc;
    (void)argv;
    bead_h5_stay_in_process(); /* where its way is seen, and what it leaves open */
    fuzz_must(bead_scene_materials(&scene, &msg) == BEAD_OK, "the ready materials are there");
    bead_scene_free(scene);
    return 0;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *watch(void *nothing)
{
    for (;;) {
        usleep(100000);
        double since = began;
        if (since > 0 && now() - since > 2)
            stop = 1;
    }
    return nothing;
}

static void watch_once(void)
{
    static bool watching;
    pthread_t thread;
    if (!watching && pthread_create(&thread, NULL, watch, NULL) == 0)
        pthread_detach(thread);
    watching = true;
}

static void tell(void *context, const struct bead_progress *progress)
{
    (void)context;
    (void)progress;
}

bool fuzz_session(const char *input, const char *output, bool run)
{
    const struct bead_sink_type *const *const sinks[] = {bead_data_sinks(), bead_render_sinks(), NULL};
    struct bead_session *session = NULL;
    struct bead_message msg = {""};
    struct bead_job job;
    watch_once();
    BEAD_DEFAULT(&job);
    job.input = input;
    job.output = output;
    job.sinks = sinks;
    job.threads = 1;
    job.stop = &stop;
    job.progress = tell;
    stop = 0;
    began = now();
    enum bead_error err = bead_session_open(&job, &session, &msg);
    fuzz_result(err, &msg, session != NULL);
    if (!err) {
        err = bead_session_plan(session, fuzz_null(), &msg);
        fuzz_result(err, &msg, !err);
    }
    bool planned = !err;
    if (planned && run) {
        err = bead_session_run(session, &msg);
        fuzz_result(err, &msg, !err);
    }
    bead_session_close(session);
    began = 0;
    return planned;
}

void fuzz_seed(unsigned seed)
{
    state = seed * 2654435761u + 1;
    if (state == 0)
        state = 1;
}

unsigned fuzz_random(unsigned below)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return below ? state % below : 0;
}
