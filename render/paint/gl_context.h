/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ways to an OpenGL 3.3 core context without a display: a const table for each, in a file with its own headers. */
#pragma once

#include <stdbool.h>

#include "sim/base/library.h"

struct bead_context; /* each way has its own */

struct bead_context_type {
    const struct bead_library_info *libraries; /* libraries to open, */
    const char *names;                         /* for these functions, */
    void **table;                              /* stored here: see bead_library_load */
    size_t bytes;                              /* of a context */
    /* Create the context, which is all zero, and make it current in this thread. Returns NULL, or the reason of a failure; close it
     * in any case. */
    const char *(*open)(struct bead_context *context);
    /* Make it current in this thread. */
    bool (*use)(struct bead_context *context);
    /* An OpenGL function, or NULL; needs a current context. */
    void *(*function)(const char *name);
    void (*close)(struct bead_context *context);
};

extern const struct bead_context_type bead_context_osmesa, bead_context_egl;
