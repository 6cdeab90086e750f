#include "sim/base/thread_pool.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>

struct crew {
    bead_thread_pool_job job;
    void *context;
    size_t count;
    atomic_size_t next;
    atomic_bool failed;
};

struct member {
    struct crew *crew;
    bool calling;
    pthread_t thread;
    /* Its jobs ascend and it stops at an error: there is one at most. */
    enum bead_error error;
    size_t failed_at;
    struct bead_message message;
};

/* A job is begun after all below it: the lowest that fails is always among those found. */
static void *work(void *context)
{
    struct member *m = context;
    struct crew *c = m->crew;
    while (!m->error && !atomic_load(&c->failed)) {
        size_t index = atomic_fetch_add(&c->next, 1);
        if (index >= c->count)
            break;
        m->error = c->job(c->context, index, m->calling, &m->message);
        m->failed_at = index;
    }
    if (m->error)
        atomic_store(&c->failed, true);
    return NULL;
}

/* Signals are for the program's own threads. Returns how many could be started. */
static size_t start(struct member *member, size_t count)
{
    sigset_t all, before;
    size_t started = 0;
    sigfillset(&all);
    if (count == 0 || pthread_sigmask(SIG_SETMASK, &all, &before))
        return 0;
    while (started < count && pthread_create(&member[started].thread, NULL, work, &member[started]) == 0)
        started++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

enum bead_error bead_thread_pool_run(size_t count, int threads, bead_thread_pool_job job, void *context, struct bead_message *msg)
{
    struct crew crew = {.job = job, .context = context, .count = count};
    struct member self = {.crew = &crew, .calling = true};
    size_t others = threads > 1 && count > 1 ? (count < (size_t)threads ? count : (size_t)threads) - 1 : 0;
    struct member *member = others > 0 ? calloc(others, sizeof *member) : NULL;
    for (size_t i = 0; member && i < others; i++)
        member[i].crew = &crew;
    size_t started = member ? start(member, others) : 0;
    work(&self);
    const struct member *lowest = self.error ? &self : NULL;
    for (size_t i = 0; i < started; i++) {
        pthread_join(member[i].thread, NULL);
        if (member[i].error && (!lowest || member[i].failed_at < lowest->failed_at))
            lowest = &member[i];
    }
    enum bead_error err = lowest ? lowest->error : BEAD_OK;
    if (lowest)
        *msg = lowest->message;
    free(member);
    return err;
}
