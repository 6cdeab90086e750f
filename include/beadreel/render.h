/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing: frames (pixels in memory, and which of them changed), colour maps, and the sinks that draw. */
#ifndef BEADREEL_RENDER_H
#define BEADREEL_RENDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/scene.h"
#include "beadreel/sink.h"

BEAD_BEGIN

/* ---- frames ---- */

/* Device pixels, y downwards. */
struct bead_rect {
    int x, y, width, height;
};

/* 32 bits a pixel, B G R X in memory (CAIRO_FORMAT_RGB24 on little-endian machines), rows from the top. With `alpha` the fourth
 * byte is the pixel's opacity, and colours are premultiplied with it (CAIRO_FORMAT_ARGB32); where light is added they may exceed
 * it. */
struct bead_frame {
    int width, height;
    size_t stride; /* bytes a row, a multiple of 64 */
    uint8_t *pixels;
    bool alpha; /* as created: false */
};

/* Rectangles changed since the previous frame; if they overlap much, or are too many, they are merged into bounding boxes. */
struct bead_changes {
    size_t count;
    struct bead_rect rect[32];
};

/* Pixels are zeroed and belong to the frame. */
BEAD_API BEAD_CHECK enum bead_error bead_frame_create(int width, int height, struct bead_frame *frame, struct bead_message *msg);
BEAD_API void bead_frame_free(struct bead_frame *frame);
/* Copy a rectangle (clipped) between frames of the same size. */
BEAD_API void bead_frame_copy(struct bead_frame *to, const struct bead_frame *from, struct bead_rect rect);
BEAD_API void bead_changes_add(struct bead_changes *changes, struct bead_rect rect);

/* ---- colour maps: from numbers to palette indices to colours ---- */

struct bead_colormap {
    char name[32];
    uint8_t rgb[256][3]; /* sRGB */
};

/* From assets/colormaps/NAME.txt, reversed for NAME_r, or from evenly spaced colours: "#000000 #ff8000 #ffffff". Errors: SCENE (no
 * such map; lists all), IO, FORMAT, MEMORY. */
BEAD_API BEAD_CHECK enum bead_error bead_colormap_load(const char *name, struct bead_colormap *map, struct bead_message *msg);

/* A scale of colours: maps values low..high to indices 0..255, others to the ends. */
struct bead_colours {
    const struct bead_colormap *map;
    enum bead_scale scale;
    double low, high;
    double rest; /* the value where nothing happens: 0, or the static force in the middle of the range */
};
/* The map's 256 colours are equal bands along the bar. */
BEAD_API uint8_t bead_colours_index(const struct bead_colours *colours, double value);

/* The drawing half's outputs: images, plots, movies. Hand this list and bead_data_sinks() to a job (session.h). NULL-terminated. */
BEAD_API const struct bead_sink_type *const *bead_render_sinks(void);

BEAD_END

#endif
