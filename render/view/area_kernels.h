/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inner loops of areas and colours: element by element, so that any vector width gives the same bits. Arrays do not overlap. */
#pragma once

#include <math.h>
#include <stddef.h>

/* The value further from 0; b if a is NaN. */
static inline double bead_further(double a, double b)
{
    return fabs(b) <= fabs(a) ? a : b;
}

/* out = values - rest. */
void bead_area_subtract(size_t n, const double *values, const double *rest, double *out);
/* sums += early * before + late * now. */
void bead_area_add(size_t n, double early, double late, const double *before, const double *now, double *sums);
/* The value furthest from 0 between the parts `begin` and `end` of the way from `before` to `now`, which is at one of these. */
void bead_area_add_largest(size_t n, double begin, double end, const double *before, const double *now, double *largest);
/* means = resting + sums / covered. `means` may be `sums`. */
void bead_area_means(size_t n, double covered, const double *resting, const double *sums, double *means);
/* The largest, or `resting` if it is NaN. `out` may be `largest`. */
void bead_area_largest(size_t n, const double *resting, const double *largest, double *out);
/* Lowers `low` and raises `high` to include the values. */
void bead_area_spread(size_t n, const double *values, double *low, double *high);
/* Means of n pixels that lie across the borders of n + 1 cells, each with its part `beyond` in the next cell. */
void bead_area_borders(size_t n, const double *beyond, const double *cells, double *means);
void bead_area_borders_largest(size_t n, const double *cells, double *largest);
