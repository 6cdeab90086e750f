/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ways to an OpenGL 3.3 core context without a display: one const table each, which brings its own headers. */
#ifndef BEADREEL_RENDER_PAINT_GL_CONTEXT_H
#define BEADREEL_RENDER_PAINT_GL_CONTEXT_H

#include <stdbool.h>

#include "beadreel/error.h"

struct bead_context; /* each one's own */

struct bead_context_type {
    /* Create a context and make it current in this thread. Errors: GRAPHICS, MEMORY. On failure *context is NULL. */
    enum bead_error (*open)(struct bead_context **context, struct bead_message *msg);
    /* Make it current in this thread, if it is not. */
    bool (*use)(struct bead_context *context);
    /* An OpenGL function or NULL. */
    void *(*function)(struct bead_context *context, const char *name);
    void (*close)(struct bead_context *context);
};

extern const struct bead_context_type bead_context_osmesa, bead_context_egl;

#endif
