/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the span of time that figures, bare images and plots show, and its sampling grid. */
#include "render/draw/picture_times.h"

#include <math.h>

enum bead_error bead_picture_times(const struct bead_output *output, const struct bead_run_context *context, double time[2],
                                   struct bead_message *msg)
{
    double end = context->end;
    time[0] = isnan(output->shown.time[0]) ? 0 : output->shown.time[0];
    time[1] = isnan(output->shown.time[1]) ? end : fmin(output->shown.time[1], end);
    if (!(time[1] > time[0]) || !isfinite(time[1]))
        return bead_output_wrong(output, msg, "time: from %g to %g there is nothing to show; the run ends at %g", time[0], time[1],
                                 end);
    return BEAD_OK;
}

struct bead_grid bead_picture_grid(const struct bead_run_context *context, const struct bead_shown *shown, const double time[2],
                                   double pixels)
{
    const struct bead_grid *native = &context->native;
    if (native->every > 0) { /* from the sample before the beginning to the one after the end */
        double first = fmax(0, floor((time[0] - native->start) / native->every + 1e-6));
        double last = ceil((time[1] - native->start) / native->every - 1e-6);
        return (struct bead_grid){.start = native->start + first * native->every,
                                  .every = native->every,
                                  .end = fmin(native->end, native->start + last * native->every)};
    }
    double pixel = (time[1] - time[0]) / pixels, resolution = context->resolution;
    double parts = resolution > 0 && isfinite(resolution) ? ceil(pixel / resolution) : 2;
    double every = shown->every > 0 ? shown->every : pixel / fmax(2, parts);
    return (struct bead_grid){.start = time[0], .every = every > 0 ? every : 1, .end = time[1]};
}
