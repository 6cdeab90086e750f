/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Palettes of animations: chooses the colours of all frames and turns their pixels into indices. Used for GIF files. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "render/colour/palette.h"
#include "sim/base/memory.h"

enum { MOST_BOXES = 256, ROUNDS = 4 };

/* A group of tones, by position in the array. */
struct box {
    size_t first, count;
    int axis;      /* bits to shift for the channel with the largest spread */
    double spread; /* weighted sum of squared deviations along it */
};

static int channel(uint32_t colour, int shift)
{
    return (int)(colour >> shift & 255);
}

/* Every pixel has the same weight: with less weight for frequent colours, slow gradients of large areas would show steps. */
static void palette_measure(const struct bead_tone *tones, struct box *box)
{
    static const double importance[] = {0.6, 1, 0.8}; /* approximate weight of blue, green and red for the eye */
    box->spread = 0;
    box->axis = 8;
    for (int shift = 0; shift < 24; shift += 8) {
        double sum = 0, first = 0, second = 0;
        for (size_t i = box->first; i < box->first + box->count; i++) {
            double w = tones[i].count, c = channel(tones[i].colour, shift);
            sum += w;
            first += w * c;
            second += w * c * c;
        }
        double spread = importance[shift / 8] * (second - first * first / sum);
        if (spread > box->spread) {
            box->spread = spread;
            box->axis = shift;
        }
    }
}

/* Orders by one channel, then by all: the result does not depend on the sort. */
static int compare(const struct bead_tone *a, const struct bead_tone *b, int shift)
{
    int difference = channel(a->colour, shift) - channel(b->colour, shift);
    return difference ? difference : (a->colour > b->colour) - (a->colour < b->colour);
}

static int by_blue(const void *a, const void *b)
{
    return compare(a, b, 0);
}

static int by_green(const void *a, const void *b)
{
    return compare(a, b, 8);
}

static int by_red(const void *a, const void *b)
{
    return compare(a, b, 16);
}

/* The number of tones of a sorted box below the cut that leaves the least spread in the two parts, at least one in each: it has the
 * largest sum over both parts of the squared first moment over the weight. */
static size_t best_cut(const struct bead_tone *tones, size_t count, int shift)
{
    double total = 0, moment = 0, below = 0, moment_below = 0, most = -1;
    for (size_t i = 0; i < count; i++) {
        total += tones[i].count;
        moment += (double)tones[i].count * channel(tones[i].colour, shift);
    }
    size_t best = 1;
    for (size_t i = 0; i + 1 < count; i++) {
        below += tones[i].count;
        moment_below += (double)tones[i].count * channel(tones[i].colour, shift);
        double rest = moment - moment_below, gain = moment_below * moment_below / below + rest * rest / (total - below);
        if (gain > most) {
            most = gain;
            best = i + 1;
        }
    }
    return best;
}

static void cut(struct bead_tone *tones, struct box *box, struct box *rest)
{
    static int (*const order[])(const void *, const void *) = {by_blue, by_green, by_red};
    qsort(tones + box->first, box->count, sizeof *tones, order[box->axis / 8]);
    size_t keep = best_cut(tones + box->first, box->count, box->axis);
    *rest = (struct box){.first = box->first + keep, .count = box->count - keep};
    box->count = keep;
    palette_measure(tones, box);
    palette_measure(tones, rest);
}

static uint32_t most_frequent(const struct bead_tone *tones, const struct box *box)
{
    const struct bead_tone *best = &tones[box->first];
    for (size_t i = 1; i < box->count; i++) {
        const struct bead_tone *tone = &tones[box->first + i];
        if (tone->count > best->count || (tone->count == best->count && tone->colour < best->colour))
            best = tone;
    }
    return best->colour;
}

size_t bead_palette_cut(struct bead_tone *tones, size_t count, size_t most, uint32_t *chosen)
{
    struct box boxes[MOST_BOXES] = {{.first = 0, .count = count}};
    size_t used = count > 0;
    if (used)
        palette_measure(tones, &boxes[0]);
    while (used > 0 && used < most && used < MOST_BOXES) {
        struct box *widest = &boxes[0];
        for (size_t i = 1; i < used; i++) {
            if (boxes[i].spread > widest->spread)
                widest = &boxes[i];
        }
        if (widest->count < 2)
            break; /* only single tones are left */
        cut(tones, widest, &boxes[used]);
        used++;
    }
    for (size_t i = 0; i < used; i++)
        chosen[i] = most_frequent(tones, &boxes[i]);
    return used;
}

static int palette_distance(uint32_t a, uint32_t b)
{
    int sum = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int d = channel(a, shift) - channel(b, shift);
        sum += d * d;
    }
    return sum;
}

