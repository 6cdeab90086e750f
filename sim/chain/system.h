/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Systems: what the points of an equation mean to code that shows or stores them as if they were beads.
 *
 * A chain that is an equation has one of these in its specification (bead_equation_spec.system); sim/equation, the room above,
 * knows how it moves. */
#ifndef BEADREEL_SIM_CHAIN_SYSTEM_H
#define BEADREEL_SIM_CHAIN_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sample.h"
#include "beadreel/scene.h"

struct bead_system {
    const char *name, *help;       /* as in scenes: "fput", "kdv", "shock"; with the source of the equation */
    const enum bead_field *fields; /* of its samples, the one to show by default first; BEAD_FIELD_COUNT behind the last;
                                      NULL: spec->variable alone */
    bool beads;                    /* masses at the points: the view of the beads can show them */
    /* What a field means: name, unit "" and title ("strain"); asked for fields that it has. */
    const struct bead_field_info *(*field)(const struct bead_equation_spec *spec, enum bead_field field);
    /* Its formula with its numbers, in a line of plain text; NULL: the name says it. */
    void (*describe)(const struct bead_equation_spec *spec, char *text, size_t size);
    /* Number of points for this accuracy (the same for comparison runs of another accuracy), the first of them and their spacing.
     */
    size_t (*points)(const struct bead_equation_spec *spec, double accuracy);
    void (*places)(const struct bead_equation_spec *spec, size_t points, double *first, double *spacing);
    /* Linear modes 1..count of a sample that has `mode_fields`: energy[k - 1] is that of mode k. NULL: it has none. */
    unsigned mode_fields;
    const char *mode_title; /* "energy of the mode" */
    void (*modes)(const struct bead_equation_spec *spec, size_t points, const double *const field[BEAD_FIELD_COUNT], size_t count,
                  double *energy);
};

/* BEAD_FIELD_BITs of the fields of its samples, and the one to show by default; of beads where spec->system is NULL. */
unsigned bead_system_fields(const struct bead_equation_spec *spec);
enum bead_field bead_system_shown(const struct bead_equation_spec *spec);

#endif
