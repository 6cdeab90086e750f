/* Which blocks of a picture are as they were in the picture encoded last: encoders may skip these without looking. */
#ifndef BEADREEL_RENDER_ENCODE_MOVIE_BLOCKS_H
#define BEADREEL_RENDER_ENCODE_MOVIE_BLOCKS_H

#include <stdint.h>

#include "beadreel/frame.h"

enum { BEAD_BLOCK = 16 /* px: side of H.264's macroblocks */ };

struct bead_blocks {
    uint8_t *same; /* 1: unchanged; across x down, row by row */
    int across, down;
};

/* All of a picture of width x height pixels has changed. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_blocks_create(int width, int height, struct bead_blocks *blocks, struct bead_message *msg);
/* These rectangles, of pixels as converted, have changed. */
void bead_blocks_change(struct bead_blocks *blocks, const struct bead_changes *changes);
/* The picture has been encoded: nothing has changed since. */
void bead_blocks_encoded(struct bead_blocks *blocks);
void bead_blocks_free(struct bead_blocks *blocks);

#endif
