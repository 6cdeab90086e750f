/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which beads of a chain are shown, and with which words. */
#ifndef BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_PARTS_H
#define BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_PARTS_H

#include "render/schematic/schematic_plan.h"

/* Segments of the chain, `most` of them; the segments left out between the first and last ones form one part. Returns the number of
 * parts, at most `most` + 1. */
size_t bead_parts_make(const struct bead_chain *chain, size_t most, struct bead_part *parts);
/* Beads of all parts, at most about `most` of each. false: out of memory. */
BEAD_CHECK bool bead_parts_strip(const struct bead_chain *chain, const struct bead_part *parts, size_t count, size_t most,
                                 struct bead_strip *strip);
/* Words above and below with their widths. */
void bead_parts_labels(struct bead_plan_row *row, const struct bead_text_style *style, bool details);
/* `decimals`: of M. */
void bead_parts_header(struct bead_plan_row *row, const struct bead_text_style *style, int decimals, double width);

#endif
