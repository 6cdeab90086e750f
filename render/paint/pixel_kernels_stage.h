/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: the stage, row by row in linear light: floor, wall, images in the floor, beads, picture. */

typedef float eight __attribute__((vector_size(32), may_alias));
typedef float eight_anywhere __attribute__((vector_size(32), aligned(4), may_alias));

static inline reals load(const float *p)
{
    return *(const reals_anywhere *)p;
}

/* ---- the floor: a grid ---- */

static inline float *grid_row(const struct bead_stage *s, int row, int channel)
{
    return s->grid + ((size_t)row * BEAD_STAGE_CHANNELS + (size_t)channel) * (size_t)s->grid_width;
}

/* Points of the grid from x - reach to x + reach, in blocks of 16, so that all sets compute the same. */
static struct run grid_run(const struct bead_stage *s, float x, float reach)
{
    const float from = most((x - reach) / (16 * BEAD_STAGE_CELL), 0), to = (x + reach) / (16 * BEAD_STAGE_CELL) + 1;
    const int first = 16 * (int)least(from, (float)s->grid_width), end = 16 * (int)least(most(to, 0), (float)s->grid_width);
    return (struct run){first, end < s->grid_width ? end : s->grid_width};
}

/* x of points of the grid, from x0, in units of the largest radius. */
static inline reals grid_x(const struct bead_stage *s, int i, float x0)
{
    return ((float)i * BEAD_STAGE_CELL - x0 + (reals){COUNT} * (float)BEAD_STAGE_CELL) / s->unit;
}

/* The parts of the light from above and of the lamp's that a bead hides; `depth` of the floor behind its foot, `dark`: how far the
 * row is on the floor. */
static void shade_floor(const struct bead_stage *s, const struct bead_stage_bead *b, float depth, float dark, float *keep)
{
    const float r = b->r / s->unit, z = depth - 0.65f * r;
    const struct run run = grid_run(s, b->x, 4 * b->r);
    for (int i = run.first; i < run.end; i += LANES) {
        const reals x = grid_x(s, i, b->x), sx = x - 0.53f * r, l = r * r / (x * x + (r * r + depth * depth));
        const reals shadow = LARGER(1 - (sx * sx + z * z) * (1 / (4.8f * r * r)), all(0));
        const reals left = (1 - s->theme->shade * l * ROOT_OF(l)) * (1 - 0.45f * shadow * shadow);
        *(reals_anywhere *)(keep + i) = load(keep + i) * (1 - dark * (1 - left));
    }
}

/* A contact's light on the floor and in the air around it. */
static void light_floor(const struct bead_stage *s, const struct bead_stage_bead *b, float up, float depth, float ground, int row)
{
    const float x0 = b->x + b->r, above = up - (b->r / s->unit - 1) * BEAD_STAGE_COSINE;
    const struct run run = grid_run(s, x0, 9 * s->unit);
    for (int i = run.first; i < run.end; i += LANES) {
        const reals x = grid_x(s, i, x0), square = x * x, v = square + above * above;
        const reals wide = LARGER(1 - square * (1 / 81.0f), all(0)), close = LARGER(1 - v * (1 / 1.6f), all(0));
        const reals part =
            wide * wide * load(grid_row(s, row, 0) + i) * (s->theme->ground_light * ground) / (square + (1 + depth * depth)) +
            close * close * s->theme->halo / (v + 0.03f);
        for (int c = 0; c < 3; c++) {
            float *to = grid_row(s, row, 1 + c) + i;
            *(reals_anywhere *)to = load(to) + part * b->light[1][c];
        }
    }
}

static inline float smooth_part(float a, float b, float x)
{
    const float t = least(most((x - a) / (b - a), 0), 1);
    return t * t * (3 - 2 * t);
}

