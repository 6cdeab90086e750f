/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Views: each draws one aspect of one chain into a rectangle it is given, one const table a view. Names and traits: kinds.h.
 *
 *   create -> place (rectangle) -> decorate (axes: once) -> feed (samples, in time order) and draw (contents at a time), repeated
 *
 * A view knows neither files nor codecs, nor where the rectangle lies in the picture. The same view serves PNG, PDF, SVG and
 * movies. A view of your own is such a table: hand it to a session (bead_job.own), whose scenes then find it by its name. Several
 * threads may draw its views at once, each view by one. */
#ifndef BEADREEL_VIEW_H
#define BEADREEL_VIEW_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

#include "beadreel/chain.h"
#include "beadreel/error.h"
#include "beadreel/render.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"

BEAD_BEGIN

/* ---- looks and text: colours, lines and letters of a picture. All lengths in device pixels; a vector file's context is scaled so
 * that its unit is the pixel of the raster inside ---- */

struct bead_rgb {
    double r, g, b;
};

struct bead_look {
    bool dark, clear;          /* clear: no background is painted */
    char family[64];           /* Pango font family: "STIX" on paper, "Lato" on screens */
    double title, label, tick; /* font sizes, px */
    double line;               /* width of axes and curves, px */
    double gap;                /* the usual distance between things, px */
    double margin;             /* between the page's border and its contents, px */
    struct bead_rgb background, panel, ink, faint, accent;
    struct bead_rgb axis; /* lines and ticks */
};

/* Colour of the curve with this number, from 0; repeats after six. */
BEAD_API struct bead_rgb bead_look_curve(const struct bead_look *look, size_t index);

enum bead_align { BEAD_ALIGN_START, BEAD_ALIGN_MIDDLE, BEAD_ALIGN_END, BEAD_ALIGN_BASELINE };

struct bead_text_style {
    const char *family;
    double size; /* px */
    struct bead_rgb colour;
    bool bold;
    enum bead_align across, down; /* where (x, y) lies in the text's box: start, middle, end; down also baseline */
    bool upwards;                 /* turned by 90 degrees, read from bottom to top; across/down then mean the screen's axes */
};
/* For `down`, BEAD_ALIGN_MIDDLE means the middle of digits and capitals, which looks right beside ticks. */
/* Draw Pango markup at (x, y). */
BEAD_API void bead_text_draw(cairo_t *cr, const struct bead_text_style *style, double x, double y, const char *markup);
/* Size of its logical box, before turning. */
BEAD_API void bead_text_size(cairo_t *cr, const struct bead_text_style *style, const char *markup, double *width, double *height);
/* Plain text to markup: escapes & < >; `out` of `size` bytes; cut between characters if too long. */
BEAD_API void bead_text_escape(const char *text, char *out, size_t size);

/* ---- views ---- */

struct bead_camera;
struct bead_canvas;

/* Places of the titles of vertical axes: turned, beside the axis (figures); above the plot (movies). */
enum bead_titles { BEAD_TITLES_BESIDE, BEAD_TITLES_ABOVE, BEAD_TITLES_NONE };

/* Parts of a stage's key: the scale of the light, its quantity's name, the materials. */
enum bead_key_part { BEAD_KEY_LIGHT = 1, BEAD_KEY_MATERIALS = 2, BEAD_KEY_QUANTITY = 4 };

struct bead_view_setup {
    const struct bead_chain *chain;
    size_t chain_index;
    enum bead_field field;
    struct bead_span beads;      /* shown; last is a bead (or contact) of the chain, never SIZE_MAX */
    double time[2];              /* s: span of the picture's time axis */
    struct bead_colours colours; /* their range covers all chains and all times */
    const struct bead_look *look;
    bool axes;       /* axes and labels around the plot */
    bool ticks_only; /* no labels on the vertical axis: plots are low, or the plot to the left has them */
    enum bead_titles titles;
    bool name_left;     /* the title of the axis along the chain is left of its numbers, where vertical axes have theirs */
    int beyond[2];      /* px: how far panels along the chain reach left and right of the plot, for things beside the beads */
    bool over_beads;    /* a view above or below draws the beads, and has what belongs to them */
    int head;           /* stage: px to leave free at its top, for the heading */
    bool small;         /* stage: one in a grid; fewer beads are in view */
    unsigned elsewhere; /* stage: parts of the key that another stage of the picture shows; bead_key_part */
    bool own_colour;    /* profile: in the colour of the chain's number, with others on the same axis */
    bool bead_labels;   /* label the bead axis; false where a view below shares it */
    enum bead_orientation orientation; /* spacetime; AUTO: as TIME_RIGHT */
    bool time_shared;                  /* spacetime, sensors: no labels on the time axis; a view below has them */
    bool against;                      /* spacetime with time to the right: one title above for both axes */
    bool fill;                         /* spacetime: show only the past, with a cursor at the present (movies) */
    bool hold;                         /* profile: also the largest values so far */
    bool cells;                        /* profile: the largest value over a cell and its passage, not each bead's */
    bool ghost;                        /* and the future, dimmed: all samples are fed before the first frame is drawn */
    enum bead_sampling sampling;       /* spacetime */
    double magnify;                    /* beads, stage: factor on displacements, > 0 */
    enum bead_light light;             /* stage */
    bool fine;                         /* stage: several values in each pixel, for still pictures */
    const struct bead_camera *camera;  /* beads, profile: show its window; spacetime: mark it at the present. NULL: all beads */
    size_t modes;                      /* modes: how many */
    bool marked;                       /* spacetime in stills: a thin line at the time `mark`, s */
    double mark;
    bool theory;  /* spacetime: the front that theory predicts */
    bool trust;   /* spacetime, sensors: samples have a comparison run's values; mark where the two differ */
    int coloured; /* profile: px at the left of the plot for the colours of images, whose bar this axis replaces */
};

