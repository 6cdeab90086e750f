/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage view's own state: large beads on the stage, and below it the row of all beads with the window marked. */
#pragma once

#include "beadreel/view.h"
#include "render/paint/paint.h"
#include "render/paint/stage.h"
#include "render/stage/camera.h"
#include "render/stage/camera_steps.h"
#include "render/stage/latest.h"

enum { BEAD_STAGE_RADII = 120 }; /* most different radii */

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;

    /* The chain's beads first .. first + count - 1, and the contacts between them, are shown; with the wall, one contact more. */
    size_t first, count, contacts;
    const double *position, *radius; /* of bead `first` on */
    double largest;                  /* m: radius */
    double *place;                   /* m: centres on the floor at rest, where beads of unlike radii touch */
    double ends[2];                  /* m: outer edges there */
    double full;                     /* N, or the field's unit: full light */
    bool has_contacts, wall;

    /* The last two samples: displacement (m), force (N) of each contact or value of each bead; and their current values. */
    double *u[2], *force[2], *shift, *load, *excess; /* excess: of the force over the static one */
    signed char *way;                                /* its direction: 1, -1, 0: none */
    struct bead_latest latest;
    double *numbers; /* memory of these */

    /* px of the frame: plot; the stage with its headroom; rows that only `decorate` draws; the row of all beads. */
    struct bead_rect plot, strip;
    int head;
    double scale; /* px a metre, of the stage */
    struct bead_stage stage;
    struct bead_step_camera camera; /* px; width 0: all beads are shown */
    double left;                    /* px along the stage at the strip's left edge */

    struct bead_rect row; /* height 0: none */
    double row_left, row_scale;
    struct bead_ball *balls, *old_balls;
    struct bead_mark window[4], old_window[4];
    struct bead_canvas *canvas; /* borrowed */
    struct bead_backdrop *backdrop;
    bool drawn;

    /* For looks without a background: themes with a black and a grey floor, and the picture on the grey one. */
    struct bead_stage_theme floors[2];
    struct bead_frame on_grey;
};

/* Divides the plot. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_stage_divide(struct bead_view *v, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_stage_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *msg);
/* Draws the area below the stage, around the row. */
void bead_stage_draw_names(const struct bead_view *v, cairo_t *cr);
/* Draws the key into the headroom. */
void bead_stage_draw_key(const struct bead_view *v, cairo_t *cr);
/* The field shown as light, and its value at full light, beyond any static force: the largest that colours show or, if they show
 * another field, the force of the striker's hit. */
enum bead_field bead_stage_field(const struct bead_view_setup *setup);
double bead_stage_full(const struct bead_view_setup *setup);
/* Brings displacements, loads and camera to `time`; once for each frame. */
void bead_stage_advance(struct bead_view *v, double time);
/* Puts the beads in view on the stage. */
void bead_stage_compose(struct bead_view *v);
/* Paints the composed stage into this place of the frame: opaque, or, if the look has no background, with alpha, premultiplied, so
 * that light is added to the picture behind and shadows darken it. Errors: MEMORY, GRAPHICS. */
BEAD_CHECK enum bead_error bead_stage_paint(struct bead_view *v, struct bead_canvas *canvas, struct bead_rect place,
                                            struct bead_frame *frame, struct bead_message *msg);
/* Balls of the row, and the mark around the window. */
void bead_stage_compose_row(struct bead_view *v);
/* The place, m along the floor at rest, of a number among the contacts: 3.5 is between contacts 3 and 4. */
double bead_stage_between(const struct bead_view *v, double head);
/* px from the left edge of the row to a place on the floor. */
double bead_stage_row_x(const struct bead_view *v, double place);
/* See bead_view_type. */
bool bead_stage_find(struct bead_view *v, enum bead_note_of of, size_t number, struct bead_spot *spot);
/* Height, px, of a stage of this width with the largest beads that it may have. */
double bead_stage_height(double width);
