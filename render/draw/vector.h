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

/* The file that collects the text of this context; NULL: text is drawn. */
FILE *bead_svg_text_file(cairo_t *cr);
/* A line, from `x` on a baseline `y` below the origin of the context, in Pango's units and the context's colour. */
void bead_svg_text_line(FILE *file, cairo_t *cr, PangoLayout *layout, const PangoLayoutLine *line, int x, int y);

/* PDF files: features that cairo lacks, a text in place of the figure for those who cannot see it, and the scene. */

/* Writes a complete file of cairo's, in which a tag Figure holds the whole page, and after it an update (ISO 32000-1, 7.5.6) that
 * gives the figure the document's subject as its text (/Alt, 14.9.3), and the document its language and a window with its title.
 * `source` (NULL or "": none), the scene, is attached as scene.yaml. Files of another form stay as they are. Write errors show when
 * the file is closed. */
void bead_pdf_write(const char *pdf, size_t length, const char *source, FILE *file);
