/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ring of slots between a producer and one worker thread.
 * With threads == 1 the worker runs inside bead_ring_buffer_submit, in order: the results are the same. */
#pragma once

#include <stddef.h>

#include "beadreel/error.h"

struct bead_ring_buffer;

/* Values of `last`. */
enum bead_ring_buffer_last {
    BEAD_RING_MORE,     /* not the last call */
    BEAD_RING_DONE,     /* every slot has been worked on: finish your files */
    BEAD_RING_ABANDONED /* the work failed before, or the producer gave up: remove them */
};

/* The worker: takes one slot's contents in order of submission. Called with slot NULL once before the first slot, in the worker's
 * thread (to create what belongs to that thread, overlapped with the producer), and with slot NULL and `last` true once after the
 * last, also after an error (to destroy it). */
typedef enum bead_error (*bead_ring_buffer_work)(void *context, void *slot, int last, struct bead_message *msg);

/* `slots` >= 1 of `slot_bytes` each, zeroed at first, 64-byte aligned; a slot comes back as the worker left it. With threads == 1
 * the first call of `work` happens here; if it fails, finish reports it, as with a thread. Errors: MEMORY, IO (no thread). On
 * failure *ring is NULL and `work` was not called. */
BEAD_CHECK enum bead_error bead_ring_buffer_create(size_t slots, size_t slot_bytes, int threads, bead_ring_buffer_work work,
                                                   void *context, struct bead_ring_buffer **ring, struct bead_message *msg);
/* A free slot to fill; waits for one. NULL after the worker has failed: finish then says why. */
void *bead_ring_buffer_slot(struct bead_ring_buffer *ring);
/* Hand over the last slot obtained; without one nothing happens. */
void bead_ring_buffer_submit(struct bead_ring_buffer *ring);
/* Wait until everything is done; returns the worker's first error. May be called once; the ring remains to be destroyed. */
BEAD_CHECK enum bead_error bead_ring_buffer_finish(struct bead_ring_buffer *ring, struct bead_message *msg);
/* Frees the ring; NULL is allowed. Without a previous finish: waits for the slot being worked on, and discards the rest. */
void bead_ring_buffer_destroy(struct bead_ring_buffer *ring);
