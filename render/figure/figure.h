/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures: one or more views of every chain, with axes, headings and a colour bar; a still of its own, or one of its panels.
 *
 *   bead_figure_create -> bead_figure_put, repeated -> bead_figure_start -> needs, feed -> bead_figure_extremes ->
 *   bead_figure_set_range -> bead_figure_finish -> bead_figure_decorate and bead_figure_draw (or bead_figure_vector)
 *
 * The layout is fixed before the first sample, so that images can be summed into their pixels; colours, curves and text are
 * drawn at the end, when their ranges are known. PNG, PDF and SVG come from the same drawing. */
#ifndef BEADREEL_RENDER_FIGURE_FIGURE_H
#define BEADREEL_RENDER_FIGURE_FIGURE_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/canvas.h"
#include "beadreel/sink.h"
#include "render/colour/colour_range.h"
#include "render/draw/page.h"

struct bead_figure;

struct bead_part_settings {
    size_t chain;               /* the only one; SIZE_MAX: all */
    char letter[16];            /* "(a)"; "": none */
    const char *title;          /* shown instead of the chain's name; NULL: none */
    bool no_bar;                /* another part has it */
    bool no_across, no_upwards; /* no labels on the horizontal or vertical outer axis: a neighbouring panel has them */
};

/* Views of one moment are laid out by their beads: see struct bead_sink_type. */
bool bead_figure_looks_at_beads(const struct bead_output *output);
/* `settings`: of a panel; NULL: the figure has the page for itself. Errors: SCENE (with the output's place), MEMORY, IO and FORMAT
 * of colour maps. */
BEAD_CHECK enum bead_error bead_figure_create(const struct bead_output *output, const struct bead_run_context *context,
                                              const struct bead_page *page, const struct bead_look *look,
                                              const struct bead_part_settings *settings, struct bead_figure **figure,
                                              struct bead_message *msg);
void bead_figure_change(struct bead_figure *figure, const struct bead_part_settings *settings);
/* Lays out in an area, with plots at least `least` away from its borders; *insets returns the distances. Errors: SCENE (too small),
 * MEMORY. */
BEAD_CHECK enum bead_error bead_figure_put(struct bead_figure *figure, struct bead_rect area, const struct bead_insets *least,
                                           struct bead_insets *insets, struct bead_message *msg);
/* Ready for samples. */
BEAD_CHECK enum bead_error bead_figure_start(struct bead_figure *figure, struct bead_message *msg);
void bead_figure_needs(const struct bead_figure *figure, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_figure_feed(struct bead_figure *figure, const struct bead_sample *sample, struct bead_message *msg);
/* Sets the grid on which samples will really arrive. */
void bead_figure_regrid(struct bead_figure *figure, const struct bead_grid *grid);
/* Widens the ranges of the colours and of the sensors' axis; both begin as BEAD_NOTHING_SHOWN. */
#define BEAD_NOTHING_SHOWN             \
    {                                  \
        INFINITY, -INFINITY, -INFINITY \
    }
void bead_figure_extremes(const struct bead_figure *figure, struct bead_shown_values *colours, struct bead_shown_values *sensors);
void bead_figure_set_range(struct bead_figure *figure, const struct bead_shown_values *colours,
                           const struct bead_shown_values *sensors);
/* Extends the bar down to this y, px. */
void bead_figure_stretch_bar(struct bead_figure *figure, int bottom);
bool bead_figure_needs_canvas(const struct bead_figure *figure);
BEAD_CHECK enum bead_error bead_figure_finish(struct bead_figure *figure, struct bead_canvas *canvas, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_figure_decorate(struct bead_figure *figure, cairo_t *cr, struct bead_message *msg);
/* `frame` holds what decorate has drawn; so does `background` if a view draws over it. */
BEAD_CHECK enum bead_error bead_figure_draw(struct bead_figure *figure, struct bead_frame *frame,
                                            const struct bead_frame *background, struct bead_message *msg);
BEAD_CHECK enum bead_error bead_figure_vector(struct bead_figure *figure, cairo_t *cr, struct bead_message *msg);
/* Destroys the views that draw on the canvas; call it before the canvas is destroyed. */
void bead_figure_release_canvas(struct bead_figure *figure);
/* What a panel's horizontal or vertical axis shows; panels with equal axes share labels. */
struct bead_axis_kind {
    const char *title; /* NULL: cannot be shared */
    double low, high;
};
struct bead_axis_kind bead_figure_axis(const struct bead_figure *figure, bool upright);

void bead_figure_destroy(struct bead_figure *figure);

#endif
