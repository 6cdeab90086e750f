/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layout of a movie's frame: rectangles only. The clock and words above, captions at the bottom. Between them a stage
 * (movie_stage.h), or cells, one for each chain: a heading, and the chain's views below each other. Cells are below each other,
 * side by side, or both; an overlay has one profile for all chains above the cells, and with `beside` the images of a cell are to
 * the right of its other views. Cells have a colour bar on the right or, in frames that are not wide, beside the clock.
 *
 * Images have a share of the frame's area, counted in their pixels, without axes and margins. If room is short they shrink first,
 * then air, then some numbers of vertical axes; headings, axes with their names, title, facts and clock disappear only in frames
 * too small for anything else. Rectangles never overlap and never leave the frame. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"
#include "beadreel/view.h"
#include "render/draw/axis.h"
#include "render/view/orientation.h"

struct bead_facts; /* movie_words.h */

/* The parts to arrange; lengths in px. */
struct bead_movie_wants {
    int width, height;
    const struct bead_look *look;
    enum bead_layout layout;
    enum bead_orientation orientation; /* of images */
    size_t chain_count;
    const struct bead_view_type *views[BEAD_MOST_VIEWS];
    size_t view_count;
    bool axes;            /* false: only the views */
    bool headings;        /* some chain has a heading */
    double heading_width; /* of the widest with its label beside the name; in narrower cells the label goes below. 0: no labels */
    double label_width;   /* of the widest label */
    double heading_least; /* of the widest without label, at its smallest; in narrower cells M goes below */
    bool trust;           /* a line about the horizon, left out after the other words */
    int caption_lines;    /* reserved at the bottom */
    double caption_line;  /* height of a line */
    bool follow;          /* beads and profiles follow the front, with their own bead axes */
    bool sensors;         /* some bead has a sensor, whose name is shown */
    double bead_height;   /* of the largest bead in a row that moves, in a plot as wide as the frame */
    bool striker, wall;   /* some chain has it, which needs room beside its beads */
    size_t beads;         /* of the longest chain, in units of the mean distance of its beads */
    bool colourless;      /* no view shows values as colours: no bar */
    bool same_beads;      /* all chains have the same bead axis: only the lowest is labelled */
    double keyed_heading; /* of the widest such heading with the key of its stage beside it */
    double name_least;    /* of the first chain's name above its image, at its smallest */
    double key_width;     /* of one key for all stages, if these have no keys */
    double key_brief;     /* without the name of the quantity that the light shows */
    double key_part;      /* of its widest part, if it has two lines */
    double time_width;    /* of the widest time shown */
    double badge_width;   /* of the widest badge of the speed; 0: none */
    const struct bead_facts *facts;                /* NULL: one line of them is enough */
    double title_width;                            /* of the title; 0: none */
    double left, image_left;                       /* how far ticks and labels of vertical axes extend out of plots, of images */
    double below_beads, below_time, below_numbers; /* axes below plots: with their titles, without */
    double along;                                  /* the title of an axis along the first chain */
    double against;                                /* the title of both axes of an image whose time is to the right */
    double time_end;                               /* how far numbers at the ends of an axis of time extend beyond it */
    double along_end;                              /* and those at the right of an axis along the chain */
    double inset;                                  /* the least width of a drawing beside the curve; 0: none */
    double bar, bar_below, bar_title;              /* ticks and labels beside the bar, below it; the width of its title */
};

struct bead_movie_chain {
    struct bead_rect heading;               /* width 0: none, also below */
    struct bead_rect name;                  /* above its image, unless that is below the heading */
    struct bead_rect plot[BEAD_MOST_VIEWS]; /* width 0: the view has no room */
    bool labels[BEAD_MOST_VIEWS];           /* this view labels its horizontal axis */
    bool values[BEAD_MOST_VIEWS];           /* and its vertical one */
};

/* A frame may lack the images that its layout is named for; some or all numbers on vertical axes; names, titles, facts, a scale for
 * its colours. */
enum bead_lack { BEAD_LACKS_NOTHING, BEAD_LACKS_IMAGES, BEAD_LACKS_NUMBERS, BEAD_LACKS_WORDS };

struct bead_movie_layout {
    enum bead_layout layout; /* never AUTO */
    bool axes;
    bool titles;          /* of vertical axes are shown */
    enum bead_lack lacks; /* apart from curves, air and images that may be given up */
    bool against;         /* images have one title for both axes */
    bool label_lines;     /* headings have two lines */
    int head;             /* px at the top of a stage for its heading; 0: it is above the stage */
    bool curve;           /* a stage has kept its curve */
    bool grid;            /* stages are also side by side, with one key for all */
    int beyond[2];        /* px that panels extend beyond the plots along chains, left and right */
    int colours;          /* px: the colours of images along the axis of the curve; 0: a bar, or no colours */
    size_t overlay;       /* the view that shows all chains in the plot of the first; view_count: none */
    struct bead_rect time, badge, title, facts, key, trust, caption;
    struct bead_rect inset;          /* a drawing beside the curve of a stage */
    struct bead_rect bar, bar_title; /* a bar wider than high is horizontal, with its low end at the left */
    bool words_left;                 /* title and facts begin at the left; else they end at the right */
    struct bead_movie_chain *chains; /* of the layout */
    size_t chain_count;
};

/* The quantity along the horizontal axis of a view. */
static inline enum bead_view_across bead_movie_across(const struct bead_movie_wants *wants, size_t view)
{
    return bead_orientation_across(wants->orientation, wants->views[view]->info);
}
/* Errors: SCENE (frame too small for so many views), MEMORY. */
BEAD_CHECK enum bead_error bead_movie_arrange(const struct bead_movie_wants *wants, struct bead_movie_layout *layout,
                                              struct bead_message *msg);
void bead_movie_layout_free(struct bead_movie_layout *layout);
