/* Deflate (RFC 1950 and 1951) for the rows of pictures, several times as fast as general compressors on flat colours: bytes are
 * first looked for a pixel before and a row above, and only then anywhere. */
#ifndef BEADREEL_RENDER_DEFLATE_H
#define BEADREEL_RENDER_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"

enum { BEAD_DEFLATE_SPARE = 8 };

struct bead_deflate;

/* Rows of `row` bytes, pixels of `pixel` bytes. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_deflate_create(size_t row, size_t pixel, struct bead_deflate **deflate, struct bead_message *msg);
void bead_deflate_destroy(struct bead_deflate *deflate);
/* Where to put the next row, and as many bytes behind it as BEAD_DEFLATE_SPARE. */
uint8_t *bead_deflate_next(struct bead_deflate *deflate);
/* The row is there. */
void bead_deflate_row(struct bead_deflate *deflate);
/* After the last row. */
void bead_deflate_finish(struct bead_deflate *deflate);
/* What has come out so far, *size bytes, borrowed until the next row; then it is forgotten. False: no memory was left for it. */
bool bead_deflate_take(struct bead_deflate *deflate, const uint8_t **bytes, size_t *size);

#endif
