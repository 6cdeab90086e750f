/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beads view's own state: the row of all beads, and the lens that follows the front. */
#pragma once

#include "beadreel/view.h"
#include "render/paint/paint.h"
#include "render/stage/camera.h"
#include "render/stage/latest.h"
#include "render/stage/moving_labels.h"

/* The place of a piece of the chain in the picture: x = left + (position - from) * scale. */
struct bead_window {
    struct bead_rect rect; /* the pixels it may draw, relative to the view's `area` */
    double left;           /* px */
    double from;           /* m */
    double scale;          /* px per metre; 0: this window does not exist */
    double middle;         /* px: y of the beads' centres */
};

/* Balls and marks of one window, as of now and as last drawn. */
struct bead_drawing {
    struct bead_composed {
        struct bead_ball *balls;
        uint8_t *glow;       /* light of the contact to the right of each ball, 0..255 */
        size_t first, count; /* in beads of the view */
        struct bead_mark *marks;
        size_t mark_count;
    } now, old;
};

struct bead_view {
    struct bead_view_setup setup;
    struct bead_look look;
    struct bead_colormap map;

    /* The chain's beads first .. first + count - 1 are shown. */
    size_t first, count;
    const double *position, *radius; /* of bead `first` on */
    double largest;                  /* m: radius */
    double ends[2];                  /* m: outer edges at rest */
    double compression;              /* m: the compression that counts as strong */
    bool striker, wall;              /* shown */

    /* The last two samples: displacement (m) and field value of every bead shown. */
    double *u[2], *value[2];
    struct bead_latest latest;

    double *numbers; /* memory of u, value, shift, shown, load */

    /* As of the time drawn. */
    double *shift; /* m: magnified displacement */
    double *shown; /* field */
    uint8_t (*colour)[4];
    double *load; /* compression of the contact at the right of each bead, in units of `compression` */
    double speed; /* m/s: of the striker */

    struct bead_rect plot, area;       /* px of the frame: the plot rectangle; the whole area that the view draws into */
    double label_y;                    /* baseline of names, px of the area; < 0: no room for names */
    struct bead_window row, lens;      /* with a camera: only the lens, which shows the camera's window */
    struct bead_camera *camera;        /* of the lens below a row; NULL: the setup's */
    struct bead_moving_labels *labels; /* above it; NULL: none */
    struct bead_rect zoom;             /* between row and lens, px of the area */
    bool strip;                        /* beads are too small to be drawn one by one */
    double (*base)[3];                 /* colour of the materials in each of the strip's columns, 0..1; NULL: no strip */
    struct bead_drawing row_drawing, lens_drawing;
    struct bead_mark zoom_mark, old_zoom_mark;
    double lens_drawn; /* m: lens.from as drawn last */
    bool plain;        /* each row of pixels behind the lens has one colour, so its beads can be moved in the frame */

    struct bead_canvas *canvas; /* borrowed */
    struct bead_backdrop *backdrop;
    bool drawn;
};

/* Columns of a window to be painted, from left to right. */
enum { BEAD_MOST_SPANS = 6 };
struct bead_spans {
    int from[BEAD_MOST_SPANS], to[BEAD_MOST_SPANS]; /* px of the area, `to` exclusive */
    size_t count;
};

/* Differences between the drawings of the row, now and before. */
struct bead_spans bead_beads_row_changes(const struct bead_view *v);
/* Distance, px, by which the contents of the lens can be moved left in the frame. 0: they do not move, or must be repainted. */
int bead_beads_lens_moves(const struct bead_view *v);
/* Differences in the lens after everything has moved left by this many pixels. */
struct bead_spans bead_beads_lens_changes(const struct bead_view *v, int by);
/* Moves the columns of the lens that are not in `spans`. */
void bead_beads_move(const struct bead_view *v, const struct bead_spans *spans, int by, struct bead_frame *frame);
/* Does each row of pixels behind the lens have one colour? */
bool bead_beads_lens_is_plain(const struct bead_view *v, const struct bead_frame *background);
/* Divides the plot rectangle into row, connection and lens. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_beads_divide(struct bead_view *v, struct bead_message *msg);
/* Brings displacements, colours, loads and lens to `time`. */
void bead_beads_advance(struct bead_view *v, double time);
/* Composes the balls and marks of one of the view's windows; the previous ones become the old ones. */
void bead_beads_compose(struct bead_view *v, const struct bead_window *window, struct bead_drawing *drawing);
/* The x in a window, px, of a position along the chain, m. */
double bead_window_x(const struct bead_window *window, double position);
/* The weight of the field in a bead's colour, 0..1; the rest comes from its material. */
double bead_colour_weight(const struct bead_view *v, double value);
/* Colours of the materials along the strip. False: out of memory. */
BEAD_CHECK bool bead_beads_prepare_strip(struct bead_view *v);
/* Draws the row as a density strip and adds the columns that changed. */
void bead_beads_strip(struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                      struct bead_changes *changes);
/* Names and wall of the row; panel of the lens. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_beads_decorate(struct bead_view *v, cairo_t *cr, struct bead_message *msg);
/* Draws everything composed as paths. */
void bead_beads_vector(struct bead_view *v, cairo_t *cr);
/* Room that the view needs left and right of its plot rectangle (the striker flying back; the wall), px. */
void bead_beads_margins(const struct bead_look *look, int *left, int *right);
/* The greatest height, px, that a row of beads and its lens can use in a plot of this width. */
double bead_beads_most_height(const struct bead_view_setup *setup, double width);
double bead_beads_most_width(const struct bead_view_setup *setup, double height);
