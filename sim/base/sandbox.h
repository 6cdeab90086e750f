/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Confines readers of untrusted files to a separate process, which only computes; and, less strictly, whole programs. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

#include "beadreel/error.h"
#include "sim/base/internal.h"

/* Does the kernel support this (seccomp filters)? */
BEAD_INTERNAL bool bead_sandbox_is_there(void);
/* From now on this process reads and writes descriptors that it holds, and computes: it opens no file, makes no connection, runs no
 * program (seccomp, and landlock where there is one), and takes at most 512 MiB more memory. For a process with one thread, as
 * there is no way back. Features that the kernel does not support are left out. */
BEAD_INTERNAL void bead_sandbox_enter(void);
/* For programs, which read scenes of strangers: from now on this process makes no connection and runs no program. Sanitizers, which
 * run programs themselves, are left alone. */
BEAD_INTERNAL void bead_sandbox_confine(void);

/* Like fork(), into the sandbox. The new process keeps standard error and the descriptors, and no other; signals that ask programs
 * to stop are left to the asking process, and a fault ends it silently. */
BEAD_INTERNAL pid_t bead_sandbox_fork(const int *descriptors, size_t count);
/* Ends it; false: another part of the program has already waited for it. */
BEAD_INTERNAL bool bead_sandbox_end(pid_t process, int *status);

typedef void bead_sandbox_work(const void *context, FILE *answer);

/* Lets `work` read the contents of the file `path` (in memory; the path is for messages) in such a process, and takes the answer,
 * to be freed; it ends with an extra NUL. Errors: FORMAT (the process ended over it), IO, MEMORY, SCENE (an answer of more than
 * `most` bytes), STOPPED (a signal came). */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_sandbox_ask(const char *path, bead_sandbox_work *work, const void *context,
                                                          size_t most, char **answer, size_t *length, struct bead_message *msg);
