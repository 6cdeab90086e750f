/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thread pool: runs independent jobs on several threads, including the calling one. */
#ifndef BEADREEL_SIM_BASE_THREAD_POOL_H
#define BEADREEL_SIM_BASE_THREAD_POOL_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"

/* Job `index`; `calling`: in the thread that called bead_thread_pool_run. */
typedef enum bead_error (*bead_thread_pool_job)(void *context, size_t index, bool calling, struct bead_message *msg);

/* Jobs 0 to count - 1 are begun in this order. After an error no more are begun; the error returned is that of the lowest index, as
 * if the jobs ran one after the other. If fewer threads can be started, these do the work. Errors: those of the jobs. */
BEAD_CHECK enum bead_error bead_thread_pool_run(size_t count, int threads, bead_thread_pool_job job, void *context,
                                                struct bead_message *msg);

#endif
