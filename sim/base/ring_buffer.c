/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ring of slots between two threads: one fills them, the other does the work. A movie is encoded behind it. */
#include "beadreel/ring_buffer.h"

#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGN = 64 };

struct bead_ring_buffer {
    size_t slots, slot_bytes;
    uint8_t *memory;
    bead_ring_buffer_work work;
    void *context;
    bool threaded;
    bool taken; /* the producer holds slot `submitted % slots`; its thread only */
    bool ended; /* the last call of `work` has been made and the thread is gone; producer's thread only */
    pthread_t thread;

    /* Shared; with a thread only under the lock. */
    pthread_mutex_t lock;
    pthread_cond_t changed; /* two threads at most, never both waiting: one condition serves both */
    uint64_t submitted, finished;
    bool closing, abandoned;
    enum bead_error error;
    struct bead_message message;
};

static void *slot_at(const struct bead_ring_buffer *pipe, uint64_t index)
{
    return pipe->memory + (size_t)(index % pipe->slots) * pipe->slot_bytes;
}

/* Only the first error counts: those after it follow from it. */
static void keep_error(struct bead_ring_buffer *pipe, enum bead_error error, const struct bead_message *message)
{
    if (!error || pipe->error)
        return;
    pipe->error = error;
    pipe->message = *message;
}

static enum bead_error call(struct bead_ring_buffer *pipe, void *slot, int last, struct bead_message *message)
{
    message->text[0] = '\0';
    return pipe->work(pipe->context, slot, last, message);
}

/* A producer that finds the ring full waits until half of it is free. Woken for every slot, it would fill that slot and wait again,
 * and the two threads would do little else. */
static bool has_room(const struct bead_ring_buffer *pipe)
{
    return pipe->submitted - pipe->finished <= pipe->slots / 2;
}

static void *run_worker(void *argument)
{
    struct bead_ring_buffer *pipe = argument;
    struct bead_message message;
    enum bead_error error = call(pipe, NULL, BEAD_PIPE_MORE, &message);
    pthread_mutex_lock(&pipe->lock);
    for (;;) {
        keep_error(pipe, error, &message);
        if (pipe->error || has_room(pipe))
            pthread_cond_signal(&pipe->changed);
        while (!pipe->error && !pipe->abandoned && !pipe->closing && pipe->finished == pipe->submitted)
            pthread_cond_wait(&pipe->changed, &pipe->lock);
        if (pipe->error || pipe->abandoned || pipe->finished == pipe->submitted)
            break;
        void *slot = slot_at(pipe, pipe->finished);
        pthread_mutex_unlock(&pipe->lock);
        error = call(pipe, slot, BEAD_PIPE_MORE, &message);
        pthread_mutex_lock(&pipe->lock);
        pipe->finished++;
    }
    /* The worker destroys what it made in its own thread; after an error at once, as the producer may still be busy. */
    int last = pipe->error || pipe->abandoned ? BEAD_PIPE_ABANDONED : BEAD_PIPE_DONE;
    pthread_mutex_unlock(&pipe->lock);
    error = call(pipe, NULL, last, &message);
    pthread_mutex_lock(&pipe->lock);
    keep_error(pipe, error, &message);
    pthread_mutex_unlock(&pipe->lock);
    return NULL;
}

/* Signals are for the program's own threads: the worker takes none. */
static int start_thread(struct bead_ring_buffer *pipe)
{
    sigset_t all, before;
    sigfillset(&all);
    int failed = pthread_sigmask(SIG_SETMASK, &all, &before);
    if (failed)
        return failed;
    failed = pthread_create(&pipe->thread, NULL, run_worker, pipe);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return failed;
}

static enum bead_error ring_start(struct bead_ring_buffer *pipe, struct bead_message *msg)
{
    if (!pipe->threaded) {
        struct bead_message message;
        keep_error(pipe, call(pipe, NULL, BEAD_PIPE_MORE, &message), &message);
        return BEAD_OK;
    }
    int failed = pthread_mutex_init(&pipe->lock, NULL);
    if (!failed) {
        failed = pthread_cond_init(&pipe->changed, NULL);
        if (!failed) {
            failed = start_thread(pipe);
            if (!failed)
                return BEAD_OK;
            pthread_cond_destroy(&pipe->changed);
        }
        pthread_mutex_destroy(&pipe->lock);
    }
    return bead_fail(msg, BEAD_ERROR_IO, "a second thread cannot be started: %s", strerror(failed));
}

