/* Palettes of animations: which colours a frame gets, and its pixels as their indices. Encoders of GIF use it. */
#include <libavutil/mem.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/palette.h"

enum { MOST_BOXES = 256 };

/* A group of tones, by position in the array. */
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

static void palette_measure(const struct bead_tone *tones, struct box *box)
{
    static const double importance[] = {0.6, 1, 0.8}; /* approximate weight of blue, green and red for the eye */
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

/* The number of tones of a sorted box below the cut that leaves the least spread in the two parts, at least one in each: there, the
 * squared first moment over the weight, summed over both parts, is largest. */
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

enum {
    COLOURS = 1 << 24,
    FIRST_MOST = 208,   /* colours of the first frame, if it has more than fit; the rest is for later frames */
    EXACT_BELOW = 128,  /* with fewer colours than this, every new colour gets its own place */
    NEAR = 3 * 12 * 12, /* squared distance of colours that may replace each other */
    RARE_SHARE = 2000,  /* new colours on less than 1/2000 of the pixels are not worth a whole new picture */
    MISSES = 4096       /* different new colours looked at in one frame */
};

struct bead_palette {
    uint32_t colour[BEAD_PALETTE_MOST]; /* 0x00RRGGBB */
    size_t used;
    uint8_t *known; /* [COLOURS] index + 1 of a colour's stand-in, 0: not looked up yet; pages are taken as needed */
    struct bead_tone missed[MISSES];
    size_t missed_count;
};

enum bead_error bead_palette_create(struct bead_palette **palette, struct bead_message *msg)
{
    *palette = calloc(1, sizeof **palette);
    uint8_t *known = calloc(COLOURS, 1);
    if (*palette && known) {
        (*palette)->known = known;
        return BEAD_OK;
    }
    free(known);
    free(*palette);
    *palette = NULL;
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a palette");
}

void bead_palette_destroy(struct bead_palette *palette)
{
    if (palette)
        free(palette->known);
    free(palette);
}

/* Rows may end in padding, which belongs to no picture. */
static int visible_end(const struct bead_frame *frame, const struct bead_rect *r)
{
    return r->x + r->width < frame->width ? r->x + r->width : frame->width;
}

static uint32_t pixel(const uint8_t *bgrx)
{
    return (uint32_t)bgrx[2] << 16 | (uint32_t)bgrx[1] << 8 | bgrx[0];
}

static int palette_distance(uint32_t a, uint32_t b)
{
    int sum = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int d = (int)(a >> shift & 255) - (int)(b >> shift & 255);
        sum += d * d;
    }
    return sum;
}

static size_t nearest(const struct bead_palette *palette, uint32_t colour, int *least)
{
    size_t best = 0;
    *least = 1 << 30;
    for (size_t i = 0; i < palette->used; i++) {
        int d = palette_distance(colour, palette->colour[i]);
        if (d < *least) {
            *least = d;
            best = i;
        }
    }
    return best;
}

static void append(struct bead_palette *palette, uint32_t colour)
{
    palette->colour[palette->used++] = colour;
    palette->known[colour] = (uint8_t)palette->used;
}

static enum bead_error count_tones(const struct bead_frame *frame, const struct bead_changes *rects, struct bead_tone **tones,
                                   size_t *count, struct bead_message *msg)
{
    *count = 0;
    *tones = NULL;
    uint32_t *histogram = calloc(COLOURS, sizeof *histogram);
    if (!histogram)
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a palette");
    for (size_t i = 0; i < rects->count; i++) {
        const struct bead_rect *r = &rects->rect[i];
        for (int y = r->y; y < r->y + r->height; y++) {
            for (int x = r->x; x < visible_end(frame, r); x++) {
                uint32_t *bin = &histogram[pixel(frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x)];
                *count += ++*bin == 1;
            }
        }
    }
    *tones = malloc((*count ? *count : 1) * sizeof **tones);
    if (*tones) {
        size_t n = 0;
        for (uint32_t c = 0; c < COLOURS; c++) {
            if (histogram[c])
                (*tones)[n++] = (struct bead_tone){c, histogram[c]};
        }
    }
    free(histogram);
    return *tones ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a palette");
}

