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

/* Rows of a vector of columns: those from `low` to `high` are all that something touches, those from `inner` to `end` are covered
 * by it in every slice. */
struct extent_rows {
    float low, high, inner, end;
};

static inline struct extent_rows rows_of(const struct bead_extents *e, int column)
{
    struct extent_rows rows = {INFINITY, -INFINITY, -INFINITY, INFINITY};
    for (int s = 0; s < BEAD_SLICES; s++) {
        for (int i = column; i < column + LANES; i++) {
            rows.low = least(rows.low, e->low[s][i]);
            rows.high = most(rows.high, e->high[s][i]);
            rows.inner = most(rows.inner, e->low[s][i]);
            rows.end = least(rows.end, e->high[s][i]);
        }
    }
    return rows;
}

static inline bool is_outside(const struct extent_rows *rows, float y)
{
    return y + 1 <= rows->low || y >= rows->high;
}

static inline __attribute__((always_inline)) void mix_pixels(const struct bead_columns *k, words_anywhere *at, reals area,
                                                             reals line)
{
    words pixel = k->channels == 4 ? *at & 0 : *at & 0xff000000;
    for (int c = 0; c < k->channels; c++)
        pixel |= mix(mix(*at >> 8 * c & 255, k->under[c], area), k->over[c], line) << 8 * c;
    *at = pixel;
}

/* Most rows are far below the line, within the area: their coverage is known. */
static void curve_columns(const struct bead_columns *k, uint8_t *pixels, size_t stride)
{
    for (int x = 0; x < BEAD_COLUMNS; x += LANES) {
        const int group = x / BEAD_COLUMN_GROUP;
        const struct extent_rows of_line = rows_of(&k->line, x), of_area = rows_of(&k->area, x);
        for (int y = k->from[group]; y < k->to[group]; y++) {
            words_anywhere *at = (words_anywhere *)(pixels + (size_t)y * stride + 4 * (size_t)x);
            const bool bare = is_outside(&of_line, (float)y);
            if (bare && is_outside(&of_area, (float)y))
                continue;
            if (bare && (float)y >= of_area.inner && (float)(y + 1) <= of_area.end)
                mix_pixels(k, at, all(k->area_alpha), all(0));
            else
                mix_pixels(k, at, k->area_alpha * covered(&k->area, x, (float)y) / BEAD_SLICES,
                           covered(&k->line, x, (float)y) / BEAD_SLICES);
        }
    }
}
