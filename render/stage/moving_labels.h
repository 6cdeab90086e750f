/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Labels of a moving axis. Each is drawn once and then shifted by parts of a pixel, so that it moves smoothly; it fades out before
 * it reaches an end. */
#pragma once

#include "beadreel/view.h"
#include "render/draw/axis.h"

enum bead_label_sign { BEAD_LABEL_PLAIN, BEAD_LABEL_TICK /* above the text */, BEAD_LABEL_POINTER /* below it */ };

struct bead_moving_labels;

/* Labels in the rectangle `strip` of frames; `scale`: px a metre. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_moving_labels_create(const struct bead_look *look, struct bead_rect strip, double scale,
                                                     struct bead_moving_labels **labels, struct bead_message *msg);
void bead_moving_labels_destroy(struct bead_moving_labels *labels);
/* A label at `place`, m along the chain; left out if it would overlap an earlier one. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_moving_labels_add(struct bead_moving_labels *labels, double place, const char *markup,
                                                  struct bead_rgb colour, enum bead_label_sign sign, struct bead_message *msg);
/* The numbers of beads first .. first + count - 1 at their positions, as many as fit into a window of `width` m. */
BEAD_CHECK enum bead_error bead_moving_labels_count(struct bead_moving_labels *labels, const double *place, size_t first,
                                                    size_t count, double width, enum bead_label_sign sign,
                                                    struct bead_message *msg);
/* Draws the labels with the strip's left edge at `left`, m, if that has changed or `changes` is NULL. Errors: GRAPHICS. */
BEAD_CHECK enum bead_error bead_moving_labels_draw(struct bead_moving_labels *labels, double left, struct bead_frame *frame,
                                                   const struct bead_frame *background, struct bead_changes *changes,
                                                   struct bead_message *msg);