struct bead_view; /* each type's own */

/* The place of a thing in the frame at present, px. */
struct bead_spot {
    double x, y, r;         /* centre and radius; for things without, those of a bead there */
    bool below;             /* not in view: the place is in the row of all beads */
    struct bead_rect stage; /* room for a note; it is painted anew for each frame */
    struct bead_rect row;   /* and the row, if the spot is in it */
    double front;           /* the foremost contact that the wave has reached */
    bool arrived;           /* it has reached the end */
};

struct bead_view_type {
    const struct bead_view_info *info;
    /* BEAD_FIELD_BITs that it reads from samples. */
    unsigned (*fields)(const struct bead_view_setup *setup);
    /* On failure *view is NULL, or what `destroy` frees. */
    enum bead_error (*create)(const struct bead_view_setup *setup, struct bead_view **view, struct bead_message *msg);
    /* The plot rectangle (without axes) in device pixels; once, before anything is drawn. `canvas` is NULL without
     * BEAD_DRAWS_ON_CANVAS. */
    enum bead_error (*place)(struct bead_view *view, struct bead_rect plot, struct bead_canvas *canvas, struct bead_message *msg);
    /* Draws the parts that never change: frame, axes and labels, outside the plot rectangle too. */
    enum bead_error (*decorate)(struct bead_view *view, cairo_t *cr, struct bead_message *msg);
    /* A sample of this view's chain. */
    enum bead_error (*feed)(struct bead_view *view, const struct bead_sample *sample, struct bead_message *msg);
    /* Draws the contents at `time` (of the last sample fed, or between the last two) into the plot rectangle of `frame`, over the
     * static layer `background`; adds what changed since the last draw. */
    enum bead_error (*draw)(struct bead_view *view, double time, struct bead_frame *frame, const struct bead_frame *background,
                            struct bead_changes *changes, struct bead_message *msg);
    /* Instead of draw, for a frame that is not shown. NULL: drawing does not depend on earlier frames. */
    void (*pass)(struct bead_view *view, double time);
    /* The place of a thing after `draw`; false: the view does not show it. `number`: of the bead or contact. NULL: the view takes
     * no notes. */
    bool (*find)(struct bead_view *view, enum bead_note_of of, size_t number, struct bead_spot *spot);
    /* Draws the contents into a vector file: curves as paths, rasters with nearest-neighbour filter. */
    enum bead_error (*vector)(struct bead_view *view, double time, cairo_t *cr, struct bead_message *msg);
    void (*destroy)(struct bead_view *view);

    /* ---- with BEAD_OVERLAYS ---- */

    /* Before place: `view` also draws `other`, of another chain, and alone is decorated and drawn from then on; both are fed, and
     * destroyed by their owner, `other` not before `view`. Errors: UNSUPPORTED (too many). */
    enum bead_error (*overlay)(struct bead_view *view, struct bead_view *other, struct bead_message *msg);

    /* ---- for layouts; NULL where there is nothing to say ---- */

    /* Room that the view needs left and right of its plot rectangle, px. NULL: none. */
    void (*margins)(const struct bead_look *look, int *left, int *right);
    /* The most height that the view can use in a plot of this width, px. NULL: any. */
    double (*most_height)(const struct bead_view_setup *setup, double width);
    /* The most width that it can use in a plot of this height. NULL: any. */
    double (*most_width)(const struct bead_view_setup *setup, double height);

    /* ---- with BEAD_SHOWS_ALL_TIMES: their range is known only after the last sample ---- */

    /* Least and largest value seen, of pixels or curves; low > high if there was none. */
    void (*extremes)(const struct bead_view *view, double *low, double *high);
    /* The distance from a value at rest that only a short and narrow event exceeds; INFINITY: unknown; and the largest. NULL: the
     * view has none. */
    double (*typical)(const struct bead_view *view, double rest, double *largest);
    /* Before decorate and draw. An image uses the colours; curves use `values` as the ends of their axis. */
    void (*set_range)(struct bead_view *view, const struct bead_colours *colours, const double values[2]);
    /* With trust: the first time at which the picture differs visibly from the comparison run; INFINITY: none. */
    double (*horizon)(struct bead_view *view);
};

static inline bool bead_view_has(const struct bead_view_type *type, unsigned trait)
{
    return (type->info->traits & trait) != 0;
}

BEAD_END

#endif
