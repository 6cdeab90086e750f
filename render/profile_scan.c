#include "render/profile_scan.h"

#include <math.h>
#include <string.h>

/* Columns are cut into this many slices for soft edges of steep parts. */
enum { SLICES = 4, MOST_TAPS = 64 };

/* Lowest and highest y of the curve in a slice; empty where the curve does not reach. */
struct extent {
    float low, high;
};

/* Points are walked along with x: `at` is the segment that holds the slice's beginning. */
static float y_at(const struct bead_curve *c, size_t segment, float x)
{
    float span = c->x[segment + 1] - c->x[segment];
    float part = span > 0 ? (x - c->x[segment]) / span : 1;
    part = part < 0 ? 0 : part > 1 ? 1 : part;
    return c->y[segment] + part * (c->y[segment + 1] - c->y[segment]);
}

static void widen(struct extent *e, float y)
{
    e->low = fminf(e->low, y);
    e->high = fmaxf(e->high, y);
}

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

static struct extent slice(const struct bead_curve *c, float from, float to)
{
    struct extent e = {INFINITY, -INFINITY};
    from = fmaxf(from, c->x[0]);
    to = fminf(to, c->x[c->count - 1]);
    if (from > to)
        return e;
    size_t segment = find_segment(c, from);
    widen(&e, y_at(c, segment, from));
    while (segment + 2 < c->count && c->x[segment + 1] < to)
        widen(&e, c->y[++segment]);
    widen(&e, y_at(c, segment, to));
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
    struct extent e = {INFINITY, -INFINITY};
    for (int i = -pen->taps + 1; i < pen->taps; i++) {
        float half = pen->half[i < 0 ? -i : i];
        e.low = fminf(e.low, around[i].low - half);
        e.high = fmaxf(e.high, around[i].high + half);
    }
    return e;
}

static float covered(float y, float low, float high)
{
    float part = fminf(y + 1, high) - fmaxf(y, low);
    return part < 0 ? 0 : part > 1 ? 1 : part;
}

static uint8_t mix(uint8_t behind, double colour, double alpha)
{
    return (uint8_t)(behind + alpha * (255 * colour - behind) + 0.5);
}

/* One column: line and area are averages over its slices. */
static void draw_column(const struct bead_curve *c, const struct extent *strokes, const struct extent *curve, int x,
                        struct bead_rect rect, struct bead_frame *frame, const struct bead_frame *background)
{
    for (int y = 0; y < rect.height; y++) {
        float line = 0, area = 0;
        for (int s = 0; s < SLICES; s++) {
            if (curve[s].low > curve[s].high)
                continue;
            float middle = 0.5f * (curve[s].low + curve[s].high);
            line += covered((float)y, strokes[s].low, strokes[s].high);
            area += covered((float)y, fminf(middle, c->base), fmaxf(middle, c->base));
        }
        double strong = line / SLICES, weak = c->area_alpha * area / SLICES;
        size_t at = (size_t)(rect.y + y) * frame->stride + 4 * (size_t)(rect.x + x);
        const uint8_t *behind = background->pixels + at;
        uint8_t *pixel = frame->pixels + at;
        const double over[3] = {c->line.b, c->line.g, c->line.r}, under[3] = {c->area.b, c->area.g, c->area.r};
        for (int k = 0; k < 3; k++)
            pixel[k] = mix(mix(behind[k], under[k], weak), over[k], strong);
    }
}

/* Slices are computed for a block of columns and the pen's reach on both sides. */
enum { BLOCK = 64, ROOM = (BLOCK * SLICES + 2 * MOST_TAPS) };

void bead_curve_draw(const struct bead_curve *curve, struct bead_rect rect, int from, int to, struct bead_frame *frame,
                     const struct bead_frame *background)
{
    struct extent around[ROOM], strokes[SLICES];
    struct pen pen;
    if (curve->count < 2)
        return;
    make_pen(curve, &pen);
    for (int block = from; block < to; block += BLOCK) {
        int end = block + BLOCK < to ? block + BLOCK : to;
        int first = block * SLICES - MOST_TAPS, count = (end - block) * SLICES + 2 * MOST_TAPS;
        for (int i = 0; i < count; i++)
            around[i] = slice(curve, (float)(first + i) / SLICES, (float)(first + i + 1) / SLICES);
        for (int x = block; x < end; x++) {
            const struct extent *column = around + (x - block) * SLICES + MOST_TAPS;
            for (int s = 0; s < SLICES; s++)
                strokes[s] = stroke(column + s, &pen);
            draw_column(curve, strokes, column, x, rect, frame, background);
        }
    }
}
