/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schematic drawings of a scene, without simulation: a contact, drawn to scale (thesis, Fig. 2); the cells of its chains (Fig. 3);
 * the experiment (Fig. 4). */
#pragma once

#include "beadreel/sink.h"
#include "render/encode/page.h"
#include "render/schematic/schematic_sketch.h"

/* Is `show` one of these drawings? */
bool bead_schematic_is(enum bead_show show);

/* Draws into 0..width, 0..height px of the sketch's context, on the look's background. Errors: SCENE (with the output's place: no
 * room for its labels), MEMORY. */
BEAD_CHECK enum bead_error bead_schematic_draw(const struct bead_output *output, const struct bead_run_context *context,
                                               struct bead_sketch *sketch, double width, double height, struct bead_message *msg);
/* Checks that there is room. Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_schematic_check(const struct bead_output *output, const struct bead_run_context *context,
                                                struct bead_message *msg);
BEAD_CHECK enum bead_error bead_schematic_write(const struct bead_output *output, const struct bead_run_context *context,
                                                const char *path, uint64_t *bytes, struct bead_message *msg);

/* ---- for the drawings themselves ---- */

struct bead_drafting {
    struct bead_sketch *sketch;
    const struct bead_output *output;
    const struct bead_run_context *context;
    struct bead_box area; /* to draw in, without margins */
    bool once;            /* cells only as written, not also reversed */
};

/* false: no room. */
bool bead_schematic_contact(const struct bead_drafting *d);
bool bead_schematic_cell(const struct bead_drafting *d);
bool bead_schematic_setup(const struct bead_drafting *d);
