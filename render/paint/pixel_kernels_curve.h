/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: curves, row by row. */

/* The covered part of the pixels in row y, summed over the slices. */
static inline __attribute__((always_inline)) reals covered(const struct bead_extents *e, int column, float y)
{
    reals sum = all(0);
    for (int s = 0; s < BEAD_SLICES; s++) {
        const reals low = *(const reals_anywhere *)(e->low[s] + column), high = *(const reals_anywhere *)(e->high[s] + column);
        sum += clamp(SMALLER(all(y + 1), high) - LARGER(all(y), low));
    }
    return sum;
}

/* Interpolate to a colour, rounding. */
static inline words mix(words behind, float colour, reals alpha)
{
    const reals from = __builtin_convertvector((ints)behind, reals);
    return (words) __builtin_convertvector(from + alpha * (colour - from) + 0.5f, ints);
}

static void curve_columns(const struct bead_columns *k, uint8_t *pixels, size_t stride)
{
    for (int x = 0; x < BEAD_COLUMNS; x += LANES) {
        const int group = x / BEAD_COLUMN_GROUP;
        for (int y = k->from[group]; y < k->to[group]; y++) {
            words_anywhere *at = (words_anywhere *)(pixels + (size_t)y * stride + 4 * (size_t)x);
            const reals line = covered(&k->line, x, (float)y) / BEAD_SLICES;
            const reals area = k->area_alpha * covered(&k->area, x, (float)y) / BEAD_SLICES;
            words pixel = k->channels == 4 ? *at & 0 : *at & 0xff000000;
            for (int c = 0; c < k->channels; c++)
                pixel |= mix(mix(*at >> 8 * c & 255, k->under[c], area), k->over[c], line) << 8 * c;
            *at = pixel;
        }
    }
}
