/* Schematic drawings of a scene: what nothing needs to be simulated for. A contact, drawn to scale (thesis, Fig. 2); the cells of
 * its chains (Fig. 3); the experiment (Fig. 4). */
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
/* Is there room for it? Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_schematic_check(const struct bead_output *output, const struct bead_run_context *context,
                                                struct bead_message *msg);
BEAD_CHECK enum bead_error bead_schematic_write(const struct bead_output *output, const struct bead_run_context *context,
                                                const char *path, uint64_t *bytes, struct bead_message *msg);

/* ---- for the drawings themselves ---- */

struct bead_drafting {
    struct bead_sketch *sketch;
    const struct bead_output *output;
    const struct bead_run_context *context;
    struct bead_box area; /* to draw in: margins are taken off */
};

/* false: no room. */
bool bead_schematic_contact(const struct bead_drafting *d);
bool bead_schematic_cell(const struct bead_drafting *d);
bool bead_schematic_setup(const struct bead_drafting *d);

/* Pieces of text one after the other, in as many lines as the area's width makes necessary, the last at its bottom; each may have
 * a ball before it. The area loses what they take. */
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
        double x, r;   /* found: centre, radius, px; of a gap half its width */
        size_t mark;   /* what it belongs to: group or segment */
    } * beads;
    size_t count, room;
};
BEAD_CHECK bool bead_strip_add(struct bead_strip *strip, size_t material, bool left_out, size_t mark);
void bead_strip_free(struct bead_strip *strip);
/* px that it takes with `scale` px a metre and gaps of `gap` px. */
double bead_strip_width(const struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap);
/* Find places from x on. */
void bead_strip_place(struct bead_strip *strip, const struct bead_scene *scene, double scale, double gap, double x);
/* Extent of all that has this mark; false: nothing has. */
bool bead_strip_extent(const struct bead_strip *strip, size_t mark, double *low, double *high);

#endif
