#include "render/draw/palette_cut.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_BOXES = 256 };

/* A group of tones, by place in the array. */
struct box {
    size_t first, count;
    int axis;      /* bits to shift for the channel with the largest spread */
    double spread; /* weighted sum of squared deviations along it */
};

/* The square root keeps a large background from taking all colours. */
static double weight(const struct bead_tone *tone)
{
    return sqrt(tone->count);
}

static int channel(uint32_t colour, int shift)
{
    return (int)(colour >> shift & 255);
}

static void measure(const struct bead_tone *tones, struct box *box)
{
    static const double importance[] = {0.6, 1, 0.8}; /* of blue, green and red to the eye, about */
    box->spread = 0;
    box->axis = 8;
    for (int shift = 0; shift < 24; shift += 8) {
        double sum = 0, first = 0, second = 0;
        for (size_t i = box->first; i < box->first + box->count; i++) {
            double w = weight(&tones[i]), c = channel(tones[i].colour, shift);
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

/* By one channel, then by all, so that the order does not depend on the sort. */
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

/* How many of a sorted box stay below the cut that leaves the least spread in the two parts (at least one in each):
 * the one with the largest first moment squared by weight, summed over both. */
static size_t best_cut(const struct bead_tone *tones, size_t count, int shift)
{
    double total = 0, moment = 0, below = 0, moment_below = 0, most = -1;
    for (size_t i = 0; i < count; i++) {
        total += weight(&tones[i]);
        moment += weight(&tones[i]) * channel(tones[i].colour, shift);
    }
    size_t best = 1;
    for (size_t i = 0; i + 1 < count; i++) {
        below += weight(&tones[i]);
        moment_below += weight(&tones[i]) * channel(tones[i].colour, shift);
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
    measure(tones, box);
    measure(tones, rest);
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
        measure(tones, &boxes[0]);
    while (used < most && used < MOST_BOXES && used) {
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
