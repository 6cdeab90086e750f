/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows and traits of views. */
#pragma once

#include "beadreel/scene.h"
#include "sim/base/internal.h"

/* By kind. */
extern BEAD_INTERNAL const struct bead_view_info bead_view_infos[BEAD_VIEW_KINDS];
/* View `index` of those asked for. */
const struct bead_view_info *bead_views_info(const struct bead_views_asked *asked, size_t index);
/* Has any of these views the trait? Have all? */
BEAD_INTERNAL bool bead_views_any(const struct bead_views_asked *asked, unsigned trait);
BEAD_INTERNAL bool bead_views_all(const struct bead_views_asked *asked, unsigned trait);
