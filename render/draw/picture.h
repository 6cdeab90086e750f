/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures: a finished frame into a PNG file, or a drawing into PDF and SVG. */
#pragma once

#include <cairo.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/view.h"
#include "sim/base/internal.h"
#include "sim/base/settings.h"

struct bead_picture_notes {
    size_t size;                                         /* of this structure: BEAD_DEFAULT */
    double dpi;                                          /* for pHYs; 0: none */
    const char *title, *description, *software, *source; /* text chunks or document information; may be NULL */
    const char *author;                                  /* of documents; may be NULL */
    bool outlines;                                       /* letters of SVG are outlines, not text */
};

/* FNV-1a over the visible bytes (B, G, R of every pixel, and alpha). */
uint64_t bead_frame_hash(const struct bead_frame *frame);

/* PNG, with a palette if the frame has at most 256 colours (then exact and small), else RGB. Writes path.part and renames. Errors:
 * IO, MEMORY. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_png_write(const char *path, const struct bead_frame *frame,
                                                        const struct bead_picture_notes *notes, uint64_t *bytes,
                                                        struct bead_message *msg);
/* PNG from indices and palette as they are. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_png_write_indexed(const char *path, int width, int height, const uint8_t *indices,
                                                                const uint8_t palette[256][3],
                                                                const struct bead_picture_notes *notes, uint64_t *bytes,
                                                                struct bead_message *msg);

typedef enum bead_error (*bead_draw)(void *context, cairo_t *cr, struct bead_message *msg);
/* PDF or SVG (by the extension) of width x height pixels at notes->dpi; `draw` gets a context whose unit is that pixel. */
BEAD_INTERNAL BEAD_CHECK enum bead_error bead_vector_write(const char *path, int width, int height, bead_draw draw, void *context,
                                                           const struct bead_picture_notes *notes, uint64_t *bytes,
                                                           struct bead_message *msg);

/* The notes of a picture as given by its caller; NULL: none. */

BEAD_CHECK static inline enum bead_error bead_notes_take(struct bead_picture_notes *own, const struct bead_picture_notes *given,
                                                         struct bead_message *msg)
{
    *own = (struct bead_picture_notes){0};
    return !given ? BEAD_OK
                  : bead_settings_take(own, sizeof *own, BEAD_SETTINGS_UP_TO(struct bead_picture_notes, dpi), given,
                                       "bead_picture_notes", msg);
}
