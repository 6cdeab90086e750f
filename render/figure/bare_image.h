/* Bare pixels, `axes: false`: they lie as those of imagesc, bead 0 in the top row, beads downwards, time to the right; several
 * chains stand one below the other. The picture has exactly the size asked for, and its palette is the colour map. */
#ifndef BEADREEL_RENDER_FIGURE_BARE_IMAGE_H
#define BEADREEL_RENDER_FIGURE_BARE_IMAGE_H

#include "beadreel/sink.h"

struct bead_bare_image;

/* `output` is borrowed. Errors: SCENE (with its place), MEMORY, IO and FORMAT of colour maps. */
BEAD_CHECK enum bead_error bead_bare_image_create(const struct bead_output *output, const struct bead_run_context *context,
                                                  struct bead_bare_image **bare, struct bead_message *msg);
void bead_bare_image_needs(const struct bead_bare_image *bare, struct bead_needs *needs);
BEAD_CHECK enum bead_error bead_bare_image_feed(struct bead_bare_image *bare, const struct bead_sample *sample,
                                                struct bead_message *msg);
/* To a .png, .pdf or .svg. Errors: IO, MEMORY, GRAPHICS. */
BEAD_CHECK enum bead_error bead_bare_image_write(const struct bead_bare_image *bare, const char *path, uint64_t *bytes,
                                                 struct bead_message *msg);
void bead_bare_image_destroy(struct bead_bare_image *bare);

#endif
