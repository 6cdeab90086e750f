/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Systems: what a chain of a scene can be, one const row each. Beads that push each other are one, equations such as that of
 * Korteweg and de Vries are others.
 *
 * A row has everything that depends on the system: first the traits, then what the numbers of its samples mean. To add a system: a
 * file and a row in sim/equation/systems.c, and its keys in sim/scene/scene_equation.c. Every row has all words and functions,
 * except those for which NULL is allowed below. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/sample.h"
#include "beadreel/scene.h"

struct bead_equation; /* inside the library */

struct bead_system {
    const char *name, *help; /* as in scenes: "fput", "kdv", "shock"; with the source of the equation */
    const char *label;       /* the name where lists and captions need it; "" of beads, which go without saying */
    const char *points;      /* word for the places of the chain: "beads", "points" */
    const char *axis;        /* title of the axis along the chain: "bead", "x" */
    const char *axis_unit;   /* as graphs and axes take it: "1" of numbers of beads, "" of coordinates */
    const char *time_unit;   /* "s"; "" where numbers have no units */
    bool has_contacts;       /* beads of materials, with masses and radii, push each other: contact forces, and their peaks */
    bool has_striker;        /* bead 0 strikes the others, which are at rest until a front comes */
    bool has_masses;         /* there is a mass at each place, which the view of the beads can show */
    bool names_fields;       /* its fields have titles of their own, such as "u": tables and files use them */
    /* The motion; NULL: by the forces of its contacts. */
    const struct bead_equation *equation;

    /* The fields of its samples, the one to show by default first; BEAD_FIELD_COUNT after the last. NULL: equation.variable alone.
     */
    const enum bead_field *fields;
    /* Name, unit and title of a field; called for fields that the system has. */
    const struct bead_field_info *(*field)(enum bead_field field);
    /* May values of the field have either sign? */
    bool (*field_signed)(const struct bead_chain_spec *spec, enum bead_field field);
    /* Its formula with its numbers, in a line of plain text; "" where there is none. */
    void (*describe)(const struct bead_chain_spec *spec, char *text, size_t size);
    /* Number of places for this accuracy (the same for comparison runs of another accuracy). */
    size_t (*count)(const struct bead_chain_spec *spec, double accuracy);
    /* Places along the axis: that of the first of `count`, and their spacing. */
    void (*places)(const struct bead_chain_spec *spec, size_t count, double *first, double *spacing);
    /* By what part of their distance at rest neighbouring masses come closer; NULL: they do not move, or have radii. */
    double (*approach)(const struct bead_chain_spec *spec);
    /* Linear modes 1..count of a sample that has `mode_fields` (0 beside `fields` NULL: the variable): energy[k - 1] is that of
     * mode k. NULL: it has none. */
    unsigned mode_fields;
    const char *mode_title; /* "energy of the mode" */
    void (*modes)(const struct bead_chain_spec *spec, size_t points, const double *const field[BEAD_FIELD_COUNT], size_t count,
                  double *energy);
};

/* The row of beads; sim/equation, the room above, has the table and the other rows. */
extern const struct bead_system bead_system_beads;

/* BEAD_FIELD_BITs of the fields of its samples, and the one to show by default. */
unsigned bead_system_fields(const struct bead_chain_spec *spec);
enum bead_field bead_system_shown(const struct bead_chain_spec *spec);
