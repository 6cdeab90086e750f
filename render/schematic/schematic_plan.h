/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plans of the drawing of an experiment: the parts of each chain to show, their size, and the places of their labels. */
#pragma once

#include "render/draw/layout.h"
#include "render/schematic/schematic.h"
#include "render/schematic/schematic_strip.h"

enum { BEAD_PLAN_PARTS = 40, BEAD_PLAN_LABELS = BEAD_PLAN_PARTS + 2 };

/* A segment of the chain, or several that are left out. */
struct bead_part {
    const struct bead_segment *segment; /* NULL: left out */
    size_t first, beads;                /* beads of the chain */
    char words[2][160];                 /* under its brace: material or cell, and its orientation; "": none */
};

/* Words in a row, each with its part. */
struct bead_plan_labels {
    struct bead_label label[BEAD_PLAN_LABELS];
    char words[BEAD_PLAN_LABELS][2][160];
    size_t part[BEAD_PLAN_LABELS]; /* index of a part; SIZE_MAX: the striker above, the wall below */
    size_t count;
};

struct bead_plan_row {
    const struct bead_chain *chain;
    struct bead_part parts[BEAD_PLAN_PARTS];
    size_t part_count;
    struct bead_strip strip; /* marks are indices of parts */
    struct bead_plan_labels above, below;
    char header[1024];
    double slope, largest; /* of the guide as drawn; m, radius of the largest bead */
    /* px */
    double y, height;            /* of the whole row */
    double first_x, guide_y;     /* left end of bead 1; top of the guide there */
    double end_x, striker_r;     /* right end of the last bead */
    double striker_x, striker_y; /* centre */
    double foot_y;               /* of the ramp, so that the striker arrives on the beads' axis */
    bool level;                  /* no ramp: the striker does not move, and lies beside the other beads */
};

/* Lengths that rows are made of, px. */
struct bead_plan {
    const struct bead_drafting *d;
    struct bead_plan_row *rows;
    size_t row_count;
    struct bead_lanes lanes; /* of these rows */
    struct bead_box area;
    double em, scale; /* scale: px a metre */
    double drop;      /* em: the most that a guide falls */
    bool details;     /* second lines of the labels below */
};

enum { BEAD_PLAN_ANGLE_PERCENT = 42 }; /* the ramp's slope */

/* Makes as many rows as fit. False: not even one does. */
BEAD_CHECK bool bead_plan_make(const struct bead_drafting *d, struct bead_box area, struct bead_plan *plan);
void bead_plan_free(struct bead_plan *plan);

double bead_plan_wall(const struct bead_plan *plan, const struct bead_plan_row *row); /* px: width of the wall; 0: none */
/* Baselines of the rows of words: of the header, above the beads, below them (first line). */
double bead_plan_header_y(const struct bead_plan *plan, const struct bead_plan_row *row);
double bead_plan_above_y(const struct bead_plan *plan, const struct bead_plan_row *row);
double bead_plan_below_y(const struct bead_plan *plan, const struct bead_plan_row *row);
/* Top of the guide at x. */
double bead_plan_guide(const struct bead_plan_row *row, double x);

/* ---- parts of a chain and their words ---- */

/* Segments of the chain, `most` of them; the segments left out between the first and last ones form one part. Returns the number of
 * parts, at most `most` + 1. */
size_t bead_parts_make(const struct bead_chain *chain, size_t most, struct bead_part *parts);
/* Beads of all parts, at most about `most` of each. False: out of memory. */
BEAD_CHECK bool bead_parts_strip(const struct bead_chain *chain, const struct bead_part *parts, size_t count, size_t most,
                                 struct bead_strip *strip);
/* Words above and below with their widths. */
void bead_parts_labels(struct bead_plan_row *row, const struct bead_text_style *style, bool details);
/* `decimals`: of M. */
void bead_parts_header(struct bead_plan_row *row, const struct bead_text_style *style, int decimals, double width);
