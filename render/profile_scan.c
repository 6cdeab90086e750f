#include "render/profile_scan.h"

#include <math.h>
#include <string.h>

/* Columns are cut into this many slices for soft edges of steep parts. */
enum { SLICES = 4, MOST_TAPS = 64 };

/* Lowest and highest y of the curve in a slice; empty where the curve does not reach. */
struct extent {
    float low, high;
};

static const struct extent nothing = {INFINITY, -INFINITY};

/* As expressions: the library's functions mind NaN, and none comes here. */
static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

static inline void widen(struct extent *e, float y)
{
    e->low = least(e->low, y);
    e->high = most(e->high, y);
}

static float y_at(const struct bead_curve *c, size_t segment, float x)
{
    float span = c->x[segment + 1] - c->x[segment];
    float part = span > 0 ? (x - c->x[segment]) / span : 1;
    part = most(0, least(part, 1));
    return c->y[segment] + part * (c->y[segment + 1] - c->y[segment]);
}

/* The segment that holds x. */
static size_t find_segment(const struct bead_curve *c, float x)
{
    size_t low = 0, high = c->count - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (c->x[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* `segment` is the one that holds the slice's beginning, or one before; moved on. */
static struct extent slice(const struct bead_curve *c, size_t *segment, float from, float to)
{
    struct extent e = nothing;
    from = most(from, c->x[0]);
    to = least(to, c->x[c->count - 1]);
    if (from > to)
        return e;
    while (*segment + 2 < c->count && c->x[*segment + 1] <= from)
        ++*segment;
    widen(&e, y_at(c, *segment, from));
    size_t s = *segment;
    while (s + 2 < c->count && c->x[s + 1] < to)
        widen(&e, c->y[++s]);
    widen(&e, y_at(c, s, to));
    return e;
}

/* Half heights of a disc as wide as the line, at each slice's distance from its middle. */
struct pen {
    float half[MOST_TAPS];
    int taps;
};

static void make_pen(const struct bead_curve *c, struct pen *pen)
{
    float r = 0.5f * c->width;
    pen->taps = (int)fminf(ceilf(r * SLICES), MOST_TAPS);
    for (int i = 0; i < pen->taps; i++) {
        float x = (float)i / SLICES;
        pen->half[i] = sqrtf(fmaxf(0, r * r - x * x));
    }
}

int bead_curve_reach(const struct bead_curve *curve)
{
    return (int)ceilf(0.5f * curve->width) + 2;
}

/* What the pen covers in a slice when it is drawn along the curve. */
static struct extent stroke(const struct extent *around, const struct pen *pen)
{
    struct extent e = nothing;
    for (int i = -pen->taps + 1; i < pen->taps; i++) {
        float half = pen->half[i < 0 ? -i : i];
        e.low = least(e.low, around[i].low - half);
        e.high = most(e.high, around[i].high + half);
    }
    return e;
}

static inline float covered(float y, float low, float high)
{
    return most(0, least(1, least(y + 1, high) - most(y, low)));
}

/* One column's slices: line, and the middle of the curve, from which the area reaches to the base. */
struct column {
    struct extent line[SLICES], area[SLICES];
    int from, to; /* rows that are not plain background or plain area */
};

static struct column make_column(const struct bead_curve *c, const struct extent *curve, const struct pen *pen, int height)
{
    struct column k;
    struct extent rows = nothing;
    for (int s = 0; s < SLICES; s++) {
        k.line[s] = stroke(curve + s, pen);
        k.area[s] = nothing;
        if (curve[s].low > curve[s].high) {
            if (k.line[s].low <= k.line[s].high) { /* the round end of the line */
                widen(&rows, k.line[s].low);
                widen(&rows, k.line[s].high);
            }
            continue;
        }
        float middle = 0.5f * (curve[s].low + curve[s].high);
        k.area[s] = (struct extent){least(middle, c->base), most(middle, c->base)};
        widen(&rows, k.line[s].low);
        widen(&rows, k.line[s].high);
        widen(&rows, c->base);
    }
    rows.low = most(0, least(rows.low, (float)height));
    rows.high = most(0, least(rows.high, (float)height));
    k.from = (int)floorf(rows.low);
    k.to = rows.low > rows.high ? k.from : (int)ceilf(rows.high);
    return k;
}

static inline uint8_t mix(uint8_t behind, float colour, float alpha)
{
    return (uint8_t)((float)behind + alpha * (colour - (float)behind) + 0.5f);
}

/* Line and area are averages over the slices. */
static void paint_column(const struct bead_curve *c, const struct column *k, uint8_t *pixel, size_t stride)
{
    const float over[3] = {255 * (float)c->line.b, 255 * (float)c->line.g, 255 * (float)c->line.r};
    const float under[3] = {255 * (float)c->area.b, 255 * (float)c->area.g, 255 * (float)c->area.r};
    for (int y = k->from; y < k->to; y++) {
        float line = 0, area = 0;
        for (int s = 0; s < SLICES; s++) {
            line += covered((float)y, k->line[s].low, k->line[s].high);
            area += covered((float)y, k->area[s].low, k->area[s].high);
        }
        uint8_t *p = pixel + (size_t)y * stride;
        for (int i = 0; i < 3; i++)
            p[i] = mix(mix(p[i], under[i], (float)c->area_alpha * area / SLICES), over[i], line / SLICES);
    }
}

/* Slices are computed for a block of columns and the pen's reach on both sides. */
enum { BLOCK = 64, ROOM = (BLOCK * SLICES + 2 * MOST_TAPS) };

void bead_curve_draw(const struct bead_curve *curve, struct bead_rect rect, int from, int to, struct bead_frame *frame,
                     const struct bead_frame *background)
{
    struct extent around[ROOM];
    struct pen pen;
    if (curve->count < 2)
        return;
    bead_frame_copy(frame, background, (struct bead_rect){rect.x + from, rect.y, to - from, rect.height});
    make_pen(curve, &pen);
    for (int block = from; block < to; block += BLOCK) {
        int end = block + BLOCK < to ? block + BLOCK : to;
        int first = block * SLICES - MOST_TAPS, count = (end - block) * SLICES + 2 * MOST_TAPS;
        size_t segment = find_segment(curve, (float)first / SLICES);
        for (int i = MOST_TAPS - pen.taps; i < count - MOST_TAPS + pen.taps; i++)
            around[i] = slice(curve, &segment, (float)(first + i) / SLICES, (float)(first + i + 1) / SLICES);
        for (int x = block; x < end; x++) {
            struct column column = make_column(curve, around + (x - block) * SLICES + MOST_TAPS, &pen, rect.height);
            paint_column(curve, &column, frame->pixels + (size_t)rect.y * frame->stride + 4 * (size_t)(rect.x + x), frame->stride);
        }
    }
}
