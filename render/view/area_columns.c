#include "render/view/area_data.h"

#include <math.h>
#include <string.h>

#include "render/view/area_kernels.h"

void bead_area_show(const struct bead_area *area, int c, double *rows)
{
    const struct bead_area *a = area;
    if (keeps_largest(a))
        bead_area_largest(a->rows, a->resting, column(a, c), rows);
    else
        bead_area_means(a->rows, a->covered[c], a->resting, column(a, c), rows);
}

/* Rows of a column: where it lies, or in the room for one. */
static const double *rows_of(const struct bead_area *a, int c)
{
    if (c < a->done)
        return column(a, c);
    bead_area_show(a, c, a->shown);
    return a->shown;
}

size_t bead_area_levels(const struct bead_area *area)
{
    return area->rows < (size_t)area->setup.across ? 2 * area->rows - 1 : area->rows;
}

const unsigned *bead_area_level(const struct bead_area *area)
{
    return area->level;
}

bool bead_area_column_levels(const struct bead_area *area, int c, double *values)
{
    const struct bead_area *a = area;
    if (!(a->covered[c] > 0))
        return false;
    const double *rows = rows_of(a, c);
    memcpy(values, rows, a->rows * sizeof *values);
    if (a->level && keeps_largest(a))
        bead_area_borders_largest(a->rows - 1, rows, values + a->rows);
    else if (a->level)
        bead_area_borders(a->rows - 1, a->beyond, rows, values + a->rows);
    return true;
}

bool bead_area_column(const struct bead_area *area, int c, double *means)
{
    const struct bead_area *a = area;
    if (!a->level)
        return bead_area_column_levels(a, c, means);
    bool touched = bead_area_column_levels(a, c, a->levels);
    for (size_t p = 0; touched && p < (size_t)a->setup.across; p++)
        means[p] = a->levels[a->level[p]];
    return touched;
}

static void extend(size_t n, const double *lows, const double *highs, double *low, double *high)
{
    for (size_t i = 0; i < n; i++) {
        *low = lows[i] < *low ? lows[i] : *low;
        *high = highs[i] > *high ? highs[i] : *high;
    }
}

void bead_area_extremes(const struct bead_area *area, double *low, double *high)
{
    const struct bead_area *a = area;
    *low = INFINITY;
    *high = -INFINITY;
    extend(a->rows, a->low, a->high, low, high);
    for (int c = a->done; c < a->setup.along; c++) {
        const double *rows = a->covered[c] > 0 ? rows_of(a, c) : NULL;
        if (rows)
            extend(a->rows, rows, rows, low, high);
    }
}

size_t bead_area_across(const struct bead_area *area)
{
    return (size_t)area->setup.across;
}
