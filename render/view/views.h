/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of every view of the table of kinds, each in a file of its own; bead_view_find looks among these. */
#pragma once

#include "beadreel/view.h"

#define BEAD_VIEW_TYPE(ID, name, ...) extern const struct bead_view_type bead_view_##name##_type;
BEAD_VIEWS(BEAD_VIEW_TYPE)
#undef BEAD_VIEW_TYPE

/* Room, px, that the key of a stage takes at the right of its headroom. */
double bead_stage_key_room(const struct bead_view_setup *setup);
