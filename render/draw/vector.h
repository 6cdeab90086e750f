/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vector files: features that cairo lacks. It draws letters only as outlines, so the words of a page are kept while it is drawn and
 * written last, run by run, each as wide as it was laid out. And it numbers surfaces through the life of a program, so one picture
 * would get different bytes each time. */
#pragma once

#include <cairo.h>
#include <pango/pango.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "beadreel/error.h"

/* Text drawn on this surface goes to `file`, which is borrowed until the surface is destroyed. False: out of memory. */
bool bead_svg_text_keep(cairo_surface_t *surface, FILE *file);
/* The file that collects the text of this context; NULL: text is drawn. */
FILE *bead_svg_text_file(cairo_t *cr);
/* A line, from `x` on a baseline `y` below the origin of the context, in Pango's units and the context's colour. */
void bead_svg_text_line(FILE *file, cairo_t *cr, PangoLayout *layout, const PangoLayoutLine *line, int x, int y);

/* An SVG file in parts. */
struct bead_svg_parts {
    char *text; /* the drawing, a whole file */
    size_t length;
    char *words; /* elements that come last, above everything else */
    size_t words_length;
    const char *title, *description, *source; /* "" or NULL: none; source: the scene */
};

/* Writes the drawing to `file`, with its title, description, scene (as metadata) and words, and with "surface604", "image607" and
 * "source-610" numbered from 1 in order of appearance. Write errors show when the file is closed. Errors: UNSUPPORTED (too many
 * names). */
BEAD_CHECK enum bead_error bead_svg_write(const struct bead_svg_parts *svg, FILE *file, struct bead_message *msg);

/* PDF files: features that cairo lacks, a text in place of the figure for those who cannot see it, and the scene. */

/* Writes a complete file of cairo's, in which a tag Figure holds the whole page, and after it an update (ISO 32000-1, 7.5.6) that
 * gives the figure the document's subject as its text (/Alt, 14.9.3), and the document its language and a window with its title.
 * `source` (NULL or "": none), the scene, is attached as scene.yaml. Files of another form stay as they are. Write errors show when
 * the file is closed. */
void bead_pdf_write(const char *pdf, size_t length, const char *source, FILE *file);