static enum bead_error palette_choose(struct bead_palette *palette, const struct bead_frame *frame,
                                      const struct bead_changes *rects, struct bead_message *msg)
{
    struct bead_tone *tones;
    size_t count;
    enum bead_error err = count_tones(frame, rects, &tones, &count, msg);
    if (err)
        return err;
    uint32_t chosen[BEAD_PALETTE_MOST];
    size_t used = bead_palette_cut(tones, count, count <= BEAD_PALETTE_MOST ? BEAD_PALETTE_MOST : FIRST_MOST, chosen);
    for (size_t i = 0; i < used; i++)
        append(palette, chosen[i]);
    free(tones);
    return BEAD_OK;
}

static void miss(struct bead_palette *palette, uint32_t colour)
{
    for (size_t i = palette->missed_count; i-- > 0;) {
        if (palette->missed[i].colour == colour) {
            palette->missed[i].count++;
            return;
        }
    }
    if (palette->missed_count < MISSES)
        palette->missed[palette->missed_count++] = (struct bead_tone){colour, 1};
}

/* The distance from which a new colour needs a place of its own. */
static int tolerance(const struct bead_palette *palette)
{
    return palette->used < EXACT_BELOW ? 0 : NEAR;
}

static uint8_t palette_look_up(struct bead_palette *palette, uint32_t colour)
{
    uint8_t known = palette->known[colour];
    if (known)
        return (uint8_t)(known - 1);
    int least;
    size_t index = nearest(palette, colour, &least);
    if (least > tolerance(palette) && palette->used < BEAD_PALETTE_MOST)
        miss(palette, colour); /* asked again next time */
    else
        palette->known[colour] = (uint8_t)(index + 1);
    return (uint8_t)index;
}

static void palette_convert(struct bead_palette *palette, const struct bead_frame *frame, const struct bead_changes *rects,
                            AVFrame *picture)
{
    for (size_t i = 0; i < rects->count; i++) {
        const struct bead_rect *r = &rects->rect[i];
        for (int y = r->y; y < r->y + r->height; y++) {
            const uint8_t *from = frame->pixels + (size_t)y * frame->stride;
            uint8_t *to = picture->data[0] + (ptrdiff_t)y * picture->linesize[0];
            for (int x = r->x; x < visible_end(frame, r); x++)
                to[x] = palette_look_up(palette, pixel(from + 4 * (size_t)x));
        }
    }
}

/* Gives places to all new colours, or to those that represent them best in half of the free room. A changed palette costs a whole
 * new picture in the file, so a few stray pixels do not change it. */
static bool palette_extend(struct bead_palette *palette, const struct bead_frame *frame)
{
    uint64_t pixels = 0, enough = (uint64_t)frame->width * (uint64_t)frame->height / RARE_SHARE;
    for (size_t i = 0; i < palette->missed_count; i++)
        pixels += palette->missed[i].count;
    if (!pixels || (pixels < enough && palette->used >= EXACT_BELOW))
        return false;
    size_t most = (BEAD_PALETTE_MOST - palette->used + 1) / 2;
    uint32_t chosen[BEAD_PALETTE_MOST];
    size_t count = bead_palette_cut(palette->missed, palette->missed_count, most, chosen);
    for (size_t i = 0; i < count; i++) {
        int least;
        nearest(palette, chosen[i], &least);
        if (least > tolerance(palette))
            append(palette, chosen[i]);
    }
    return true;
}

static void write_colours(const struct bead_palette *palette, AVFrame *picture)
{
    uint32_t argb[256] = {0};
    /* Unused places are opaque, so that encoders take only the last one, which is never used, as transparent. */
    for (size_t i = 0; i < BEAD_PALETTE_MOST; i++)
        argb[i] = 0xff000000u | (i < palette->used ? palette->colour[i] : 0);
    memcpy(picture->data[1], argb, sizeof argb);
}

enum bead_error bead_palette_convert(struct bead_palette *palette, const struct bead_frame *frame, const struct bead_changes *rects,
                                     AVFrame *picture, struct bead_message *msg)
{
    enum bead_error err = palette->used ? BEAD_OK : palette_choose(palette, frame, rects, msg);
    if (err)
        return err;
    palette->missed_count = 0;
    palette_convert(palette, frame, rects, picture);
    if (palette->missed_count && palette_extend(palette, frame))
        palette_convert(palette, frame, rects, picture);
    write_colours(palette, picture);
    return BEAD_OK;
}
