/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Diagrams of benches, drawn with this program's own axes and text. */
#ifndef BEADREEL_BENCH_DIAGRAM_H
#define BEADREEL_BENCH_DIAGRAM_H

#include "render/draw/axis.h"
#include "render/draw/raster.h"
#include "tests/bench/precision.h"

/* NAME.png and NAME.pdf of width x height pixels at notes->dpi. */
static inline void diagram_write(const char *name, int width, int height, bead_draw draw, void *context,
                                 const struct bead_picture_notes *notes)
{
    char path[520];
    uint64_t bytes;
    struct bead_frame frame;
    struct bead_message msg = {""};
    snprintf(path, sizeof path, "%s.png", name);
    enum bead_error err = bead_frame_create(width, height, &frame, &msg);
    if (!err)
        err = bead_raster_draw(&frame, draw, context, &msg);
    if (!err)
        err = bead_png_write(path, &frame, notes, &bytes, &msg);
    bead_frame_free(&frame);
    snprintf(path, sizeof path, "%s.pdf", name);
    if (!err)
        err = bead_vector_write(path, width, height, draw, context, notes, &bytes, &msg);
    if (err)
        GIVE_UP("%s", msg.text);
}

#endif
