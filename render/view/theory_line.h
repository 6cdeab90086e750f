/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The front predicted by theory, over a space-time image: a straight line that starts at the first bead when the striker hits it,
 * as fast as the solitary wave of long waves (compacton.h) with the force of the pulse. */
#pragma once

#include <cairo.h>

#include "beadreel/view.h"

struct bead_theory_line;

/* Errors: SCENE, with the output's place (the chain has no such wave, or shows too few beads). */
BEAD_CHECK enum bead_error bead_theory_line_check(const struct bead_output *output, const struct bead_chain *chain,
                                                  struct bead_message *msg);
/* Of a chain that has passed the check. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_theory_line_create(const struct bead_view_setup *setup, struct bead_theory_line **line,
                                                   struct bead_message *msg);
void bead_theory_line_destroy(struct bead_theory_line *line);
/* A sample with forces of contacts. */
void bead_theory_line_feed(struct bead_theory_line *line, const struct bead_sample *sample);
/* Draws it over a part of the image in `plot`, with words that name the theory if they fit; nothing if no pulse has passed. */
void bead_theory_line_draw(const struct bead_theory_line *line, const struct bead_look *look, struct bead_rect plot,
                           struct bead_rect part, cairo_t *cr);
