/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains along a plot: places, labels and magnified displacements. Places of beads or contacts: All are equally wide, unless beads
 * of unlike radii are drawn above or below: then each is as wide there as on the plot, and every number is under its bead. */
#pragma once

#include "beadreel/view.h"
#include "render/draw/axis.h"

/* Would beads drawn over equally wide places be more than half a radius away from theirs, with the narrowest at least two pixels
 * wide if all take `length` px? Reads arrays of the chain if `over_beads` is set. */
bool bead_along_uneven(const struct bead_view_setup *setup, double length);
/* Is a whole string shown between its fixed ends? Its plots extend to these, one spacing beyond the masses. */
bool bead_along_fixed(const struct bead_view_setup *setup);
/* m along the chain: the left border of a bead or contact, from the first shown to one after the last. Gaps are halved. */
double bead_along_border(const struct bead_view_setup *setup, size_t number);
/* The place, 0..1, of a number with fraction, along plots with uneven places. */
double bead_along_place(const struct bead_view_setup *setup, double number);
/* Do both have the same numbers and, if beads are drawn beside these, each within half a radius of the same place? */
bool bead_along_alike(const struct bead_view_setup *setup, const struct bead_view_setup *other);
/* The axis: see bead_axis_along_chain. Its ticks are at their beads. Returns the title. */
const char *bead_along_axis(struct bead_axis *axis, const struct bead_view_setup *setup, double length, double em, bool horizontal);

/* Labels of a moving axis. Each is drawn once and then shifted by parts of a pixel, so that it moves smoothly; it fades out before
 * it reaches an end. */

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

/* ---- the factor by which drawings magnify the displacements of beads ---- */

/* Largest compression as the striker hits bead 1, as if the two were alone, m: the unit of the wave's compressions. The contact
 * then stores (1/2) m v^2 with the reduced mass m. 0 if nothing is struck. */
double bead_compression_scale(const struct bead_chain *chain);
/* The round factor (1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten; at least 1) that shows this compression as a quarter of a
 * radius, or less if softer contacts would show more than half of one; the smallest factor of all chains. */
double bead_magnify_auto(const struct bead_chain *const *chains, size_t count);
