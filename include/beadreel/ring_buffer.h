/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pipes: a bounded ring of slots between a producer and one worker thread.
 * With threads == 1 the worker runs inside bead_ring_buffer_submit, in order: the results are the same. */
#ifndef BEADREEL_RING_BUFFER_H
#define BEADREEL_RING_BUFFER_H

#include <stddef.h>

#include "beadreel/error.h"

BEAD_BEGIN

struct bead_ring_buffer;

/* What `last` says. */
enum bead_ring_buffer_last {
    BEAD_PIPE_MORE,     /* not the last call */
    BEAD_PIPE_DONE,     /* every slot has been worked on: finish your files */
    BEAD_PIPE_ABANDONED /* the work failed before, or the producer gave up: remove them */
};

/* The worker: takes one slot's contents in order of submission. Called with slot NULL once before the
 * first slot, in the worker's thread (to create what belongs to that thread, overlapped with the
 * producer), and with slot NULL and `last` true once behind the last, also after an error (to destroy it). */
typedef enum bead_error (*bead_ring_buffer_work)(void *context, void *slot, int last, struct bead_message *msg);

/* `slots` >= 1 of `slot_bytes` each, zeroed at first, 64-byte aligned; a slot comes back as the worker left it.
 * With threads == 1 the first call of `work` happens here; if it fails, finish tells, as with a thread.
 * Errors: MEMORY, IO (no thread). On failure *pipe is NULL and `work` was not called. */
BEAD_API BEAD_CHECK enum bead_error bead_ring_buffer_create(size_t slots, size_t slot_bytes, int threads,
                                                            bead_ring_buffer_work work, void *context,
                                                            struct bead_ring_buffer **pipe, struct bead_message *msg);
/* A free slot to fill; waits for one. NULL after the worker has failed: then finish tells why. */
BEAD_API void *bead_ring_buffer_slot(struct bead_ring_buffer *pipe);
/* Hand over the slot got last; without one nothing happens. */
BEAD_API void bead_ring_buffer_submit(struct bead_ring_buffer *pipe);
/* Wait until everything is done; returns the worker's first error. May be called once; the pipe remains to be destroyed. */
BEAD_API BEAD_CHECK enum bead_error bead_ring_buffer_finish(struct bead_ring_buffer *pipe, struct bead_message *msg);
/* Frees the pipe; NULL is allowed. Without finish before: waits for the slot being worked on, the rest is thrown away. */
BEAD_API void bead_ring_buffer_destroy(struct bead_ring_buffer *pipe);

BEAD_END

#endif
