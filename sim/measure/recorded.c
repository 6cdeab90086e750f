/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Recorded curves: see recorded.h. */
#include "sim/measure/recorded.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

enum { AROUND = 4 };

enum bead_error bead_recorded_add(struct bead_recorded *r, double time, const double *values, struct bead_message *msg)
{
    const size_t used = r->count * r->curves;
    if (!bead_memory_grow((void **)&r->times, &r->room[0], r->count + 1, sizeof *r->times) ||
        !bead_memory_grow((void **)&r->values, &r->room[1], used + r->curves, sizeof *r->values))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for curves");
    r->times[r->count++] = time;
    memcpy(r->values + used, values, r->curves * sizeof *values);
    return BEAD_OK;
}

double bead_recorded_at(const struct bead_recorded *r, size_t curve, double time)
{
    const size_t points = r->count < AROUND ? r->count : AROUND;
    size_t low = 0, high = r->count;
    double sum = 0;
    if (points == 0)
        return NAN;
    time = fmax(r->times[0], fmin(time, r->times[r->count - 1]));
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(r->times[middle] <= time ? &low : &high) = middle;
    }
    size_t first = low > 0 ? low - 1 : 0;
    first = first + points > r->count ? r->count - points : first;
    for (size_t i = first; i < first + points; i++) { /* Lagrange's formula */
        double weight = 1;
        for (size_t k = first; k < first + points; k++)
            weight *= k == i ? 1 : (time - r->times[k]) / (r->times[i] - r->times[k]);
        sum += weight * r->values[i * r->curves + curve];
    }
    return sum;
}

void bead_recorded_free(struct bead_recorded *r)
{
    free(r->times);
    free(r->values);
}
