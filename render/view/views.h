/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of every view of the table of kinds, each in a file of its own; bead_view_find looks among these. */
#pragma once

#include "beadreel/view.h"

#define BEAD_VIEW_TYPE(ID, name, ...) extern const struct bead_view_type bead_view_##name##_type;
BEAD_VIEWS(BEAD_VIEW_TYPE)
#undef BEAD_VIEW_TYPE

/* Never NULL for a kind below BEAD_VIEW_KINDS. */
const struct bead_view_type *bead_view_find(enum bead_view_kind kind);

/* Room, px, that the key of a stage takes at the right of its headroom. */
double bead_stage_key_room(const struct bead_view_setup *setup);
/* Draws one key for the stages of several chains, which ends at `right` px, or with `cr` NULL measures it; returns its width.
 * `setup`: of the first chain. */
double bead_stage_draw_key_of(cairo_t *cr, const struct bead_view_setup *setup, const struct bead_chain *const *chains,
                              size_t count, double right, double middle, double size);

/* Draws the beginning of a chain at rest on a stage, without a row, numbers or key, into `rect` of a picture. Errors: MEMORY,
 * GRAPHICS. */
BEAD_CHECK enum bead_error bead_stage_at_rest(const struct bead_view_setup *setup, struct bead_rect rect, cairo_t *cr,
                                              struct bead_message *msg);

/* View `index` of those that an output asks for. Errors: USAGE (a function is missing). */
BEAD_CHECK enum bead_error bead_view_take(const struct bead_views_asked *asked, size_t index, const struct bead_view_type **type,
                                          struct bead_message *msg);
/* The line of numbers below a stage, in units of the ticks' font size. */
#define BEAD_STAGE_NUMBERS 1.45
