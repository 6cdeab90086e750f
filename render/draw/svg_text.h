/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Letters of SVG files as text. cairo knows outlines only, so the words of a page are kept aside while it is drawn, and written
 * after everything else, run by run, each at its place and as wide as it was laid out. */
#ifndef BEADREEL_RENDER_DRAW_SVG_TEXT_H
#define BEADREEL_RENDER_DRAW_SVG_TEXT_H

#include <cairo.h>
#include <pango/pango.h>
#include <stdbool.h>
#include <stdio.h>

/* Text drawn on this surface goes to `file`, which is borrowed until the surface is gone. False: out of memory. */
bool bead_svg_text_keep(cairo_surface_t *surface, FILE *file);
/* Where text of this context goes; NULL: it is drawn. */
FILE *bead_svg_text_file(cairo_t *cr);
/* The line that `iter` is at, with its baseline at `baseline` below the origin of the context, both in Pango's units, in the
 * context's colour. */
void bead_svg_text_line(FILE *file, cairo_t *cr, PangoLayout *layout, const PangoLayoutIter *iter, int baseline);

#endif
