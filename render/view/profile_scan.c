/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The curve of the profile view, column by column: exact coverage of the line and of the area below it. */
#include "render/view/profile_scan.h"

#include <math.h>

#include "render/paint/pixel_kernels.h"

/* Each column is cut into slices, which give steep parts soft edges; at most MOST_TAPS for half the width of the pen. */
enum { SLICES = BEAD_SLICES, MOST_TAPS = 64 };

/* Lowest and highest y of the curve in a slice; empty beyond the ends of the curve. */
struct extent {
    float low, high;
};

static const struct extent nothing = {INFINITY, -INFINITY};

/* Written as expressions: fminf and fmaxf check for NaN, which cannot occur here. */
static inline float least(float a, float b)
{
    return a < b ? a : b;
}

static inline float most(float a, float b)
{
    return a > b ? a : b;
}

static inline void curve_widen(struct extent *e, float y)
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

/* The curve's extent in a slice. `segment`, at or before its start, advances to the segment of the start. */
static struct extent slice(const struct bead_curve *c, size_t *segment, float from, float to)
{
    struct extent e = nothing;
    from = most(from, c->x[0]);
    to = least(to, c->x[c->count - 1]);
    if (from > to)
        return e;
    while (*segment + 2 < c->count && c->x[*segment + 1] <= from)
        ++*segment;
    curve_widen(&e, y_at(c, *segment, from));
    size_t s = *segment;
    while (s + 2 < c->count && c->x[s + 1] < to)
        curve_widen(&e, c->y[++s]);
    curve_widen(&e, y_at(c, s, to));
    return e;
}

/* Half the height of a disc as wide as the line, at each slice's distance from its centre. */
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

/* The pen's round ends are part of a dash: dashes are shorter by its width, gaps longer. */
static float dash_length(const struct bead_curve *c, int part)
{
    static const float least_on = 0.2f;
    const float length = (float)c->dashes->lengths[part];
    return c->width * (part % 2 ? length + 1 : most(least_on, length - 1));
}

static float pattern_length(const struct bead_curve *c)
{
    float length = 0;
    for (int part = 0; c->dashes && part < c->dashes->count; part++)
        length += dash_length(c, part);
    return length;
}

int bead_curve_reach(const struct bead_curve *curve)
{
    return (int)ceilf(0.5f * curve->width + pattern_length(curve)) + 2;
}

/* The part of each slice that the pen covers as it follows the curve. */
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

static void curve_keep(struct bead_extents *extents, int slice, int x, const struct extent *e)
{
    extents->low[slice][x] = e->low;
    extents->high[slice][x] = e->high;
}

/* Line and area of a column; returns the rows that they touch. */
static struct extent make_column(const struct bead_curve *c, const struct extent *curve, const struct pen *pen,
                                 struct bead_columns *k, int x)
{
    struct extent rows = nothing;
    for (int s = 0; s < SLICES; s++) {
        struct extent line = stroke(curve + s, pen), area = nothing;
        if (curve[s].low <= curve[s].high) { /* else at most the round end of the line */
            float middle = 0.5f * (curve[s].low + curve[s].high);
            area = (struct extent){least(middle, c->base), most(middle, c->base)};
            curve_widen(&rows, c->base);
        }
        rows.low = least(rows.low, line.low);
        rows.high = most(rows.high, line.high);
        curve_keep(&k->line, s, x, &line);
        curve_keep(&k->area, s, x, &area);
    }
    return rows;
}

static void set_rows(struct bead_columns *k, int group, const struct extent *rows, int height)
{
    const float low = most(0, least(rows->low, (float)height)), high = most(0, least(rows->high, (float)height));
    k->from[group] = (int)floorf(low);
    k->to[group] = low > high ? k->from[group] : (int)ceilf(high);
}

static void set_colours(const struct bead_curve *c, const struct bead_frame *frame, struct bead_columns *k)
{
    const double line[4] = {c->line.b, c->line.g, c->line.r, 1}, area[4] = {c->area.b, c->area.g, c->area.r, 1};
    k->channels = frame->alpha ? 4 : 3;
    for (int i = 0; i < 4; i++) {
        k->over[i] = 255 * (float)line[i];
        k->under[i] = 255 * (float)area[i];
    }
    k->area_alpha = (float)c->area_alpha;
}

/* Slices are computed for a block of columns, plus the reach of the pen on both sides. */
enum { BLOCK = BEAD_COLUMNS, GROUP = BEAD_COLUMN_GROUP, ROOM = (BLOCK * SLICES + 2 * MOST_TAPS) };

