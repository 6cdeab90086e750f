/* Plots of peaks: the largest force of every contact against its number, one curve for each chain. */
#ifndef BEADREEL_RENDER_PEAKS_PLOT_H
#define BEADREEL_RENDER_PEAKS_PLOT_H

#include <stdint.h>

#include "beadreel/sink.h"

struct bead_peaks_plot;

/* `output` and what the stage points to are borrowed until destroy. Errors: SCENE (with the output's place), MEMORY. */
BEAD_CHECK enum bead_error bead_peaks_plot_create(const struct bead_output *output, const struct bead_stage *stage,
                                                  struct bead_peaks_plot **plot, struct bead_message *msg);
void bead_peaks_plot_needs(const struct bead_peaks_plot *plot, struct bead_needs *needs);
/* To a .png, .pdf or .svg; outcomes of all chains, with contact_peaks. Errors: IO, MEMORY, GRAPHICS, SCENE (too small). */
BEAD_CHECK enum bead_error bead_peaks_plot_write(struct bead_peaks_plot *plot, const struct bead_outcome *outcomes,
                                                 const char *path, uint64_t *bytes, struct bead_message *msg);
void bead_peaks_plot_destroy(struct bead_peaks_plot *plot);

#endif
