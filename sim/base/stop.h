/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wish that a run stop: set by a signal handler, in whatever thread that runs, and looked up by all threads. */
#ifndef BEADREEL_SIM_BASE_STOP_H
#define BEADREEL_SIM_BASE_STOP_H

#include <signal.h>
#include <stdbool.h>

/* `stop` may be NULL. Volatile alone is for one thread only. */
static inline bool bead_stop_is_asked(const volatile sig_atomic_t *stop)
{
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED) != 0;
}

static inline void bead_stop_ask(volatile sig_atomic_t *stop, int signal)
{
    __atomic_store_n(stop, signal, __ATOMIC_RELAXED);
}

#endif
