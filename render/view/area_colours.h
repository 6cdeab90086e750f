/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns areas into images of palette indices. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "render/colour/colour_table.h"
#include "render/view/area.h"

/* Places of pixels: pixel p of column c goes to origin[c * column_step + p * place_step]. One of the two steps is 1. */
struct bead_area_image {
    uint8_t *origin;
    ptrdiff_t column_step, place_step;
};

/* Columns from..to - 1, up to the first that no sample has touched, which `done` returns. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_area_colour(const struct bead_area *area, const struct bead_colour_table *table, int from, int to,
                                            const struct bead_area_image *image, int *done, struct bead_message *msg);
