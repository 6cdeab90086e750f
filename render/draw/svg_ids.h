/* Names in SVG files: cairo numbers surfaces through the life of a program, so the same picture would get different bytes. */
#ifndef BEADREEL_RENDER_DRAW_SVG_IDS_H
#define BEADREEL_RENDER_DRAW_SVG_IDS_H

#include <stddef.h>
#include <stdio.h>

#include "beadreel/error.h"

/* Writes `text` to `file`, with "surface604", "image607" and "source-610" counted from 1 in the order they come. Write errors show
 * when the file is closed. Errors: UNSUPPORTED (more names than a figure has). */
BEAD_CHECK enum bead_error bead_svg_write(const char *text, size_t length, FILE *file, struct bead_message *msg);

#endif
