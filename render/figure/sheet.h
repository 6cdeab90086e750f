/* Sheets: stills with a caption or of several panels, images and plots side by side. One table of rows; plots of a row are equally
 * high, those of a column stand above each other, panels of one field have one range of colours and one bar. */
#ifndef BEADREEL_RENDER_FIGURE_SHEET_H
#define BEADREEL_RENDER_FIGURE_SHEET_H

#include "beadreel/sink.h"

struct bead_sheet;

/* Is this output one? Else it is a figure or a plot alone. */
bool bead_sheet_wanted(const struct bead_output *output);
/* `output` is borrowed. Errors: SCENE (with the place of the output or panel), MEMORY, IO and FORMAT of colour maps. */
BEAD_CHECK enum bead_error bead_sheet_create(const struct bead_output *output, const struct bead_run_context *context,
                                             struct bead_sheet **sheet, struct bead_message *msg);
void bead_sheet_needs(const struct bead_sheet *sheet, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_sheet_feed(struct bead_sheet *sheet, const struct bead_sample *sample, struct bead_message *msg);
/* To a .png, .pdf or .svg. Errors: UNSUPPORTED (no outcomes for peaks), IO, MEMORY, GRAPHICS. */
BEAD_CHECK enum bead_error bead_sheet_write(struct bead_sheet *sheet, const struct bead_outcome *outcomes, const char *path,
                                            uint64_t *bytes, struct bead_message *msg);
void bead_sheet_destroy(struct bead_sheet *sheet);

#endif