enum bead_error bead_ring_buffer_create(size_t slots, size_t slot_bytes, int threads, bead_ring_buffer_work work, void *context,
                                        struct bead_ring_buffer **pipe, struct bead_message *msg)
{
    *pipe = NULL;
    struct bead_ring_buffer *p = calloc(1, sizeof *p);
    if (!p)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a ring buffer");
    p->slots = slots ? slots : 1;
    p->work = work;
    p->context = context;
    p->threaded = threads != 1;
    size_t bytes;
    if (__builtin_add_overflow(slot_bytes ? slot_bytes : 1, (size_t)ALIGN - 1, &p->slot_bytes) ||
        __builtin_mul_overflow(p->slot_bytes / ALIGN * ALIGN, p->slots, &bytes) || !(p->memory = aligned_alloc(ALIGN, bytes))) {
        free(p);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a ring buffer of %zu x %zu bytes", slots, slot_bytes);
    }
    p->slot_bytes = p->slot_bytes / ALIGN * ALIGN;
    memset(p->memory, 0, bytes);
    enum bead_error err = ring_start(p, msg);
    if (err) {
        free(p->memory);
        free(p);
        return err;
    }
    *pipe = p;
    return BEAD_OK;
}

static bool wait_for_slot(struct bead_ring_buffer *pipe)
{
    if (!pipe->threaded)
        return !pipe->error;
    pthread_mutex_lock(&pipe->lock);
    bool full = pipe->submitted - pipe->finished == pipe->slots;
    while (full && !pipe->error && !has_room(pipe))
        pthread_cond_wait(&pipe->changed, &pipe->lock);
    bool free_one = !pipe->error;
    pthread_mutex_unlock(&pipe->lock);
    return free_one;
}

void *bead_ring_buffer_slot(struct bead_ring_buffer *pipe)
{
    if (pipe->ended)
        return NULL;
    if (!pipe->taken)
        pipe->taken = wait_for_slot(pipe);
    return pipe->taken ? slot_at(pipe, pipe->submitted) : NULL;
}

void bead_ring_buffer_submit(struct bead_ring_buffer *pipe)
{
    if (!pipe->taken || pipe->ended)
        return;
    pipe->taken = false;
    if (pipe->threaded) {
        pthread_mutex_lock(&pipe->lock);
        pipe->submitted++;
        pthread_cond_signal(&pipe->changed);
        pthread_mutex_unlock(&pipe->lock);
        return;
    }
    struct bead_message message;
    keep_error(pipe, call(pipe, slot_at(pipe, pipe->submitted), BEAD_PIPE_MORE, &message), &message);
    pipe->submitted++;
    pipe->finished++;
}

static void ring_end(struct bead_ring_buffer *pipe, bool abandon)
{
    if (pipe->ended)
        return;
    pipe->ended = true;
    if (!pipe->threaded) {
        struct bead_message message;
        int last = pipe->error || abandon ? BEAD_PIPE_ABANDONED : BEAD_PIPE_DONE;
        keep_error(pipe, call(pipe, NULL, last, &message), &message);
        return;
    }
    pthread_mutex_lock(&pipe->lock);
    pipe->closing = true;
    pipe->abandoned = abandon;
    pthread_cond_signal(&pipe->changed);
    pthread_mutex_unlock(&pipe->lock);
    pthread_join(pipe->thread, NULL);
    pthread_cond_destroy(&pipe->changed);
    pthread_mutex_destroy(&pipe->lock);
}

enum bead_error bead_ring_buffer_finish(struct bead_ring_buffer *pipe, struct bead_message *msg)
{
    ring_end(pipe, false);
    if (pipe->error && msg)
        *msg = pipe->message;
    return pipe->error;
}

void bead_ring_buffer_destroy(struct bead_ring_buffer *pipe)
{
    if (!pipe)
        return;
    ring_end(pipe, true);
    free(pipe->memory);
    free(pipe);
}
