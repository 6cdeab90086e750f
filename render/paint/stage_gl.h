/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage painted with OpenGL: rectangles that together cover each pixel once, with assets/shaders/stage.frag. */
#pragma once

#include "render/paint/gl.h"
#include "render/paint/stage.h"

struct bead_stage_painter; /* of a canvas; its textures are destroyed with the context */

/* Paints a prepared stage, with its grid, into the bound framebuffer of this size, from row `skip`. Creates *painter if it is NULL.
 * Errors: GRAPHICS, IO, MEMORY. */
BEAD_CHECK enum bead_error bead_stage_gl(struct bead_stage_painter **painter, const int size[2], const struct bead_stage *stage,
                                         int skip, struct bead_message *msg);
void bead_stage_gl_free(struct bead_stage_painter *painter);
