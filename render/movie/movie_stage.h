/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stage of a movie's frame: a row of large beads for each chain, below each other, and under them one profile for all chains
 * and their images, beside the profile or below it. Used by movie_layout.c. */
#pragma once

#include "render/movie/movie_layout.h"

/* Things that a frame gives up, plan by plan, until the rest fits. Shares are parts of the frame's area. */
struct bead_stage_plan {
    double beads;  /* share of the beads with their headings */
    double images; /* least share of the images; 0: none */
    bool bar, curve;
    double air; /* gaps, in units of their usual size */
};
enum { BEAD_STAGE_PLANS = 22 };
extern const struct bead_stage_plan bead_stage_plans[BEAD_STAGE_PLANS];

/* px by which beads are inset in the area of plots with their axes. */
int bead_stage_inset(const struct bead_movie_wants *wants);
/* Stages side by side: two for four chains, except on phones, where beads are larger below each other. */
size_t bead_stage_columns(const struct bead_movie_wants *wants);
/* Is there room for the keys of beads beside the headings? Never in grids. */
bool bead_stage_keyed(const struct bead_movie_wants *wants);
/* Else one key for all stages is above them, in this many lines; 0: there is no room, or stages have keys beside the headings. */
int bead_stage_key_lines(const struct bead_movie_wants *wants);
/* Is one line enough only without the name of the quantity that the light shows? */
bool bead_stage_key_brief(const struct bead_movie_wants *wants);
/* The view of large beads; view_count: there is none. */
size_t bead_stage_view(const struct bead_movie_wants *wants);
/* Chooses rectangles for headings, plots and bar within `area`. False: there is no room. */
BEAD_CHECK bool bead_stage_place(const struct bead_movie_wants *wants, const struct bead_stage_plan *plan, struct bead_rect area,
                                 struct bead_movie_layout *layout);
