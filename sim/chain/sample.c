/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of fields, and grids of sample times. */
#include "beadreel/sample.h"

#include <math.h>
#include <stdint.h>

static const struct bead_field_info fields[BEAD_FIELD_COUNT] = {
#define PLACE_BEAD                                   0
#define PLACE_CONTACT                                1
#define BEAD_FIELD_ROW(id, name, unit, title, place) {name, unit, title, PLACE_##place},
    BEAD_FIELDS(BEAD_FIELD_ROW)
#undef BEAD_FIELD_ROW
};

const struct bead_field_info *bead_field_info(enum bead_field field)
{
    return &fields[field];
}

/* A grid point counts if it is at most this fraction of a spacing after the end: grids are given in decimal units, whose quotients
 * are not exact. */
static const double slack = 1e-6;

/* Samples of a grid that widens, while their distance from its start doubles. */
enum { DOUBLING = 32 };

/* The distance of that sample from the start, in spacings. */
static double widened(size_t index)
{
    const size_t doubled = index / DOUBLING;
    return doubled < 2 ? (double)index : ldexp((double)(DOUBLING + index % DOUBLING), doubled < 2000 ? (int)doubled - 1 : 2000);
}

size_t bead_grid_count(const struct bead_grid *grid)
{
    if (grid->times || !(grid->every > 0) || !(grid->end >= grid->start))
        return grid->times ? grid->count : 0;
    const double length = (grid->end - grid->start) / grid->every, last = floor(length + slack);
    if (grid->widens && isfinite(length)) {
        size_t before = 0;
        while (widened(before) < length - slack)
            before++;
        return before + 1;
    }
    return last < 0x1p63 ? (size_t)last + 1 : SIZE_MAX;
}

double bead_grid_time(const struct bead_grid *grid, size_t index)
{
    if (grid->times)
        return grid->times[index];
    const double time = grid->start + (grid->widens ? widened(index) : (double)index) * grid->every;
    return grid->widens && !(time < grid->end - slack * grid->every) ? grid->end : time;
}
