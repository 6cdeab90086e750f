/* The few colours that stand best for many: boxes of colours are cut in two until there are enough. */
#ifndef BEADREEL_RENDER_DRAW_PALETTE_CUT_H
#define BEADREEL_RENDER_DRAW_PALETTE_CUT_H

#include <stddef.h>
#include <stdint.h>

struct bead_tone {
    uint32_t colour; /* 0x00RRGGBB */
    uint32_t count;  /* pixels of it, >= 1 */
};

/* Choose `most` of `count` different tones into `chosen` (0x00RRGGBB); all of them where they fit. Each is one of the tones,
 * the most frequent of those it stands for. Sorts `tones`. Returns the number chosen. */
size_t bead_palette_cut(struct bead_tone *tones, size_t count, size_t most, uint32_t *chosen);

#endif
