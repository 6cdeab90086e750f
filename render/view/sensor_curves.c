/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps curves over time in bounded memory: four points per stretch of time. Used by the sensors view and plots of sensors. */
#include "render/view/sensor_curves.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

/* Number of stretches of time: more than any picture has pixels. */
static const double slots = 4096;

void bead_curves_init(struct bead_curves *curves, size_t count, const double time[2])
{
    *curves =
        (struct bead_curves){.curves = count, .time = {time[0], time[1]}, .last_slot = -1, .low = INFINITY, .high = -INFINITY};
}

void bead_curves_free(struct bead_curves *curves)
{
    free(curves->stretch);
    curves->stretch = NULL;
}

enum bead_error bead_curves_reserve(struct bead_curves *curves, struct bead_message *msg)
{
    size_t row = curves->curves * sizeof *curves->stretch;
    if (!bead_memory_grow((void **)&curves->stretch, &curves->room, curves->count + 1, row))
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for curves of %zu sensors", curves->curves);
    return BEAD_OK;
}

void bead_curves_add(struct bead_curves *curves, double time, const double *values)
{
    long slot = (long)floor((time - curves->time[0]) / (curves->time[1] - curves->time[0]) * slots);
    bool same = curves->count > 0 && slot == curves->last_slot;
    if (!same)
        curves->count++;
    curves->last_slot = slot;
    struct bead_stretch *stretch = curves->stretch + (curves->count - 1) * curves->curves;
    for (size_t k = 0; k < curves->curves; k++, stretch++) {
        struct bead_point point = {time, values[k]};
        if (!same)
            *stretch = (struct bead_stretch){point, point, point, point};
        stretch->last = point;
        if (point.value < stretch->low.value)
            stretch->low = point;
        if (point.value > stretch->high.value)
            stretch->high = point;
        curves->low = fmin(curves->low, point.value);
        curves->high = fmax(curves->high, point.value);
    }
}

size_t bead_curves_points(const struct bead_curves *curves, size_t s, size_t k, struct bead_point points[4])
{
    const struct bead_stretch *stretch = curves->stretch + s * curves->curves + k;
    bool rising = stretch->low.time <= stretch->high.time;
    const struct bead_point all[4] = {stretch->first, rising ? stretch->low : stretch->high, rising ? stretch->high : stretch->low,
                                      stretch->last};
    size_t count = 0;
    for (size_t i = 0; i < 4; i++) {
        if (count == 0 || all[i].time > points[count - 1].time)
            points[count++] = all[i];
    }
    return count;
}
