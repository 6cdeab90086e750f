/* Palettes of up to 255 colours for frames of an animation: the colours of the first frame, exact if they fit, and room for colours
 * of later frames. No dithering: flat areas stay flat and still areas still. */
#ifndef BEADREEL_RENDER_DRAW_PALETTE_H
#define BEADREEL_RENDER_DRAW_PALETTE_H

#include <libavutil/frame.h>
#include <stdint.h>

#include "beadreel/error.h"
#include "beadreel/frame.h"

/* Index 255 stays free: it is transparent, which means "as before". */
enum { BEAD_PALETTE_MOST = 255 };

struct bead_palette;

/* On failure *palette is NULL. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_palette_create(struct bead_palette **palette, struct bead_message *msg);
void bead_palette_destroy(struct bead_palette *palette);
/* Convert rectangles (aligned with bead_convert_align) of `frame` into `picture` (AV_PIX_FMT_PAL8); the first call chooses the
 * palette from them. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_palette_convert(struct bead_palette *palette, const struct bead_frame *frame,
                                                const struct bead_changes *rects, AVFrame *picture, struct bead_message *msg);

/* ---- the few colours that best represent many: boxes of colours are cut in two until there are enough ---- */

struct bead_tone {
    uint32_t colour; /* 0x00RRGGBB */
    uint32_t count;  /* pixels of it, >= 1 */
};

/* Chooses at most `most` of `count` different tones into `chosen` (0x00RRGGBB). Each is one of the tones, the most frequent of
 * those it represents. Sorts `tones`. Returns the number chosen. */
size_t bead_palette_cut(struct bead_tone *tones, size_t count, size_t most, uint32_t *chosen);

#endif
