/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pool of threads for independent jobs (chains of a scene or a sweep). Each run starts and joins its own threads. */
#include "sim/base/thread_pool.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/resource.h>

struct pool {
    bead_thread_pool_job job;
    void *context;
    size_t count;
    atomic_size_t next;
    atomic_bool failed;
};

struct worker {
    struct pool *pool;
    bool calling;
    pthread_t thread;
    /* A thread stops at its first error, so it has at most one. */
    enum bead_error error;
    size_t failed_at;
    struct bead_message message;
};

/* Jobs begin in ascending order, so the failing job with the lowest index is always among those begun. */
static void *work(void *context)
{
    struct worker *w = context;
    struct pool *p = w->pool;
    while (!w->error && !atomic_load(&p->failed)) {
        size_t index = atomic_fetch_add(&p->next, 1);
        if (index >= p->count)
            break;
        w->error = p->job(p->context, index, w->calling, &w->message);
        w->failed_at = index;
    }
    if (w->error)
        atomic_store(&p->failed, true);
    return NULL;
}

int bead_thread_start(pthread_t *thread, void *(*function)(void *context), void *context)
{
    static const int own[] = {SIGTRAP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}; /* faults of the thread itself */
    sigset_t all, before;
    sigfillset(&all);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        sigdelset(&all, own[i]);
    int failed = pthread_sigmask(SIG_SETMASK, &all, &before);
    if (failed)
        return failed;
    failed = pthread_create(thread, NULL, function, context);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return failed;
}

struct below {
    int (*function)(void *context);
    void *context;
    int result;
};

/* On Linux each thread has its own priority. Anybody may lower it, but not raise it again: hence a thread that ends. */
static void *run_below(void *context)
{
    enum { NICER = 10 }; /* nice(1)'s default */
    struct below *b = context;
    setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + NICER);
    b->result = b->function(b->context);
    return NULL;
}

int bead_thread_call_below(int (*function)(void *context), void *context)
{
    struct below below = {function, context, 0};
    pthread_t thread;
    if (bead_thread_start(&thread, run_below, &below) != 0)
        return function(context);
    pthread_join(thread, NULL);
    return below.result;
}

enum bead_error bead_thread_pool_run(size_t count, int threads, bead_thread_pool_job job, void *context, struct bead_message *msg)
{
    struct pool pool = {.job = job, .context = context, .count = count};
    struct worker self = {.pool = &pool, .calling = true};
    size_t others = threads > 1 && count > 1 ? (count < (size_t)threads ? count : (size_t)threads) - 1 : 0;
    struct worker *worker = others > 0 ? calloc(others, sizeof *worker) : NULL;
    for (size_t i = 0; worker && i < others; i++)
        worker[i].pool = &pool;
    size_t started = 0;
    while (worker && started < others && bead_thread_start(&worker[started].thread, work, &worker[started]) == 0)
        started++;
    work(&self);
    const struct worker *lowest = self.error ? &self : NULL;
    for (size_t i = 0; i < started; i++) {
        pthread_join(worker[i].thread, NULL);
        if (worker[i].error && (!lowest || worker[i].failed_at < lowest->failed_at))
            lowest = &worker[i];
    }
    enum bead_error err = lowest ? lowest->error : BEAD_OK;
    if (lowest)
        *msg = lowest->message;
    free(worker);
    return err;
}
