/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waves that were measured: points from files, and from the text of scenes. */
#pragma once

#include "sim/options/options.h"

extern const struct bead_options bead_drive_file_options, bead_measured_options;

/* Before the document is read: puts points in the place of files, below `drive` and `measured`. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_scene_take_waves(struct bead_reader *reader, const struct bead_at *at, bool *changed);
/* "0 0, 1e-6 0.25, ...": seconds, which rise, and values; `shape` says in messages what the value must be. *points is the caller's,
 * also after an error. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_wave_points_read(const struct bead_reader *reader, const struct bead_at *at, const char *shape,
                                                 struct bead_wave_point **points, size_t *count);