static void stage_floor(const struct bead_stage *s)
{
    for (int row = 0; row < s->grid_rows; row++) {
        const float up = bead_stage_up(s, (float)(row * BEAD_STAGE_STEP) + 0.5f);
        const float depth = (up + BEAD_STAGE_COSINE) / BEAD_STAGE_SINE;
        const float ground = smooth_part(0.25f, -0.55f, up), dark = smooth_part(0.9f, -0.3f, up);
        for (int i = 0; i < s->grid_width; i++)
            grid_row(s, row, 0)[i] = 1;
        memset(grid_row(s, row, 1), 0, 3 * (size_t)s->grid_width * sizeof(float));
        for (size_t i = 0; dark > 0 && i < s->count; i++)
            shade_floor(s, &s->beads[i], depth, dark, grid_row(s, row, 0));
        for (size_t i = 0; i < s->count; i++) {
            if (s->beads[i].light[1][0] > 0.004f)
                light_floor(s, &s->beads[i], up, depth, ground, row);
        }
    }
}

/* The floor in a row of pixels: first its light at the points of the grid, then between them. */
static void spread_floor(const struct bead_stage *s, int y)
{
    const float part = (float)(y % BEAD_STAGE_STEP) / BEAD_STAGE_STEP;
    const eight across = ((eight){0, 1, 2, 3, 4, 5, 6, 7} + 0.5f) / 8;
    const int row = y / BEAD_STAGE_STEP;
    float base[3];
    bead_stage_base(s, (float)y + 0.5f, base);
    for (int c = 0; c < 3; c++) {
        float *points = s->row + 3 * (size_t)s->row_width, *to = s->row + (size_t)c * (size_t)s->row_width;
        for (int i = 0; i < s->grid_width; i += LANES) {
            const reals own = load(grid_row(s, row, 0) + i), sent = load(grid_row(s, row, 1 + c) + i);
            const reals next = load(grid_row(s, row + 1, 0) + i), next_sent = load(grid_row(s, row + 1, 1 + c) + i);
            *(reals_anywhere *)(points + i) = base[c] * (own + part * (next - own)) + (sent + part * (next_sent - sent));
        }
        for (int i = 0; i * BEAD_STAGE_CELL < s->width; i++)
            *(eight_anywhere *)(to + i * BEAD_STAGE_CELL) = points[i] + across * (points[i + 1] - points[i]);
    }
}

/* ---- wall ---- */

/* From its upper edge to the floor, and its image there, which fades like those of beads. */
static void stage_wall(const struct bead_stage *s, int y)
{
    const struct bead_stage_wall *w = &s->wall;
    const bool image = (float)y + 0.5f > bead_stage_foot(s);
    const float seen = bead_stage_up(s, (float)y + 0.5f), up = image ? -2 * BEAD_STAGE_COSINE - seen : seen;
    const float high = up + BEAD_STAGE_COSINE, fade = image ? s->theme->mirror / (1 + high * (0.85f + 0.5f * high)) : 1;
    if (w->width <= 0 || up > 1.2f)
        return;
    const int end = (int)least(w->x + w->width, (float)s->width);
    for (int x = pixel_from(w->x, 0, s->width); x < end; x++) {
        const float d = most(((float)x + 0.5f - w->x) / s->unit, 0), fall = least(most(1 - 0.8f * d, 0), 1);
        const float close = 0.10f * fall * fall / (0.10f + d * d * 4 + up * up);
        const float face = 0.5f + 0.5f * smooth_part(-1, 1.3f, up) + 0.8f * smooth_part(0.03f, 0, d);
        for (int c = 0; c < 3; c++) {
            float *to = &s->row[(size_t)c * (size_t)s->row_width + (size_t)x];
            *to = (image ? *to : 0) + fade * (face * w->colour[c] + close * w->light[c]);
        }
    }
}

/* ---- beads ---- */

struct stage_ways {
    bool shift, mixed, lit, tilted, mirror;
};

static inline reals cap_of(reals c)
{
    reals k = c * 0.5f + 0.5f;
    k *= k;
    k *= k;
    reals spot = k * k;
    spot *= spot;
    return 0.74f * k + 0.50f * spot * spot;
}

