/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A palette of up to 255 colours for all frames of an animation: count all pixels, choose the colours, then convert frames. No
 * dithering: flat areas stay flat and still areas still. With separate palettes, each frame would need a whole picture, since
 * encoders leave out unchanged pixels only with the palette of the first frame. */
#pragma once

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
/* Chooses among the colours counted, all of them if they fit. Errors: MEMORY. */
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