/* Columns from..to of the BLOCK from `begin` on. */
static void make_columns(const struct bead_curve *curve, const struct pen *pen, int begin, int from, int to, int height,
                         struct bead_columns *k)
{
    struct extent around[ROOM], rows = nothing;
    const int first = begin * SLICES - MOST_TAPS;
    const int low = (from - begin) * SLICES + MOST_TAPS - pen->taps, high = (to - begin) * SLICES + MOST_TAPS + pen->taps;
    size_t segment = find_segment(curve, (float)(first + low) / SLICES);
    for (int i = low; i < high; i++)
        around[i] = slice(curve, &segment, (float)(first + i) / SLICES, (float)(first + i + 1) / SLICES);
    for (int x = 0; x < BLOCK; x++) {
        struct extent own = nothing;
        if (begin + x >= from && begin + x < to)
            own = make_column(curve, around + x * SLICES + MOST_TAPS, pen, k, x);
        for (int s = 0; s < SLICES && !(begin + x >= from && begin + x < to); s++) {
            curve_keep(&k->line, s, x, &nothing);
            curve_keep(&k->area, s, x, &nothing);
        }
        rows = (struct extent){least(rows.low, own.low), most(rows.high, own.high)};
        if (x % GROUP == GROUP - 1) {
            set_rows(k, x / GROUP, &rows, height);
            rows = nothing;
        }
    }
}

static void draw_whole(const struct bead_curve *curve, struct bead_rect rect, int from, int to, struct bead_frame *frame)
{
    const struct bead_pixel_kernels *kernels = bead_pixel_kernels_find(NULL);
    struct bead_columns columns;
    struct pen pen;
    make_pen(curve, &pen);
    set_colours(curve, frame, &columns);
    const int offset = (rect.x + from) % GROUP; /* no vector extends into another row */
    for (int begin = from - offset; begin < to; begin += BLOCK) {
        make_columns(curve, &pen, begin, begin < from ? from : begin, begin + BLOCK < to ? begin + BLOCK : to, rect.height,
                     &columns);
        kernels->curve(&columns, frame->pixels + (size_t)rect.y * frame->stride + 4 * (ptrdiff_t)(rect.x + begin), frame->stride);
    }
}

/* A dash as it grows, and where it is drawn. */
enum { DASH_POINTS = 64 };
struct dash {
    float x[DASH_POINTS], y[DASH_POINTS];
    struct bead_curve curve;
    struct bead_rect rect;
    int from, to;
    struct bead_frame *frame;
};

static void end_dash(struct dash *d)
{
    const int reach = bead_curve_reach(&d->curve);
    if (d->curve.count > 1) {
        const int left = (int)floorf(d->x[0]) - reach, right = (int)ceilf(d->x[d->curve.count - 1]) + reach;
        const int from = left > d->from ? left : d->from, to = right < d->to ? right : d->to;
        if (from < to)
            draw_whole(&d->curve, d->rect, from, to, d->frame);
    }
    d->curve.count = 0;
}

static void add_point(struct dash *d, float x, float y)
{
    if (d->curve.count == DASH_POINTS) {
        end_dash(d);
        d->x[0] = d->x[DASH_POINTS - 1];
        d->y[0] = d->y[DASH_POINTS - 1];
        d->curve.count = 1;
    }
    d->x[d->curve.count] = x;
    d->y[d->curve.count++] = y;
}

/* What of segment `i` lies between two x. */
struct piece {
    float x, y, dx, dy, length;
};

static bool cut(const struct bead_curve *c, size_t i, const float ends[2], struct piece *p)
{
    const float from = most(c->x[i - 1], ends[0]), to = least(c->x[i], ends[1]);
    const float slope = (c->y[i] - c->y[i - 1]) / (c->x[i] - c->x[i - 1]);
    if (!(from < to))
        return false;
    *p = (struct piece){.x = from, .y = c->y[i - 1] + slope * (from - c->x[i - 1]), .dx = to - from, .dy = slope * (to - from)};
    p->length = sqrtf(p->dx * p->dx + p->dy * p->dy);
    return true;
}

