/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colours of many values at once: the thresholds between colours, found once, and a search without branches. Used by areas. */
#include "render/colour/colour_table.h"

#include <math.h>

/* Maps numbers to integers in the same order; negative numbers count down from -1. */
static double number(int64_t rank)
{
    uint64_t bits = rank < 0 ? ~(uint64_t)rank | (uint64_t)1 << 63 : (uint64_t)rank;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int64_t rank_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 63 ? (int64_t) ~(bits & ~((uint64_t)1 << 63)) : (int64_t)bits;
}

/* The smallest number above `below` whose colour is `index` or later; NAN: none. */
static double least_of(const struct bead_colours *colours, int index, double below)
{
    int64_t low = rank_of(below), high = rank_of(INFINITY);
    if (bead_colours_index(colours, INFINITY) < index)
        return NAN;
    while (low + 1 < high) {
        int64_t middle = (low & high) + ((low ^ high) >> 1); /* their mean, without overflow */
        if (bead_colours_index(colours, number(middle)) >= index)
            high = middle;
        else
            low = middle;
    }
    return number(high);
}

void bead_colour_table_make(const struct bead_colours *colours, struct bead_colour_table *table)
{
    table->colours = *colours;
    table->least[0] = -INFINITY;
    if (colours->scale == BEAD_SCALE_LINEAR)
        return;
    for (int i = 1; i < 256; i++) {
        double before = table->least[i - 1];
        bool skipped = i > 1 && bead_colours_index(colours, before) >= i; /* no value has this colour */
        table->least[i] = skipped ? before : least_of(colours, i, before);
    }
}

/* Equal to bead_colours_index, without branches. */
static void find_linear(const struct bead_colours *colours, size_t n, const double *restrict values, uint8_t *restrict indices)
{
    const double low = colours->low, span = colours->high - colours->low;
    for (size_t i = 0; i < n; i++) {
        double place = (values[i] - low) / span * 256;
        place = place > 0 ? place : 0; /* NaN: 0 */
        place = place < 255 ? place : 255;
        indices[i] = (uint8_t)(int)place;
    }
}

static uint8_t search(const double *least, double value)
{
    unsigned at = 0;
    for (unsigned step = 128; step > 0; step /= 2)
        at += value >= least[at + step] ? step : 0;
    return (uint8_t)at;
}

void bead_colour_table_find(const struct bead_colour_table *table, size_t n, const double *values, uint8_t *indices)
{
    if (table->colours.scale == BEAD_SCALE_LINEAR) {
        find_linear(&table->colours, n, values, indices);
        return;
    }
    for (size_t i = 0; i < n; i++)
        indices[i] = i > 0 && values[i] == values[i - 1] ? indices[i - 1] : search(table->least, values[i]);
}
