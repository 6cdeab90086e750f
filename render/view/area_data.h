/* An area's insides, shared by area.c (filling) and area_columns.c (reading). */
#ifndef BEADREEL_RENDER_VIEW_AREA_DATA_H
#define BEADREEL_RENDER_VIEW_AREA_DATA_H

#include "render/view/area.h"

/* How a bead lies in rows, where these are fewer. Of means: its share of its row and of the next; of values furthest from 0: the
 * first and the last row that it reaches into. */
struct share {
    double own, next;
    size_t row, last;
};

/* Rows of sums are beads where the picture has a pixel or more for each, else pixels. */
struct bead_area {
    struct bead_area_setup setup;
    size_t beads, rows;
    double *sums;    /* [along][rows], integral over time of value - rest, averaged over the row; or the value furthest from 0 in
                        row and column, NaN where all was at rest; in columns done what their pixels show */
    double *covered; /* s, [along]; a column's sums have no values where it is 0 */
    double *rest;    /* [beads], values of beads that had not moved at the first sample */
    double *resting; /* [rows], the same in rows */
    double *before, *now; /* [rows], value - rest (or value) of the last sample and of this */
    double *low, *high;   /* [rows], of columns done */
    double *shown;        /* [rows], a column on its way out */
    struct share *shares; /* [beads], with fewer rows */
    unsigned *level;      /* [across], with fewer rows; else NULL */
    double *beyond;       /* [rows], part of the pixel across a row's upper border that lies beyond it */
    double *levels;       /* [levels], a column's on their way to pixels */
    size_t lit_before;    /* rows of `before` that may differ from rest */
    double time_before;
    int done; /* columns before this one are over */
    bool started;
};

static inline bool keeps_largest(const struct bead_area *a)
{
    return a->setup.sampling == BEAD_SAMPLING_MAX;
}

static inline double *column(const struct bead_area *a, int c)
{
    return a->sums + (size_t)c * a->rows;
}

/* What column c, which samples have touched, shows: in rows. */
void bead_area_show(const struct bead_area *area, int c, double *rows);

#endif
