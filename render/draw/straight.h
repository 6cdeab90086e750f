/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Straight colours from premultiplied ones: files of pictures and movies want the colour of what covers a pixel. */
#ifndef BEADREEL_RENDER_DRAW_STRAIGHT_H
#define BEADREEL_RENDER_DRAW_STRAIGHT_H

#include <stddef.h>
#include <stdint.h>

/* `count` pixels B G R A of a frame with alpha, see frame.h, to straight R G B A. Light that is added hides as much as it shines.
 * What is wholly transparent is black. */
void bead_straight_rgba(const uint8_t *bgra, size_t count, uint8_t *rgba);

#endif
