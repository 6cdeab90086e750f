/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A palette of up to 255 colours for all frames of an animation: first all are counted, then the colours are chosen, then frames
 * converted. No dithering: flat areas stay flat and still areas still. A palette that changed on the way would cost a whole picture
 * for every frame from then on, since encoders leave out what stays as it is only with the palette of the first frame. */
#ifndef BEADREEL_RENDER_COLOUR_PALETTE_H
#define BEADREEL_RENDER_COLOUR_PALETTE_H

#include <stddef.h>
#include <stdint.h>

#include "beadreel/error.h"

/* Index 255 stays free: it is transparent, which means "as before". */
enum { BEAD_PALETTE_MOST = 255 };

struct bead_palette;

/* On failure *palette is NULL. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_palette_create(struct bead_palette **palette, struct bead_message *msg);
void bead_palette_destroy(struct bead_palette *palette);
/* Pixels R G B, three bytes each. */
void bead_palette_count(struct bead_palette *palette, const uint8_t *rgb, size_t pixels);
/* Among what was counted; all of it where it fits. Errors: MEMORY. */
BEAD_CHECK enum bead_error bead_palette_choose(struct bead_palette *palette, struct bead_message *msg);
void bead_palette_convert(struct bead_palette *palette, const uint8_t *rgb, size_t pixels, uint8_t *indices);
/* 0xAARRGGBB, for all 256 indices. */
void bead_palette_colours(const struct bead_palette *palette, uint32_t argb[256]);

/* ---- the few colours that best represent many: boxes of colours are cut in two until there are enough ---- */

struct bead_tone {
    uint32_t colour; /* 0x00RRGGBB */
    uint32_t count;  /* pixels of it, >= 1 */
};

/* Chooses at most `most` of `count` different tones into `chosen` (0x00RRGGBB). Each is one of the tones, the most frequent of
 * those it represents. Sorts `tones`. Returns the number chosen. */
size_t bead_palette_cut(struct bead_tone *tones, size_t count, size_t most, uint32_t *chosen);
/* Moves such colours to the middle of the tones that are nearest to each, a few times over. One that is most of its tones stays. */
void bead_palette_refine(const struct bead_tone *tones, size_t count, uint32_t *colours, size_t used);

#endif
