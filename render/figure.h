/* Figures: stills of one or more views of every chain, with axes, headings and a colour bar.
 *
 *   bead_figure_create -> bead_figure_needs -> bead_figure_feed, repeated -> bead_figure_write
 *
 * The layout is fixed when the figure is made, so that images can be summed into their pixels; colours, curves and text are
 * drawn at the end, when their ranges are known. PNG, PDF and SVG come from the same drawing. */
#ifndef BEADREEL_RENDER_FIGURE_H
#define BEADREEL_RENDER_FIGURE_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/sink.h"

struct bead_figure;

/* `views` from top to bottom. Errors: SCENE (with the output's place), MEMORY, IO and FORMAT of colour maps. */
BEAD_CHECK enum bead_error bead_figure_create(const struct bead_output *output, const struct bead_stage *stage,
                                              const enum bead_view_kind *views, size_t view_count, struct bead_figure **figure,
                                              struct bead_message *msg);
void bead_figure_needs(const struct bead_figure *figure, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_figure_feed(struct bead_figure *figure, const struct bead_sample *sample, struct bead_message *msg);
/* To a .png, .pdf or .svg. Errors: IO, MEMORY, GRAPHICS. */
BEAD_CHECK enum bead_error bead_figure_write(struct bead_figure *figure, const char *path, uint64_t *bytes,
                                             struct bead_message *msg);
/* From when to when an output shows the run. Errors: SCENE (with the output's place). */
BEAD_CHECK enum bead_error bead_figure_times(const struct bead_output *output, const struct bead_stage *stage, double time[2],
                                             struct bead_message *msg);
/* Times at which a picture with `pixels` along `time` wants samples: two or more a pixel, and every oscillation; those there are
 * where the stage has given ones. */
struct bead_grid bead_figure_grid(const struct bead_stage *stage, const struct bead_output *output, const double time[2],
                                  double pixels);
void bead_figure_destroy(struct bead_figure *figure);

#endif
