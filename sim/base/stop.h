/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests to stop a run: set by a signal handler, in any thread, and read by all threads. */
#pragma once

#include <signal.h>
#include <stdbool.h>

/* `stop` may be NULL. Atomic, as volatile alone does not work between threads. */
static inline bool bead_stop_is_asked(const volatile sig_atomic_t *stop)
{
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED) != 0;
}

static inline void bead_stop_ask(volatile sig_atomic_t *stop, int signal)
{
    __atomic_store_n(stop, signal, __ATOMIC_RELAXED);
}
