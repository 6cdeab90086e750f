/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of beads in contact, some of them left out. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/scene.h"

struct bead_strip {
    struct bead_strip_bead {
        size_t material;
        bool left_out; /* a gap with dots instead */
        double x, r;   /* result: centre and radius, px; for a gap, half its width */
        size_t mark;   /* the group or segment it belongs to */
    } * beads;
    size_t count, room;
    bool failed; /* out of memory; the caller that frees the strip tells the sketch */
};
/* `count` beads of materials that are `step` places apart: all of them, or the first `lead` and the last `tail` with a gap instead
 * of two or more. False: out of memory. */
BEAD_CHECK bool bead_strip_add(struct bead_strip *strip, const size_t *material, ptrdiff_t step, size_t count, size_t lead,
                               size_t tail, size_t mark);
BEAD_CHECK bool bead_strip_add_gap(struct bead_strip *strip, size_t mark);
void bead_strip_free(struct bead_strip *strip);
/* Width of the strip, px, with `scale` px per metre and gaps of `gap` px. */
double bead_strip_width(const struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap);
/* Finds places, from x. */
void bead_strip_place(struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap, double x);
/* Extent of all beads with this mark; false: no bead has it. */
bool bead_strip_extent(const struct bead_strip *strip, size_t mark, double *low, double *high);
