/* Layout of a movie's frame: rectangles only. A heading and the views, stacked, for each chain; time and words above, a colour bar
 * at the right, captions at the bottom. Plots of all views have the same left and right edge. What does not fit is left out: words
 * first, then headings, axes, and last the time. Rectangles never overlap and never leave the frame. */
#ifndef BEADREEL_RENDER_MOVIE_MOVIE_LAYOUT_H
#define BEADREEL_RENDER_MOVIE_MOVIE_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>

#include "beadreel/error.h"
#include "beadreel/frame.h"
#include "beadreel/look.h"
#include "beadreel/view.h"
#include "render/view/stack.h"

/* What is to be arranged; lengths in px. */
struct bead_movie_wants {
    int width, height;
    const struct bead_look *look;
    size_t chain_count;
    const struct bead_view_type *views[BEAD_STACK_VIEWS];
    size_t view_count;
    bool axes; /* false: nothing but the views */
    bool title, headings;
    bool trust;                                              /* a line about the horizon, left out after the other words */
    int caption_lines;                                       /* reserved at the bottom */
    double caption_line;                                     /* height of one */
    bool follow;                                             /* beads and profiles follow the front, with bead axes of their own */
    bool sensors;                                            /* some bead has a sensor, whose name is shown */
    double bead_height;                                      /* of the largest bead in a row that moves */
    bool colourless;                                         /* no view shows values as colours: no bar */
    bool same_beads;                                         /* all chains have the same bead axis: only the lowest is labelled */
    double time_width;                                       /* of the widest time that is shown */
    double left, below_beads, below_moving, below_time, bar; /* how far the axes reach out of plots, and the bar's out of the bar */
};

struct bead_movie_chain {
    struct bead_rect heading; /* width 0: none, also below */
    struct bead_rect plot[BEAD_STACK_VIEWS];
    bool labels[BEAD_STACK_VIEWS]; /* this view labels the bead axis (sensors: the time axis) */
};

struct bead_movie_layout {
    bool axes, ticks_only; /* vertical axes without labels */
    struct bead_rect time, title, facts, trust, bar, caption;
    struct bead_movie_chain *chains; /* of the layout */
    size_t chain_count;
};

/* Errors: SCENE (frame too small for so many views), MEMORY. */
BEAD_CHECK enum bead_error bead_movie_arrange(const struct bead_movie_wants *wants, struct bead_movie_layout *layout,
                                              struct bead_message *msg);
void bead_movie_layout_free(struct bead_movie_layout *layout);

#endif
