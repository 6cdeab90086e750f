/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Confines a process to computing, for libraries that read untrusted files. */
#pragma once

#include <stdbool.h>

#include "sim/base/internal.h"

/* Has the kernel what this needs (seccomp filters)? */
BEAD_INTERNAL bool bead_sandbox_is_there(void);
/* From now on this process reads and writes descriptors that it holds, and computes: it opens no file, makes no connection, runs no
 * program (seccomp, and landlock where there is one), and takes at most 512 MiB more memory. For a process of one thread, as there
 * is no way back. What the kernel cannot do is left out. */
BEAD_INTERNAL void bead_sandbox_enter(void);
