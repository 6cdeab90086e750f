/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas: samples averaged exactly over the pixels of a space-time image, as they arrive.
 *
 * * Between samples, values are linear in time; across the chain, bead j is a cell from j - 1/2 to j + 1/2. Every pixel is the
 * mean of this function over the pixel's rectangle, so a pulse shorter than a pixel keeps its integral; or, with
 * BEAD_SAMPLING_MAX, the value furthest from 0 within the pixel, so the pulse keeps its height. Only one number per pixel is
 * stored, never the samples. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/sample.h"
#include "beadreel/scene.h"
#include "render/colour/colour_table.h"

struct bead_area;
struct bead_shown_values; /* colour_range.h */

struct bead_area_setup {
    struct bead_span beads; /* or contacts */
    double time[2];         /* s */
    int places, columns;    /* pixels along the chain, along time */
    enum bead_sampling sampling;
};

/* Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_area_create(const struct bead_area_setup *setup, struct bead_area **area, struct bead_message *msg);
/* Call it before the first sample: cells of different widths, all at least a pixel, between `borders`, [beads + 1] in any unit. */
void bead_area_divide(struct bead_area *area, const double *borders);
void bead_area_destroy(struct bead_area *area);
/* Values of all beads at `time`, which must rise from call to call. Beads >= active still have the values of the first sample; the
 * cost grows with the active beads only. */
void bead_area_feed(struct bead_area *area, double time, const double *values, size_t active);
/* Means (or values furthest from 0) of the pixels of time column `c`, from the chain's first to its last, [places]. False: no
 * sample has touched the column. */
bool bead_area_column(const struct bead_area *area, int c, double *means);
/* As above without repetition: the distinct values of a column, [levels], and for each pixel the index of its value. NULL: every
 * pixel has its own. */
size_t bead_area_levels(const struct bead_area *area);
const unsigned *bead_area_level(const struct bead_area *area);
bool bead_area_column_levels(const struct bead_area *area, int c, double *values);
size_t bead_area_places(const struct bead_area *area);
/* Smallest and largest value of all pixels touched; low > high if no pixel is. */
void bead_area_extremes(const struct bead_area *area, double *low, double *high);
/* The distance from a value at rest that only a short and narrow event exceeds, such as the strike: at most 5 % of the time
 * columns, and 10 % of the chain, have larger ones; INFINITY: unknown. `largest`: that of any pixel. Unless the value at rest is 0,
 * rows that never have it are left out, as beads at the ends of a pressed chain, which have a contact on one side only. */
double bead_area_typical(const struct bead_area *area, double rest, double *largest);
/* Widens ranges by the values of an area; about `all->rest` if that is not 0. */
void bead_area_widen(const struct bead_area *area, struct bead_shown_values *all);
/* The value below which this part of all lies; sorts them. INFINITY if there is none. */
double bead_area_quantile(double *values, size_t count, double part);

/* Turns areas into images of palette indices. */

/* Places of pixels: pixel p of column c goes to origin[c * column_step + p * place_step]. One of the two steps is 1. */
struct bead_area_image {
    uint8_t *origin;
    ptrdiff_t column_step, place_step;
};

/* Columns from..to - 1, up to the first that no sample has touched, which `done` returns. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_area_colour(const struct bead_area *area, const struct bead_colour_table *table, int from, int to,
                                            const struct bead_area_image *image, int *done, struct bead_message *msg);
