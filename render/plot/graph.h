/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Graphs: curves, points and error bars over axes, in one panel or several, with rulers, legends, letters and a caption, for
 * everything except pictures of beads: peaks, sweeps, profiles, energies of modes.
 *
 *   struct bead_graph graph = {.panels = panels, .panel_count = 4, .letters = true};
 *   err = bead_graph_write(&graph, output, scene, path, &bytes, &msg);       png, pdf or svg of the output's size and style
 *   err = bead_graph_draw(&graph, &look, cr, width, height, &msg);           or into your own picture
 *
 * All data are borrowed during a call. Numbers are SI; the axes choose prefixes. Texts are UTF-8 with the markup of
 * render/draw/markup.h. */
#pragma once

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"
#include "render/draw/axis.h"
#include "render/draw/looks.h"

/* If a line is too dense for marks, every n-th point has one, alternating with those of other curves. A band lies between y and
 * `upper`. */
enum bead_mark { BEAD_MARK_LINE, BEAD_MARK_POINTS, BEAD_MARK_LINE_POINTS, BEAD_MARK_BAND };
/* Dashes and marks distinguish the curves of a panel, also in greyscale: the first DASHES patterns are for curves, the dotted one
 * is for fits. */
enum { BEAD_SHAPES = 6 };

/* One curve. It is interrupted where y is NaN; points outside the axes are cut off at the frame. */
struct bead_series {
    const double *x, *y; /* [count] */
    const double *error; /* [count], bars from y - error to y + error; NULL: none */
    const double *upper; /* [count], of a band */
    size_t count;
    enum bead_mark mark;
    size_t colour;     /* index for bead_look_curve */
    size_t shape;      /* of points: disc, square, triangle, diamond, triangle on its tip, star, ring, cross, and again */
    size_t dash;       /* of lines: 0 is solid */
    bool faint;        /* thin and pale, below the others (many configurations under their mean) */
    const char *label; /* in the legend; NULL: none */
    bool hollow;       /* points are outlines */
    bool arrows;       /* points beyond the axis are shown as arrows at the frame */
    bool jitter;       /* points of equal x are spread sideways, part of the way to the next x */
};

/* A line across the panel at a value of x (vertical) or y, with a band around it if low < high, and a label beside it; or only the
 * band, with its label in it. */
struct bead_ruler {
    bool vertical;
    double value, low, high; /* value NaN: no line; low, high NaN: no band */
    const char *label;       /* NULL: none */
};

struct bead_graph_axis {
    const char *title, *unit; /* unit "": numbers; "1": counts, whole ticks only */
    double low, high;         /* NaN: from the data, widened to look right */
    enum bead_scale scale;
    bool zero; /* an automatic linear range begins at 0 unless a value is negative */
};

/* Values as colours, below the curves, with a bar on the right. */
struct bead_graph_image {
    double x[2], y[2];        /* the middles of the first and the last column and row */
    size_t columns, rows;     /* two or more */
    const double *values;     /* [columns][rows]; larger pixels show the largest */
    double low, high;         /* ends of the bar, in the map of light or dark pictures whose low end looks like the page */
    const char *title, *unit; /* of the bar */
};

struct bead_panel {
    const char *title; /* above it; NULL: none */
    struct bead_graph_axis x, y;
    const struct bead_series *series;
    size_t series_count;
    const struct bead_ruler *rulers;
    size_t ruler_count;
    const struct bead_graph_image *image; /* NULL: none; a panel with one needs the ends of its axes */
};

struct bead_graph {
    const char *size;                /* size of the whole for messages, "86 x 64 mm"; NULL: left out */
    const char *title, *caption;     /* above and below all panels; NULL: none; the caption is wrapped */
    const struct bead_panel *panels; /* row by row */
    size_t panel_count;
    bool letters;          /* (a), (b), ... if there are two panels or more */
    bool share_x, share_y; /* one range for all panels; labels at the outer axes only */
    bool residuals;        /* the second half of the panels are below the first, and half as high */
};

/* Draw into 0..width, 0..height px of `cr`, on the look's background. Errors: SCENE (too small for that many panels), MEMORY. */
BEAD_CHECK enum bead_error bead_graph_draw(const struct bead_graph *graph, const struct bead_look *look, cairo_t *cr, double width,
                                           double height, struct bead_message *msg);
/* Writes a file in the format of its name with the output's size, dpi, style and theme, below the scene's title if the page has
 * one, above the output's caption; ignores the graph's own title and caption. Errors: those of draw (with the output's place),
 * IO. */
BEAD_CHECK enum bead_error bead_graph_write(const struct bead_graph *graph, const struct bead_output *output,
                                            const struct bead_scene *scene, const char *path, uint64_t *bytes,
                                            struct bead_message *msg);
/* Before its data are known: would `write` have room for the panels, even without curves? Errors: SCENE, MEMORY. */
BEAD_CHECK enum bead_error bead_graph_check(const struct bead_graph *graph, const struct bead_output *output,
                                            const struct bead_scene *scene, struct bead_message *msg);
