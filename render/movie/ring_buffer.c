/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ring of slots between two threads: one fills them, the other does the work. Movies are encoded in such a thread. */
#include "render/movie/ring_buffer.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/base/thread_pool.h"

enum { ALIGN = 64 };

struct bead_ring_buffer {
    size_t slots, slot_bytes;
    uint8_t *memory;
    bead_ring_buffer_work work;
    void *context;
    bool threaded;
    bool taken; /* the producer holds slot `submitted % slots`; used in its thread only */
    bool ended; /* `work` has had its last call and the thread has ended; used in the producer's thread only */
    pthread_t thread;

    /* Shared: with a thread, use these under the lock only. */
    pthread_mutex_t lock;
    pthread_cond_t changed; /* two threads, never both waiting, so one condition serves both */
    uint64_t submitted, finished;
    bool closing, abandoned;
    enum bead_error error;
    struct bead_message message;
};

static void *slot_at(const struct bead_ring_buffer *ring, uint64_t index)
{
    return ring->memory + (size_t)(index % ring->slots) * ring->slot_bytes;
}

/* Keep the first error: later ones follow from it. */
static void keep_error(struct bead_ring_buffer *ring, enum bead_error error, const struct bead_message *message)
{
    if (!error || ring->error)
        return;
    ring->error = error;
    ring->message = *message;
}

static enum bead_error call(struct bead_ring_buffer *ring, void *slot, int last, struct bead_message *message)
{
    message->text[0] = '\0';
    return ring->work(ring->context, slot, last, message);
}

/* A producer that finds the ring full waits until half of it is free. Woken for each slot, it would fill it and wait again, and the
 * threads would spend their time switching. */
static bool has_room(const struct bead_ring_buffer *ring)
{
    return ring->submitted - ring->finished <= ring->slots / 2;
}

static void *run_worker(void *argument)
{
    struct bead_ring_buffer *ring = argument;
    struct bead_message message;
    enum bead_error err = call(ring, NULL, BEAD_RING_MORE, &message);
    pthread_mutex_lock(&ring->lock);
    for (;;) {
        keep_error(ring, err, &message);
        if (ring->error || has_room(ring))
            pthread_cond_signal(&ring->changed);
        while (!ring->error && !ring->abandoned && !ring->closing && ring->finished == ring->submitted)
            pthread_cond_wait(&ring->changed, &ring->lock);
        if (ring->error || ring->abandoned || ring->finished == ring->submitted)
            break;
        void *slot = slot_at(ring, ring->finished);
        pthread_mutex_unlock(&ring->lock);
        err = call(ring, slot, BEAD_RING_MORE, &message);
        pthread_mutex_lock(&ring->lock);
        ring->finished++;
    }
    /* The last call of `work` frees its resources, in this thread; after an error at once, because the producer may be busy for
     * long. */
    int last = ring->error || ring->abandoned ? BEAD_RING_ABANDONED : BEAD_RING_DONE;
    pthread_mutex_unlock(&ring->lock);
    err = call(ring, NULL, last, &message);
    pthread_mutex_lock(&ring->lock);
    keep_error(ring, err, &message);
    pthread_mutex_unlock(&ring->lock);
    return NULL;
}

static enum bead_error ring_start(struct bead_ring_buffer *ring, struct bead_message *msg)
{
    if (!ring->threaded) {
        struct bead_message message;
        keep_error(ring, call(ring, NULL, BEAD_RING_MORE, &message), &message);
        return BEAD_OK;
    }
    int failed = pthread_mutex_init(&ring->lock, NULL);
    if (!failed) {
        failed = pthread_cond_init(&ring->changed, NULL);
        if (!failed) {
            failed = bead_thread_start(&ring->thread, run_worker, ring);
            if (!failed)
                return BEAD_OK;
            pthread_cond_destroy(&ring->changed);
        }
        pthread_mutex_destroy(&ring->lock);
    }
    return bead_fail(msg, BEAD_ERROR_IO, "cannot start a second thread: %s", strerror(failed));
}

