/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finishing SVG files: their title, and names. cairo numbers surfaces through the life of a program, so the same picture would get
 * different bytes. */
#ifndef BEADREEL_RENDER_DRAW_SVG_IDS_H
#define BEADREEL_RENDER_DRAW_SVG_IDS_H

#include <stddef.h>
#include <stdio.h>

#include "beadreel/error.h"

/* An SVG file in parts. */
struct bead_svg_parts {
    char *text; /* the drawing, a whole file */
    size_t length;
    char *words; /* elements that come last, above everything else */
    size_t words_length;
    const char *title, *description; /* "" or NULL: none */
};

/* Writes the drawing to `file`, with its title, description and words, and with "surface604", "image607" and "source-610" counted
 * from 1 in the order they come. Write errors show when the file is closed. Errors: UNSUPPORTED (more names than a figure has). */
BEAD_CHECK enum bead_error bead_svg_write(const struct bead_svg_parts *svg, FILE *file, struct bead_message *msg);

#endif
