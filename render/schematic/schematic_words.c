/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words shared by schematic drawings: names of cells, groups of beads, materials. */

#include "render/draw/markup.h"
#include "render/schematic/schematic_sketch.h"

const char *bead_cell_word(size_t beads, bool several)
{
    static const char *const words[][2] = {{"bead", "beads"},         {"dimer", "dimers"},       {"trimer", "trimers"},
                                           {"tetramer", "tetramers"}, {"pentamer", "pentamers"}, {"cell", "cells"}};
    size_t last = sizeof words / sizeof *words - 1, row = beads - 1 < last ? beads - 1 : last;
    return words[row][several];
}

/* Does a label contain the radius? "steel, 4.76 mm" contains "4.76\u00a0mm". */
static bool says_radius(const char *label, const char *radius)
{
    char number[32];
    snprintf(number, sizeof number, "%.*s", (int)strcspn(radius, "\u00a0"), radius);
    return *number && strstr(label, number);
}

static void material_words(const struct bead_material *material, char *out, size_t size)
{
    char name[96], radius[32], mass[32];
    bead_text_escape(material->label, name, sizeof name);
    bead_quantity(material->radius, "m", 3, radius, sizeof radius);
    bead_quantity(1e3 * material->mass, "g", 3, mass, sizeof mass);
    if (says_radius(material->label, radius))
        snprintf(out, size, "%s, %s", name, mass);
    else
        snprintf(out, size, "%s, " BEAD_SYMBOL("R") " = %s, %s", name, radius, mass);
}

void bead_materials_words(const struct bead_material *first, const struct bead_material *last, char *out, size_t size)
{
    char name[2][96], radius[2][32], mass[2][32];
    const struct bead_material *ends[] = {first, last};
    if (first == last) {
        material_words(first, out, size);
        return;
    }
    for (int i = 0; i < 2; i++) {
        bead_text_escape(ends[i]->label, name[i], sizeof name[i]);
        bead_quantity(ends[i]->radius, "m", 3, radius[i], sizeof radius[i]);
        bead_quantity(1e3 * ends[i]->mass, "g", 3, mass[i], sizeof mass[i]);
    }
    const bool named_alike = strcmp(name[0], name[1]) == 0;
    snprintf(out, size, "%s%s%s, " BEAD_SYMBOL("R") " = %s to %s, %s to %s", name[0], named_alike ? "" : " to ",
             named_alike ? "" : name[1], radius[0], radius[1], mass[0], mass[1]);
}

void bead_symbol_words(const char *letter, int index, char *out, size_t size)
{
    char text[64];
    if (index > 0)
        snprintf(text, sizeof text, "*%s*_%d", letter, index);
    else
        snprintf(text, sizeof text, "*%s*", letter);
    bead_markup(text, out, size);
}
