/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inner loops of areas, element by element; compiled with -O3, which vectorises them. */
#include "render/view/area_kernels.h"

void bead_area_subtract(size_t n, const double *restrict values, const double *restrict rest, double *restrict out)
{
    for (size_t i = 0; i < n; i++)
        out[i] = values[i] - rest[i];
}

void bead_area_add(size_t n, double early, double late, const double *restrict before, const double *restrict now,
                   double *restrict sums)
{
    for (size_t i = 0; i < n; i++)
        sums[i] += early * before[i] + late * now[i];
}

void bead_area_add_largest(size_t n, double begin, double end, const double *restrict before, const double *restrict now,
                           double *restrict largest)
{
    for (size_t i = 0; i < n; i++) {
        double change = now[i] - before[i], last = end < 1 ? before[i] + end * change : now[i];
        largest[i] = bead_further(largest[i], bead_further(before[i] + begin * change, last));
    }
}

void bead_area_means(size_t n, double covered, const double *restrict resting, const double *sums, double *means)
{
    for (size_t i = 0; i < n; i++)
        means[i] = resting[i] + sums[i] / covered;
}

void bead_area_largest(size_t n, const double *restrict resting, const double *largest, double *out)
{
    for (size_t i = 0; i < n; i++)
        out[i] = isnan(largest[i]) ? resting[i] : largest[i];
}

void bead_area_spread(size_t n, const double *restrict values, double *restrict low, double *restrict high)
{
    for (size_t i = 0; i < n; i++) {
        low[i] = values[i] < low[i] ? values[i] : low[i];
        high[i] = values[i] > high[i] ? values[i] : high[i];
    }
}

void bead_area_borders(size_t n, const double *restrict beyond, const double *restrict cells, double *restrict means)
{
    for (size_t i = 0; i < n; i++)
        means[i] = cells[i] + beyond[i] * (cells[i + 1] - cells[i]);
}

void bead_area_borders_largest(size_t n, const double *restrict cells, double *restrict largest)
{
    for (size_t i = 0; i < n; i++)
        largest[i] = bead_further(cells[i], cells[i + 1]);
}
