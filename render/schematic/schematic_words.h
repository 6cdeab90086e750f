/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words that schematic drawings share. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/scene.h"
#include "render/draw/axis.h"

/* "dimer", "trimers"; "cell" for long ones. */
const char *bead_cell_word(size_t beads, bool several);

/* Markup of a letter in mathematical italics with a lower index (0: none). */
void bead_symbol_words(const char *letter, int index, char *out, size_t size);
/* Markup: "large steel, R = 4.76 mm, 3.63 g"; for several that differ in size only, "a to b, R = 4.76 mm to 1.80 mm, 3.63 g to
 * 0.195 g"; of one, if first is last. */
void bead_materials_words(const struct bead_material *first, const struct bead_material *last, char *out, size_t size);
