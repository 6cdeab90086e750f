/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of outputs and views, one row each. */
#ifndef BEADREEL_KINDS_H
#define BEADREEL_KINDS_H

#include "beadreel/api.h"

BEAD_BEGIN

/* Outputs, in the order of --list keys. If several kinds share a file's ending, `-o FILE` makes the first.
 *
 * To add a kind NAME: its row here; a file sim/kinds/output_NAME.c with its keys and a `const struct bead_output_type
 * bead_NAME_output`, which has all that is special about the kind; and a sink that makes it, with its line in the list of sinks. */
#define BEAD_OUTPUTS(OUTPUT)       \
    OUTPUT(TRAJECTORY, trajectory) \
    OUTPUT(IMAGE, image)           \
    OUTPUT(MOVIE, movie)           \
    OUTPUT(PLOT, plot)             \
    OUTPUT(TABLE, table)           \
    OUTPUT(SWEEP, sweep)           \
    OUTPUT(SHEET, sheet)           \
    OUTPUT(REPORT, report)

enum bead_output_kind {
#define BEAD_OUTPUT_ENUM(ID, name) BEAD_OUTPUT_##ID,
    BEAD_OUTPUTS(BEAD_OUTPUT_ENUM)
#undef BEAD_OUTPUT_ENUM
        BEAD_OUTPUT_KINDS,
    BEAD_OUTPUT_OWN = BEAD_OUTPUT_KINDS /* made by a sink of the program's own: bead_own in scene.h */
};

/* ---- views: what scenes, layouts and captions must know about each; view.h has the functions that draw ----
 *
 * To add a view: its row here, and its file render/view/view_NAME.c with a `const struct bead_view_type bead_view_NAME_type`. */

/* Bits of bead_view_info.traits. */
enum bead_view_trait {
    BEAD_SHOWS_ALL_TIMES = 1,   /* collects all samples; a view without it shows one moment */
    BEAD_SHOWS_BEADS = 2,       /* draws the beads: needs a chain that has some, magnifies displacements, numbers its own row */
    BEAD_SHOWS_SENSORS = 4,     /* needs beads with a sensor, and reads only those */
    BEAD_SHOWS_MODES = 8,       /* needs an equation with linear modes; in movies only */
    BEAD_SHOWS_IMAGE = 16,      /* a pixel for every stretch of chain and time; alone and without axes: bare pixels */
    BEAD_SHOWS_COLOURS = 32,    /* values as colours: the picture has a colour bar */
    BEAD_FOLLOWS_FRONT = 64,    /* shows a window that moves, where a movie follows the front */
    BEAD_DRAWS_ON_CANVAS = 128, /* paints beads: needs a canvas */
    BEAD_OVERLAYS = 256,        /* can show several chains on one axis */
    BEAD_ACTS = 512,            /* large beads: a film is arranged around them */
};

/* The quantity on the horizontal axis; time for an image, unless its time runs down. */
enum bead_view_across { BEAD_ACROSS_CHAIN, BEAD_ACROSS_TIME, BEAD_ACROSS_MODES };

/* Shares are of the height that all views of a picture have; `most` is the largest useful height in widths of the plot. `shape`:
 * width / height that suits the view alone in a still. */
#define BEAD_VIEWS(VIEW)                                                                                                       \
    VIEW(BEADS, beads, .help = "the beads, coloured by the field; a lens follows the front",                                   \
         .traits = BEAD_SHOWS_BEADS | BEAD_SHOWS_COLOURS | BEAD_FOLLOWS_FRONT | BEAD_DRAWS_ON_CANVAS, .still_share = 0.34,     \
         .shape = 8, .movie_share = 1, .movie_most = 0.135)                                                                    \
    VIEW(STAGE, stage, .help = "large beads in their materials' colours, lit at each contact by its force; a camera follows",  \
         .traits = BEAD_ACTS | BEAD_SHOWS_BEADS | BEAD_FOLLOWS_FRONT | BEAD_DRAWS_ON_CANVAS, .still_share = 0.4, .shape = 5.5, \
         .movie_share = 2.2, .movie_most = 0.16)                                                                               \
    VIEW(PROFILE, profile, .help = "the field along the chain at one time", .traits = BEAD_FOLLOWS_FRONT | BEAD_OVERLAYS,      \
         .still_share = 0.22, .shape = 1.35, .movie_share = 1.6, .movie_most = 0.5)                                            \
    VIEW(SPACETIME, spacetime, .help = "the field over chain and time, area-averaged; fills as time passes in movies",         \
         .traits = BEAD_SHOWS_ALL_TIMES | BEAD_SHOWS_IMAGE | BEAD_SHOWS_COLOURS, .still_share = 0.5, .shape = 1.35,            \
         .movie_share = 2, .movie_most = 2)                                                                                    \
    VIEW(SENSORS, sensors, .help = "force against time of every sensor", .traits = BEAD_SHOWS_ALL_TIMES | BEAD_SHOWS_SENSORS,  \
         .across = BEAD_ACROSS_TIME, .still_share = 0.3, .shape = 1.35, .movie_share = 1.2, .movie_most = 0.5)                 \
    VIEW(MODES, modes, .help = "energies of an equation's linear modes, as fractions of the total at the start",               \
         .traits = BEAD_SHOWS_MODES, .across = BEAD_ACROSS_MODES, .still_share = 0.3, .shape = 1.35, .movie_share = 1,         \
         .movie_most = 0.3)

enum bead_view_kind {
#define BEAD_VIEW_ENUM(ID, ...) BEAD_VIEW_##ID,
    BEAD_VIEWS(BEAD_VIEW_ENUM)
#undef BEAD_VIEW_ENUM
        BEAD_VIEW_KINDS
};

struct bead_view_info {
    const char *name, *help;
    unsigned traits;
    enum bead_view_across across;
    double still_share, shape;
    double movie_share, movie_most;
};

BEAD_END

#endif
