/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thread pool: runs independent jobs on several threads, including the calling one. */
#pragma once

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

/* A thread that takes no signals: these are for the program's own threads. Returns 0 or an errno. */
BEAD_INTERNAL int bead_thread_start(pthread_t *thread, void *(*function)(void *context), void *context);

/* Call a function in a thread whose priority is lower than the caller's, as by nice(1), and return its result. Threads that it
 * starts inherit the priority and keep it. If no thread can be started, the caller's runs it. */
BEAD_INTERNAL int bead_thread_call_below(int (*function)(void *context), void *context);

/* Job `index`; `calling`: in the thread that called bead_thread_pool_run. */
typedef enum bead_error (*bead_thread_pool_job)(void *context, size_t index, bool calling, struct bead_message *msg);

/* Run jobs 0 to count - 1, begun in this order. After an error no more are begun; the error of the lowest index is returned, as if
 * the jobs ran one after the other. If fewer threads can be started, they do all the work. Errors: those of the jobs. */
BEAD_CHECK enum bead_error bead_thread_pool_run(size_t count, int threads, bead_thread_pool_job job, void *context,
                                                struct bead_message *msg);
