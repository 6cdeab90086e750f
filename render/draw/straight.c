/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divides premultiplied colours by their alpha. */
#include "render/draw/straight.h"

static unsigned larger(unsigned a, unsigned b)
{
    return a > b ? a : b;
}

void bead_straight_rgba(const uint8_t *bgra, size_t count, uint8_t *rgba)
{
    for (size_t i = 0; i < count; i++, bgra += 4, rgba += 4) {
        unsigned alpha = larger(larger(bgra[0], bgra[1]), larger(bgra[2], bgra[3]));
        for (int c = 0; c < 3; c++)
            rgba[c] = (uint8_t)(alpha > 0 ? (255 * bgra[2 - c] + alpha / 2) / alpha : 0);
        rgba[3] = (uint8_t)alpha;
    }
}
