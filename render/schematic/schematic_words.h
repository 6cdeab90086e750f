/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words that schematic drawings share. */
#ifndef BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_WORDS_H
#define BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/look.h"
#include "beadreel/scene.h"

/* "dimer", "trimers"; "cell" for long ones. */
const char *bead_cell_word(size_t beads, bool several);

/* Beads of one material that follow each other in a cell. */
struct bead_cell_group {
    size_t material, beads;
};
/* Groups of a cell, left to right; 0: too many. */
size_t bead_cell_groups(const struct bead_segment *segment, struct bead_cell_group *groups, size_t room);
/* Reads the same from both ends. */
bool bead_cell_mirrored(const struct bead_segment *segment);

/* Markup: "large steel, R = 4.76 mm, 3.63 g". */
void bead_material_words(const struct bead_material *material, char *out, size_t size);
/* Of several that differ in size only: "a to b, R = 4.76 mm to 1.80 mm, 3.63 g to 0.195 g"; of one, if first is last. */
void bead_materials_words(const struct bead_material *first, const struct bead_material *last, char *out, size_t size);

#endif
