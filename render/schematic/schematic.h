/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schematic drawings of a scene, for which nothing is simulated. A contact, drawn to scale (thesis, Fig. 2); the cells of its
 * chains (Fig. 3); the experiment (Fig. 4). */
#ifndef BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_H
#define BEADREEL_RENDER_SCHEMATIC_SCHEMATIC_H

#include "beadreel/sink.h"
#include "render/draw/page.h"
#include "render/schematic/schematic_sketch.h"

/* Is `show` one of them? */
bool bead_schematic_is(enum bead_show show);

/* Draw into 0..width, 0..height px of the sketch's context, on the look's background. Errors: SCENE (with the output's place: no
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
};

/* false: no room. */
bool bead_schematic_contact(const struct bead_drafting *d);
bool bead_schematic_cell(const struct bead_drafting *d);
bool bead_schematic_setup(const struct bead_drafting *d);

/* Pieces of text one after the other, each with an optional ball before it, in as many lines as the area's width requires; the last
 * line is at the bottom. The area shrinks by their height. */
struct bead_piece {
    char markup[512];
    const double *colour; /* of a ball; NULL: none */
};
bool bead_drafting_pieces(const struct bead_drafting *d, struct bead_box *area, const struct bead_piece *pieces, size_t count,
                          bool centred);

/* Markup of a letter in mathematical italics with a lower index (0: none). */
void bead_schematic_symbol(const char *letter, int index, char *out, size_t size);

/* A row of beads in contact, some of them left out. */
struct bead_strip {
    struct bead_strip_bead {
        size_t material;
        bool left_out; /* a gap with dots instead */
        double x, r;   /* result: centre and radius, px; for a gap, half its width */
        size_t mark;   /* the group or segment it belongs to */
    } * beads;
    size_t count, room;
    bool failed; /* out of memory; told to the sketch where the strip is freed */
};
BEAD_CHECK bool bead_strip_add(struct bead_strip *strip, size_t material, bool left_out, size_t mark);
void bead_strip_free(struct bead_strip *strip);
/* Its width, px, with `scale` px per metre and gaps of `gap` px. */
double bead_strip_width(const struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap);
/* Find places from x on. */
void bead_strip_place(struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap, double x);
/* Extent of all beads with this mark; false: there are none. */
bool bead_strip_extent(const struct bead_strip *strip, size_t mark, double *low, double *high);

#endif
