/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of every view of the table of kinds, each in its own file; bead_view_find searches these. */
#pragma once

#include "beadreel/view.h"

#define BEAD_VIEW_TYPE(ID, name, ...) extern const struct bead_view_type bead_view_##name##_type;
BEAD_VIEWS(BEAD_VIEW_TYPE)
#undef BEAD_VIEW_TYPE

/* Never NULL for a kind below BEAD_VIEW_KINDS. */
const struct bead_view_type *bead_view_find(enum bead_view_kind kind);

/* Draws the beginning of a chain at rest on a stage, without a row, numbers or key, into `rect` of a picture. Errors: MEMORY,
 * GRAPHICS. */
BEAD_CHECK enum bead_error bead_stage_at_rest(const struct bead_view_setup *setup, struct bead_rect rect, cairo_t *cr,
                                              struct bead_message *msg);

/* View `index` of those that an output asks for. Errors: USAGE (a function is missing). */
BEAD_CHECK enum bead_error bead_view_take(const struct bead_views_asked *asked, size_t index, const struct bead_view_type **type,
                                          struct bead_message *msg);
