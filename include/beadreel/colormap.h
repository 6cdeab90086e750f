/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Colour maps: from numbers to palette indices to colours. */
#ifndef BEADREEL_COLORMAP_H
#define BEADREEL_COLORMAP_H

#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"

BEAD_BEGIN

struct bead_colormap {
    char name[32];
    uint8_t rgb[256][3]; /* sRGB */
};

/* NULL-terminated names with a line about each. */
struct bead_colormap_info {
    const char *name, *description;
};
BEAD_API const struct bead_colormap_info *bead_colormap_list(void);
/* From assets/colormaps/NAME.txt, reversed for NAME_r, or of colours: "#000000 #ff8000 #ffffff", equally far apart. Errors: SCENE (no such map; says
 * which there are), IO, FORMAT, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_colormap_load(const char *name, struct bead_colormap *map, struct bead_message *msg);

/* A scale of colours: values low..high to indices 0..255 of a map; outside, clamped. */
struct bead_colours {
    const struct bead_colormap *map;
    enum bead_scale scale;
    double low, high;
};
/* 0..1 along the colour bar, not clamped: below 0 or above 1 where the value is out of range. A square-root scale takes the
 * root of both signs; values that a logarithm has not are -infinity. */
BEAD_API double bead_colours_place(const struct bead_colours *colours, double value);
/* The map's 256 colours are equal bands along the bar. */
BEAD_API uint8_t bead_colours_index(const struct bead_colours *colours, double value);
/* 0..1 of `value` between low and high, not clamped; what axes and colours share. */
BEAD_API double bead_scale_place(enum bead_scale scale, double low, double high, double value);

BEAD_END

#endif