enum bead_error bead_ring_buffer_create(size_t slots, size_t slot_bytes, int threads, bead_ring_buffer_work work, void *context,
                                        struct bead_ring_buffer **ring, struct bead_message *msg)
{
    *ring = NULL;
    struct bead_ring_buffer *r;
    BEAD_TRY(bead_new(&r, 1, msg, "a ring buffer"));
    r->slots = slots ? slots : 1;
    r->work = work;
    r->context = context;
    r->threaded = threads != 1;
    size_t bytes;
    if (__builtin_add_overflow(slot_bytes ? slot_bytes : 1, (size_t)ALIGN - 1, &r->slot_bytes) ||
        __builtin_mul_overflow(r->slot_bytes / ALIGN * ALIGN, r->slots, &bytes) || !(r->memory = aligned_alloc(ALIGN, bytes))) {
        free(r);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a ring buffer of %zu x %zu bytes", slots, slot_bytes);
    }
    r->slot_bytes = r->slot_bytes / ALIGN * ALIGN;
    memset(r->memory, 0, bytes);
    enum bead_error err = ring_start(r, msg);
    if (err) {
        free(r->memory);
        free(r);
        return err;
    }
    *ring = r;
    return BEAD_OK;
}

static bool wait_for_slot(struct bead_ring_buffer *ring)
{
    if (!ring->threaded)
        return !ring->error;
    pthread_mutex_lock(&ring->lock);
    bool full = ring->submitted - ring->finished == ring->slots;
    while (full && !ring->error && !has_room(ring))
        pthread_cond_wait(&ring->changed, &ring->lock);
    bool free_one = !ring->error;
    pthread_mutex_unlock(&ring->lock);
    return free_one;
}

void *bead_ring_buffer_slot(struct bead_ring_buffer *ring)
{
    if (ring->ended)
        return NULL;
    if (!ring->taken)
        ring->taken = wait_for_slot(ring);
    return ring->taken ? slot_at(ring, ring->submitted) : NULL;
}

void bead_ring_buffer_submit(struct bead_ring_buffer *ring)
{
    if (!ring->taken || ring->ended)
        return;
    ring->taken = false;
    if (ring->threaded) {
        pthread_mutex_lock(&ring->lock);
        ring->submitted++;
        pthread_cond_signal(&ring->changed);
        pthread_mutex_unlock(&ring->lock);
        return;
    }
    struct bead_message message;
    keep_error(ring, call(ring, slot_at(ring, ring->submitted), BEAD_RING_MORE, &message), &message);
    ring->submitted++;
    ring->finished++;
}

static void ring_end(struct bead_ring_buffer *ring, bool abandon)
{
    if (ring->ended)
        return;
    ring->ended = true;
    if (!ring->threaded) {
        struct bead_message message;
        int last = ring->error || abandon ? BEAD_RING_ABANDONED : BEAD_RING_DONE;
        keep_error(ring, call(ring, NULL, last, &message), &message);
        return;
    }
    pthread_mutex_lock(&ring->lock);
    ring->closing = true;
    ring->abandoned = abandon;
    pthread_cond_signal(&ring->changed);
    pthread_mutex_unlock(&ring->lock);
    pthread_join(ring->thread, NULL);
    pthread_cond_destroy(&ring->changed);
    pthread_mutex_destroy(&ring->lock);
}

enum bead_error bead_ring_buffer_finish(struct bead_ring_buffer *ring, struct bead_message *msg)
{
    ring_end(ring, false);
    if (ring->error && msg)
        *msg = ring->message;
    return ring->error;
}

void bead_ring_buffer_destroy(struct bead_ring_buffer *ring)
{
    if (!ring)
        return;
    ring_end(ring, true);
    free(ring->memory);
    free(ring);
}