/* Light of contacts that are not level. */
static inline void tilted_light(const struct bead_stage_bead *b, int x, reals rise, reals glow[3])
{
    const reals c = SMALLER(LARGER((middles(x) - b->x) / b->r, all(-1)), all(1));
    for (int side = 0; side < 2; side++) {
        const float level = sqrtf(most(1 - b->tilt[side] * b->tilt[side], 0));
        const reals part = cap_of(SMALLER(LARGER(c * (side ? level : -level) + rise * b->tilt[side], all(-1)), all(1)));
        for (int k = 0; k < 3; k++)
            glow[k] += part * (b->light[side][k] * b->tint[k]);
    }
}

/* The value of a plane if the bead is `part` of a pixel further right than its picture. */
static inline reals plane_at(const float *p, bool shift, float part)
{
    const reals here = load(p);
    return shift ? here + part * (load(p - 1) - here) : here;
}

/* Row y of one of a bead's pictures, over columns first..end - 1. */
static inline __attribute__((always_inline)) void stage_span(const struct bead_stage *s, const struct bead_stage_bead *b, int y,
                                                             struct run run, struct stage_ways ways)
{
    const enum bead_stage_picture picture = ways.mirror ? BEAD_STAGE_MIRROR : BEAD_STAGE_BESIDE;
    const float *row = bead_stage_row(b->bake, picture, y, 0),
                *alone = ways.mixed ? bead_stage_row(b->bake, BEAD_STAGE_ALONE, y, 0) : row;
    const int span = b->bake->wide + 2 * BEAD_STAGE_PAD, columns = bead_stage_columns(b->bake);
    const reals whole = all(1);
    for (int x = run.first; x < run.end; x += LANES) {
        const int i = x - b->left;
        const ints lane = {COUNT}, inside = lane < run.end - x;
        reals glow[3], form = whole, keep = whole;
        for (int k = 0; ways.lit && k < 3; k++)
            glow[k] = load(b->columns + k * columns + i);
        if (ways.lit)
            form = plane_at(row + BEAD_STAGE_FORM * span + i, ways.shift, b->part);
        if (ways.tilted)
            tilted_light(b, x, plane_at(row + BEAD_STAGE_RISE * span + i, ways.shift, b->part), glow);
        if (!ways.mirror)
            keep -= plane_at(row + BEAD_STAGE_COVER * span + i, ways.shift, b->part);
        for (int k = 0; k < 3; k++) {
            reals value = plane_at(row + k * span + i, ways.shift, b->part);
            if (ways.mixed) {
                const reals other = plane_at(alone + k * span + i, ways.shift, b->part);
                value = other + load(b->columns + 3 * columns + i) * (value - other);
            }
            if (ways.lit)
                value += form * glow[k];
            float *to = s->row + (size_t)k * (size_t)s->row_width + x;
            const reals was = load(to), now = (ways.mirror ? was : was * keep) + value;
            *(reals_anywhere *)to = (reals)(((ints)now & inside) | ((ints)was & ~inside));
        }
    }
}

/* Columns of a bead between its contacts, `high` pixels above the floor, or below it for its image. */
static struct run stage_run(const struct bead_stage *s, const struct bead_stage_bead *b, float high)
{
    const int from = b->left > 0 ? b->left : 0, wide = b->left + b->bake->wide + 1, to = wide < s->width ? wide : s->width;
    if (to <= from)
        return (struct run){0, 0};
    return (struct run){pixel_from(b->edge[0] + high * b->slope[0], from, to),
                        pixel_from(b->edge[1] + high * b->slope[1], from, to)};
}

static void stage_bead(const struct bead_stage *s, const struct bead_stage_bead *b, int y)
{
    const struct run run = stage_run(s, b, fabsf(bead_stage_foot(s) - ((float)y + 0.5f)));
    const bool shift = b->part > 0;
    if (y >= b->mirror_top && y < b->mirror_top + b->bake->high) {
        if (b->lit)
            stage_span(s, b, y - b->mirror_top, run, (struct stage_ways){shift, false, true, b->tilted, true});
        else
            stage_span(s, b, y - b->mirror_top, run, (struct stage_ways){shift, false, false, false, true});
    }
    if (y < b->top || y >= b->top + b->bake->high)
        return;
    if (b->mixed || b->tilted)
        stage_span(s, b, y - b->top, run, (struct stage_ways){true, b->mixed, true, b->tilted, false});
    else if (shift)
        stage_span(s, b, y - b->top, run, (struct stage_ways){true, false, true, false, false});
    else if (b->lit)
        stage_span(s, b, y - b->top, run, (struct stage_ways){false, false, true, false, false});
    else
        stage_span(s, b, y - b->top, run, (struct stage_ways){false, false, false, false, false});
}

