/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage: beads on a floor that mirrors them, seen from the front and a little from above, with light at their contacts.
 *
 * All light is linear, and only added: a contact's light rises with its force in every colour, so more force is brighter on any
 * bead. The picture is sqrt(t / sqrt(1 + t^2)) of it, which never clips. A bead's own look is baked once for each material and
 * radius; the camera does not turn, so the light of a contact on a bead depends on the column of pixels only, unless it is tilted.
 * The floor is computed every BEAD_STAGE_CELL x BEAD_STAGE_STEP pixels. A fine stage has several of its own pixels for each of the
 * picture, whose light is their mean: for stills, where edges are noticed. Painters: pixel_kernels_stage.h, and
 * assets/shaders/stage_*. Lengths in pixels, y downwards, unless said otherwise. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/render.h"

enum { BEAD_STAGE_CELL = 8, BEAD_STAGE_STEP = 4, BEAD_STAGE_PAD = 16, BEAD_STAGE_CHANNELS = 4 };

/* Sine and cosine of the 12 degrees by which the camera looks down. */
#define BEAD_STAGE_SINE   0.2079117f
#define BEAD_STAGE_COSINE 0.9781476f
/* From linear light to t. */
#define BEAD_STAGE_TONE 1.12f

struct bead_stage_theme {
    float floor[4], back[4];      /* the floor near and far */
    float up[4], down[4], key[4]; /* light from above, from below, from the lamp */
    float surroundings;           /* brightness of the room that polished beads mirror */
    float ground_light, halo;     /* light of contacts on the floor, in the air */
    float mirror, shade;          /* of the floor */
};
extern const struct bead_stage_theme bead_stage_dark, bead_stage_light;

/* Planes of a baked picture: light, how much of a contact's light arrives, coverage, height on the ball (-1..1). */
enum bead_stage_plane {
    BEAD_STAGE_RED,
    BEAD_STAGE_GREEN,
    BEAD_STAGE_BLUE,
    BEAD_STAGE_FORM,
    BEAD_STAGE_COVER,
    BEAD_STAGE_RISE,
    BEAD_STAGE_PLANES
};
enum bead_stage_picture {
    BEAD_STAGE_BESIDE /* neighbours on both sides */,
    BEAD_STAGE_ALONE,
    BEAD_STAGE_MIRROR,
    BEAD_STAGE_PICTURES
};

struct bead_stage_bake {
    float r;
    float colour[3];                       /* sRGB */
    int wide, high;                        /* with the ball in the middle */
    float *picture[BEAD_STAGE_PICTURES];   /* NULL: not baked yet. Rows of planes of wide + 2 PAD numbers */
    unsigned texture[BEAD_STAGE_PICTURES]; /* of OpenGL; 0: none yet */
};

/* A bead as shown. */
struct bead_stage_bead {
    float x, r;
    float colour[3];   /* of its material, sRGB */
    float light[2][3]; /* of the contacts at its left and right: bead_stage_glow */
    float own[3];      /* of the whole bead */
    float tilt[2];     /* sine of the height of the neighbour's centre as seen from this one's */
    float near[2];     /* 1: a neighbour touches it, 0: none is near */
    float edge[2];     /* its ends at its contacts, at the floor; -INFINITY, INFINITY: none */
    float slope[2];    /* of these ends: to the right for each pixel above the floor */
    /* Filled in by bead_stage_prepare. */
    const struct bead_stage_bake *bake;
    int left, top, mirror_top; /* of the pictures */
    float part;                /* of a pixel: how much further right than `left` it is */
    bool lit, tilted, mixed;   /* by contacts; contacts are not level; needs the picture of a bead alone too */
    float tint[3];             /* part of a contact's light that its material reflects */
    float *columns;            /* light[3] of its columns, then `near`: 4 rows of bead_stage_columns(bake) numbers */
};

struct bead_stage_wall {
    float x, width; /* width 0: there is none */
    float colour[3];
    float light[3];
};

struct bead_stage {
    const struct bead_stage_theme *theme;
    int fine; /* pixels of the stage for one of the picture, along and across; 0: as 1 */
    int width, height;
    float unit;   /* radius of the largest bead */
    float centre; /* row of the centre of such a bead */
    struct bead_stage_bead *beads;
    size_t count, room;
    struct bead_stage_wall wall;
    /* Filled in by bead_stage_prepare. */
    struct bead_stage_bake *bakes;
    size_t bake_count;
    float *columns;
    size_t column_room;
    float *grid; /* [grid_rows][CHANNELS][grid_width]: the rest of the floor's own light, and light of contacts */
    float *row;  /* one row of the picture, three colours; then one of the grid; then the sum of rows, three colours */
    int grid_rows, grid_width, row_width; /* the widths are multiples of 16 */
};

/* Fills in what does not depend on the time; theme, width, height, unit, centre and room are set. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stage_open(struct bead_stage *stage, struct bead_message *msg);
void bead_stage_close(struct bead_stage *stage);
/* Call it before painting, after the beads have changed. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stage_prepare(struct bead_stage *stage, struct bead_message *msg);

/* Light of a contact whose force is this part of the largest. */
void bead_stage_glow(double part, float light[3]);
/* The colour, sRGB 0..1, that shows linear light. */
double bead_stage_shown(double light);
/* Light of the floor in a row of pixels, at the points of the grid: red, green, blue, 1. The grid must have been computed. */
void bead_stage_floor_row(const struct bead_stage *stage, int y, float *rgba);
/* The floor's own light in a row. */
void bead_stage_base(const struct bead_stage *stage, float y, float light[3]);

static inline int bead_stage_columns(const struct bead_stage_bake *bake)
{
    return bake->wide + BEAD_STAGE_PAD;
}

/* A row of a plane. */
static inline const float *bead_stage_row(const struct bead_stage_bake *bake, enum bead_stage_picture picture, int y, int plane)
{
    const int span = bake->wide + 2 * BEAD_STAGE_PAD;
    return bake->picture[picture] + ((size_t)y * BEAD_STAGE_PLANES + (size_t)plane) * (size_t)span + BEAD_STAGE_PAD;
}

static inline int bead_stage_fine(const struct bead_stage *stage)
{
    return stage->fine > 1 ? stage->fine : 1;
}

/* Radii of the largest bead above the row of its centre. */
static inline float bead_stage_up(const struct bead_stage *stage, float y)
{
    return (stage->centre - y) / stage->unit;
}

/* Row of the floor's points below the beads' middles. */
static inline float bead_stage_foot(const struct bead_stage *stage)
{
    return stage->centre + BEAD_STAGE_COSINE * stage->unit;
}