static size_t nearest(const uint32_t *colours, size_t count, uint32_t colour)
{
    size_t best = 0;
    int least = INT_MAX;
    for (size_t i = 0; i < count; i++) {
        int d = palette_distance(colour, colours[i]);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

/* Statistics of the tones that share one colour. */
struct group {
    double weight, sum[3];
    const struct bead_tone *most; /* the most frequent */
};

static uint32_t middle_of(const struct group *g)
{
    uint32_t colour = 0;
    for (int c = 0; c < 3; c++)
        colour |= (uint32_t)lround(g->sum[c] / g->weight) << 8 * c;
    return g->most->count > 0.5 * g->weight ? g->most->colour : colour; /* flat areas keep their colour */
}

/* Moves colours to the middle of the tones nearest to each, a few times over. A tone with more than half of its group's pixels
 * stays. */
static void refine(const struct bead_tone *tones, size_t count, uint32_t *colours, size_t used)
{
    for (int round = 0; round < ROUNDS; round++) {
        struct group groups[MOST_BOXES] = {{.weight = 0}};
        for (size_t i = 0; i < count; i++) {
            struct group *g = &groups[nearest(colours, used, tones[i].colour)];
            double w = tones[i].count;
            g->weight += w;
            for (int c = 0; c < 3; c++)
                g->sum[c] += w * channel(tones[i].colour, 8 * c);
            if (!g->most || tones[i].count > g->most->count)
                g->most = &tones[i];
        }
        for (size_t k = 0; k < used; k++) {
            if (groups[k].most)
                colours[k] = middle_of(&groups[k]);
        }
    }
}

enum { COLOURS = 1 << 24 };

struct bead_palette {
    uint32_t colour[BEAD_PALETTE_MOST]; /* 0x00RRGGBB */
    size_t used;
    uint32_t *histogram; /* [COLOURS] pixels of each; like `known`, takes memory only for pages in use */
    uint8_t *known;      /* [COLOURS] index + 1 of the colour's replacement, 0: not looked up yet */
};

enum bead_error bead_palette_create(struct bead_palette **palette, struct bead_message *msg)
{
    struct bead_palette *p = *palette = calloc(1, sizeof *p);
    if (p) {
        p->histogram = calloc(COLOURS, sizeof *p->histogram);
        p->known = calloc(COLOURS, 1);
    }
    if (p && p->histogram && p->known)
        return BEAD_OK;
    bead_palette_destroy(p);
    *palette = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a palette");
}

void bead_palette_destroy(struct bead_palette *palette)
{
    if (!palette)
        return;
    free(palette->histogram);
    free(palette->known);
    free(palette);
}

static uint32_t pixel(const uint8_t *rgb)
{
    return (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
}

void bead_palette_count(struct bead_palette *palette, const uint8_t *rgb, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++) {
        uint32_t *bin = &palette->histogram[pixel(rgb + 3 * i)];
        *bin += *bin < UINT32_MAX;
    }
}

enum bead_error bead_palette_choose(struct bead_palette *palette, struct bead_message *msg)
{
    size_t count = 0, n = 0;
    for (uint32_t c = 0; c < COLOURS; c++)
        count += palette->histogram[c] > 0;
    BEAD_FREED struct bead_tone *tones = malloc((count + 1) * sizeof *tones);
    if (!tones)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a palette");
    for (uint32_t c = 0; c < COLOURS; c++) {
        if (palette->histogram[c])
            tones[n++] = (struct bead_tone){c, palette->histogram[c]};
    }
    palette->used = bead_palette_cut(tones, count, BEAD_PALETTE_MOST, palette->colour);
    if (count > BEAD_PALETTE_MOST)
        refine(tones, count, palette->colour, palette->used);
    return BEAD_OK;
}

void bead_palette_convert(struct bead_palette *palette, const uint8_t *rgb, size_t pixels, uint8_t *indices)
{
    for (size_t i = 0; i < pixels; i++) {
        uint32_t colour = pixel(rgb + 3 * i);
        if (!palette->known[colour])
            palette->known[colour] = (uint8_t)(nearest(palette->colour, palette->used, colour) + 1);
        indices[i] = (uint8_t)(palette->known[colour] - 1);
    }
}

void bead_palette_colours(const struct bead_palette *palette, uint32_t argb[256])
{
    /* Unused places are opaque, so that encoders take only the last one, which is never used, as transparent. */
    for (size_t i = 0; i < BEAD_PALETTE_MOST; i++)
        argb[i] = 0xff000000u | (i < palette->used ? palette->colour[i] : 0);
    argb[BEAD_PALETTE_MOST] = 0;
}