/* ---- picture ---- */

/* 1 / sqrt(x) within 7e-4, by a guess from its logarithm and one Newton step; constants: J. Kadlec, 2010. */
static inline reals inverse_root(reals x)
{
    const reals guess = (reals)(0x5f1ffff9 - ((ints)x >> 1));
    return 0.703952253f * guess * (2.38924456f - x * guess * guess);
}

/* Levels within which a pixel's value is rounded, 1/64 steps in an order that spreads them over 8 x 8 pixels. */
static inline int dither_order(int x, int y)
{
    const int d = x ^ y;
    return (d & 1) << 5 | (y & 1) << 4 | (d & 2) << 2 | (y & 2) << 1 | (d & 4) >> 1 | (y & 4) >> 2;
}

static void stage_picture(const struct bead_stage *s, const struct bead_ground *g, int y)
{
    float dither[8 + LANES];
    for (int x = 0; x < 8 + LANES; x++)
        dither[x] = ((float)dither_order(x & 7, y & 7) + 0.5f) * (0.98f / 64);
    const int end = g->clip.x + g->clip.width;
    for (int x = g->clip.x; x < end; x += LANES) {
        words level[3];
        for (int c = 0; c < 3; c++) {
            const reals t = load(s->row + (size_t)c * (size_t)s->row_width + x) * BEAD_STAGE_TONE + 1e-12f;
            const reals u = t * inverse_root(t * t + 1.0f);
            const reals value = u * inverse_root(u) * 255.0f + load(dither + (x & 7));
            level[c] = (words) __builtin_convertvector(SMALLER(value, all(255)), ints);
        }
        const words pixels = level[2] | level[1] << 8 | level[0] << 16 | 0xff000000u;
        if (end - x >= LANES)
            *pixels_at(g, x, y) = pixels;
        else
            memcpy(pixels_at(g, x, y), &pixels, 4 * (size_t)(end - x));
    }
}

/* A row of the stage's own pixels, in linear light. */
static void stage_light(const struct bead_stage *s, int y)
{
    spread_floor(s, y);
    stage_wall(s, y);
    for (size_t i = 0; i < s->count; i++)
        stage_bead(s, &s->beads[i], y);
}

/* The mean of a fine stage's pixels in a row of the picture. */
static void stage_mean(const struct bead_stage *s, int y)
{
    const int fine = s->fine, wide = s->width / fine;
    const size_t all = 3 * (size_t)s->row_width;
    const float part = 1 / (float)(fine * fine);
    float *sum = s->row + all + s->grid_width;
    memset(sum, 0, all * sizeof *sum);
    for (int k = 0; k < fine; k++) {
        stage_light(s, y * fine + k);
        for (size_t i = 0; i < all; i++)
            sum[i] += s->row[i];
    }
    for (int c = 0; c < 3; c++) {
        const float *from = sum + (size_t)c * (size_t)s->row_width;
        float *to = s->row + (size_t)c * (size_t)s->row_width;
        for (int x = 0; x < wide; x++) {
            float all_of_it = 0;
            for (int k = 0; k < fine; k++)
                all_of_it += from[x * fine + k];
            to[x] = part * all_of_it;
        }
    }
}

static void stage_rows(const struct bead_ground *g, const struct bead_stage *s)
{
    for (int y = g->clip.y; y < g->clip.y + g->clip.height; y++) {
        if (s->fine > 1)
            stage_mean(s, y);
        else
            stage_light(s, y);
        stage_picture(s, g, y);
    }
}
