/* What of a chain is shown, and in which words. */
#ifndef BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_PARTS_H
#define BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_PARTS_H

#include "render/schematic/schematic_plan.h"

/* Segments of the chain, `most` of them; between the first and the last ones those left out are one part. Returns how many parts
 * there are, at most `most` + 1. */
size_t bead_parts_make(const struct bead_chain *chain, size_t most, struct bead_part *parts);
/* Beads of all parts, at most about `most` of each. false: out of memory. */
BEAD_CHECK bool bead_parts_strip(const struct bead_chain *chain, const struct bead_part *parts, size_t count, size_t most,
                                 struct bead_strip *strip);
/* Words above and below with their widths. */
void bead_parts_labels(struct bead_plan_row *row, const struct bead_text_style *style, bool details);
void bead_parts_header(struct bead_plan_row *row, const struct bead_text_style *style, double width);

#endif
