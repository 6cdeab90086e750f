/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours of many values at once, with the indices of bead_colours_index. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "beadreel/render.h"

struct bead_colour_table {
    struct bead_colours colours;
    double least[256]; /* smallest value of colour i; NaN: none. Not used for linear scales */
};

/* Evaluates the scale's function a few thousand times, once. `colours->map` is borrowed. */
void bead_colour_table_make(const struct bead_colours *colours, struct bead_colour_table *table);
void bead_colour_table_find(const struct bead_colour_table *table, size_t n, const double *values, uint8_t *indices);

/* 0..1 of `value` between low and high, not clamped; what axes and colours share. */
double bead_scale_place(enum bead_scale scale, double low, double high, double value);
/* 0..1 along the colour bar, not clamped: below 0 or above 1 for values out of range. A square-root scale takes the root of both
 * signs; values that have no logarithm are at -infinity. */
double bead_colours_place(const struct bead_colours *colours, double value);

/* NULL-terminated names with a line about each. */
struct bead_colormap_info {
    const char *name, *description;
};
const struct bead_colormap_info *bead_colormap_list(void);
