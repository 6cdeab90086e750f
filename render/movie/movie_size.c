/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the size of a movie's frames in pixels, also where the scene gives lengths. */
#include "render/movie/movie_size.h"

#include <math.h>

static const double inch = 0.0254, most_pixels = 16384;

enum bead_error bead_movie_size(const struct bead_output *output, const struct bead_scene *scene, int *width, int *height,
                                struct bead_message *msg)
{
    const struct bead_paper *asked = &output->paper;
    double scale = asked->size_is_length ? asked->dpi / inch : 1, size[2] = {1920, 1080};
    for (int i = 0; i < 2; i++) {
        size[i] = asked->size[i] > 0 ? round(asked->size[i] * scale) : size[i];
        if (asked->size_is_length) /* codecs want even numbers */
            size[i] = 2 * round(size[i] / 2);
        if (!(size[i] >= 1 && size[i] <= most_pixels))
            return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: size: movies have 1 to %.0f pixels a side", scene->file,
                             output->place.line, output->place.column, most_pixels);
    }
    *width = (int)size[0];
    *height = (int)size[1];
    return BEAD_OK;
}
