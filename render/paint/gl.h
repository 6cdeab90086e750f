/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenGL, through functions from a context; no GL library is linked. */
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "render/paint/gl_context.h"

/* Calls of OpenGL go through the table of the context that is current in the thread. */
extern _Thread_local void *bead_gl;

/* Open the libraries of a context and create it. The caller closes and frees it, also on failure, unless it is NULL. Errors:
 * GRAPHICS, MEMORY. */
BEAD_CHECK enum bead_error bead_gl_open(const struct bead_context_type *type, struct bead_context **context,
                                        struct bead_message *msg);
/* Make a table of the functions of the current context, for bead_gl; to be freed, also on failure. Errors: GRAPHICS, MEMORY. */
BEAD_CHECK enum bead_error bead_gl_load(const struct bead_context_type *type, void **table, struct bead_message *msg);
/* Compile and link shaders/`vertex`.vert and shaders/`fragment`.frag of the assets, both with `defines` (NULL: none). Errors: IO,
 * MEMORY, GRAPHICS (with the compiler's message). */
BEAD_CHECK enum bead_error bead_gl_program(const char *vertex, const char *fragment, const char *defines, GLuint *program,
                                           struct bead_message *msg);
/* A texture of this size, RGBA8, with its own framebuffer object; `pixels`: B G R X rows of `stride` bytes, NULL: undefined.
 * Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_gl_target(int width, int height, const void *pixels, size_t stride, GLuint *texture,
                                          GLuint *framebuffer, struct bead_message *msg);
/* Report any error since the last call; `doing` is part of the message. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_gl_check(const char *doing, struct bead_message *msg);