/* Whole patterns between two x, from segment `i` on. Where the curve itself ends there, patterns are not stretched. */
static void draw_patterns(const struct bead_curve *c, size_t i, const float ends[2], struct dash *d)
{
    struct piece p;
    float all = 0, stretch = 1, left;
    int part = 0;
    for (size_t k = i; k < c->count && c->x[k - 1] < ends[1]; k++)
        all += cut(c, k, ends, &p) ? p.length : 0;
    if (c->x[0] <= ends[0] && c->x[c->count - 1] >= ends[1])
        stretch = all / (pattern_length(c) * roundf(all / pattern_length(c))); /* one at least: strips are that wide */
    left = stretch * dash_length(c, 0);
    for (; i < c->count && c->x[i - 1] < ends[1]; i++) {
        if (!cut(c, i, ends, &p))
            continue;
        if (part % 2 == 0 && d->curve.count == 0)
            add_point(d, p.x, p.y);
        float at = 0;
        for (; p.length - at > left; left = stretch * dash_length(c, part)) {
            at += left;
            add_point(d, p.x + p.dx * (at / p.length), p.y + p.dy * (at / p.length));
            if (part % 2 == 0)
                end_dash(d);
            part = (part + 1) % c->dashes->count;
        }
        left -= p.length - at;
        if (part % 2 == 0)
            add_point(d, p.x + p.dx, p.y + p.dy);
    }
    if (part % 2 == 0)
        end_dash(d);
    d->curve.count = 0;
}

/* Patterns fill strips of the plot that are as wide as one of them, or several where the curve is steep: dashes counted from the
 * curve's beginning would all move whenever a part of it changed. */
static void draw_dashes(const struct bead_curve *c, struct bead_rect rect, int from, int to, struct bead_frame *frame)
{
    struct dash d = {.curve = *c, .rect = rect, .from = from, .to = to, .frame = frame};
    const float width = pattern_length(c), first = most(c->x[0], (float)from - c->width);
    size_t i = 1;
    d.curve.x = d.x;
    d.curve.y = d.y;
    d.curve.area_alpha = 0;
    d.curve.dashes = NULL;
    d.curve.count = 0;
    for (float k = floorf((first - c->start) / width);; k++) {
        const float ends[2] = {c->start + k * width, c->start + (k + 1) * width};
        if (ends[0] >= c->x[c->count - 1] || ends[0] >= (float)to + c->width)
            return;
        while (i + 1 < c->count && c->x[i] <= ends[0])
            i++;
        draw_patterns(c, i, ends, &d);
    }
}

void bead_curve_draw(const struct bead_curve *curve, struct bead_rect rect, int from, int to, struct bead_frame *frame,
                     const struct bead_frame *background)
{
    if (curve->count < 2)
        return;
    if (background)
        bead_frame_copy(frame, background, (struct bead_rect){rect.x + from, rect.y, to - from, rect.height});
    if (curve->dashes && curve->dashes->count > 0)
        draw_dashes(curve, rect, from, to, frame);
    else
        draw_whole(curve, rect, from, to, frame);
}

/* One disc with a soft edge. */
static void draw_dot(const double bgra[4], float x, float y, float r, struct bead_rect rect, int from, int to,
                     struct bead_frame *frame)
{
    int left = (int)floorf(x - r - 1), right = (int)ceilf(x + r + 1), top = (int)floorf(y - r - 1), bottom = (int)ceilf(y + r + 1);
    left = left < from ? from : left, right = right > to ? to : right;
    top = top < 0 ? 0 : top, bottom = bottom > rect.height ? rect.height : bottom;
    for (int py = top; py < bottom; py++) {
        uint8_t *row = frame->pixels + (size_t)(rect.y + py) * frame->stride + 4 * (ptrdiff_t)rect.x;
        for (int px = left; px < right; px++) {
            float dx = (float)px + 0.5f - x, dy = (float)py + 0.5f - y, cover = r + 0.5f - sqrtf(dx * dx + dy * dy);
            cover = most(0, least(cover, 1));
            for (int c = 0; c < 4; c++)
                row[4 * px + c] = (uint8_t)lrintf((float)row[4 * px + c] + cover * (float)(255 * bgra[c] - row[4 * px + c]));
        }
    }
}

void bead_curve_dots(const struct bead_curve *curve, float r, struct bead_rect rect, int from, int to, struct bead_frame *frame)
{
    const double bgra[4] = {curve->line.b, curve->line.g, curve->line.r, 1};
    for (size_t i = 0; i < curve->count; i++) {
        if (curve->x[i] + r + 1 > (float)from && curve->x[i] - r - 1 < (float)to)
            draw_dot(bgra, curve->x[i], curve->y[i], r, rect, from, to, frame);
    }
}
