/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Graphs: curves, points and error bars over axes, in one panel or several, with rulers, legends, letters and a caption. They
 * draw everything that is not a picture of beads: peaks, sweeps, profiles, energies of modes.
 *
 *   struct bead_graph graph = {.panels = panels, .panel_count = 4, .columns = 2, .letters = true};
 *   err = bead_graph_write(&graph, output, scene, path, &bytes, &msg);              png, pdf or svg of the output's size and style
 *   err = bead_graph_draw(&graph, &look, cr, width, height, &msg);           or into a picture of one's own
 *
 * * Plain data, borrowed: nothing is kept after the call. Numbers are SI; the axes choose prefixes. Texts are plain text with
 * Greek and signs as UTF-8; `_x`, `_{xy}`, `^x` and `^{xy}` set subscripts and superscripts, `*x*` in mathematical italics
 * (render/draw/markup.h). */
#ifndef BEADREEL_RENDER_PLOT_GRAPH_H
#define BEADREEL_RENDER_PLOT_GRAPH_H

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/look.h"
#include "beadreel/scene.h"

/* Marks on a line that have no room at every point stand at every n-th, in turn with those of the other curves. A band lies between
 * y and `upper`. */
enum bead_mark { BEAD_MARK_LINE, BEAD_MARK_POINTS, BEAD_MARK_LINE_POINTS, BEAD_MARK_BAND };
/* Curves of one panel differ by dashes and shapes of marks, so that they are told apart in grey, too: the first DASHES patterns are
 * for them, the dotted one is for fits. */
enum { BEAD_DASHES = 6, BEAD_DASH_DOTTED = BEAD_DASHES, BEAD_SHAPES = 6 };

/* One curve. It is interrupted where y is NaN; points outside the axes are cut off at the frame. */
struct bead_series {
    const double *x, *y; /* [count] */
    const double *error; /* [count], bars from y - error to y + error; NULL: none */
    const double *upper; /* [count], of a band */
    size_t count;
    enum bead_mark mark;
    size_t colour;     /* number of the colour, as bead_look_curve has them */
    size_t shape;      /* of points: disc, square, triangle, diamond, triangle on its tip, star, ring, cross, and so on in turn */
    size_t dash;       /* of lines: 0 is whole, and so on in turn */
    bool faint;        /* thin and pale, below the others (many configurations behind their mean) */
    const char *label; /* in the legend; NULL: not there */
    bool hollow;       /* points are outlines */
    bool arrows;       /* points beyond the axis are shown as arrows at the frame */
    bool jitter;       /* points of equal x stand side by side, in part of the way to the next */
};

/* A line across the panel at a value of x (vertical) or y, with a band around it if low < high, and a word beside it. */
struct bead_ruler {
    bool vertical;
    double value, low, high; /* low, high NaN: no band */
    const char *label;       /* NULL: none */
};

struct bead_graph_axis {
    const char *title, *unit; /* unit "": numbers; "1": counts, whole ticks only */
    double low, high;         /* NaN: from the data, widened to look right */
    enum bead_scale scale;
    bool zero; /* an automatic linear range begins at 0 unless a value is negative */
};

struct bead_panel {
    const char *title; /* above it; NULL: none */
    struct bead_graph_axis x, y;
    const struct bead_series *series;
    size_t series_count;
    const struct bead_ruler *rulers;
    size_t ruler_count;
};

struct bead_graph {
    const char *size;                /* size of the whole for messages, "86 x 64 mm"; NULL: left out */
    const char *title, *caption;     /* above and below all panels; NULL: none; the caption is wrapped */
    const struct bead_panel *panels; /* row by row */
    size_t panel_count, columns;     /* columns 0: chosen */
    bool letters;                    /* (a), (b), ... if there are two panels or more */
    bool share_x, share_y;           /* one range for all panels; labels at the outer axes only */
};

/* Draw into 0..width, 0..height px of `cr`, on the look's background. Errors: SCENE (too small for that many panels), MEMORY. */
BEAD_CHECK enum bead_error bead_graph_draw(const struct bead_graph *graph, const struct bead_look *look, cairo_t *cr, double width,
                                           double height, struct bead_message *msg);
/* To a .png, .pdf or .svg with the output's size, dpi, style and theme, below the scene's title where pages have it, above the
 * output's caption; the graph's own title and caption are not used. Errors: those of draw (with the output's place), IO. */
BEAD_CHECK enum bead_error bead_graph_write(const struct bead_graph *graph, const struct bead_output *output,
                                            const struct bead_scene *scene, const char *path, uint64_t *bytes,
                                            struct bead_message *msg);

#endif
