/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: balls like those of assets/shaders/ball.frag, row by row along the chords of the disc. */

/* Values common to all pixels of a ball. */
struct sphere {
    float x, y, r, curvature, left, right;
    float bgr[3];
};

/* Directions of the light, and half-way between it and the eye; y downwards. */
static const float light[3] = {-0.36f, -0.56f, 0.746f}, halfway[3] = {-0.193f, -0.300f, 0.934f};

static inline reals along(const float direction[3], reals nx, float ny, reals nz)
{
    return (nz * direction[2] + ny * direction[1]) + nx * direction[0];
}

/* The light of a lamp that is not a point, as on the stage: it fades out beyond the edge of the shade, where a point would leave a
 * line. */
static inline reals facing(reals cosine)
{
    const reals part = LARGER(cosine * 0.8f + 0.2f, all(0));
    return part * part;
}

/* From squares of distances from the centre to premultiplied levels; cover NULL: 1. */
static inline __attribute__((always_inline)) void shade(const struct sphere *s, reals dx, float dy, reals square,
                                                        const reals *cover, words bgr[3])
{
    reals nx = dx * s->curvature, nz = ROOT_OF(LARGER(1.0f - square * s->curvature * s->curvature, all(0)));
    float ny = dy * s->curvature;
    reals shine = LARGER(along(halfway, nx, ny, nz), all(0.1f)); /* less would be invisible, but slow: its power underflows */
    for (int i = 0; i < 5; i++)
        shine *= shine;
    reals lit = 0.34f + 0.74f * facing(along(light, nx, ny, nz)), gloss = 0.50f * shine;
    for (int c = 0; c < 3; c++) {
        reals own = SMALLER(s->bgr[c] * lit, all(1)), level = own + gloss * (1 - own); /* of the rest up to white */
        bgr[c] = level_of(cover ? level * *cover : level);
    }
}

static inline __attribute__((always_inline)) void paint_inside(const struct sphere *s, int x, float dy, words_anywhere *pixels)
{
    const uint32_t opaque = 0xff000000 - LEVEL_ZERO - (LEVEL_ZERO << 8); /* subtracts the offsets of the levels at once */
    words bgr[3];
    reals dx = middles(x) - s->x;
    shade(s, dx, dy, dx * dx + dy * dy, NULL, bgr);
    *pixels = bgr[0] + (bgr[1] << 8) + (bgr[2] << 16) + opaque;
}

static inline __attribute__((always_inline)) void paint_edge(const struct sphere *s, int x, float dy, struct run run,
                                                             words_anywhere *pixels)
{
    words bgr[3];
    reals px = middles(x), dx = px - s->x, square = dx * dx + dy * dy;
    reals cover = clamp(s->r - ROOT_OF(square) + 0.5f) * clamp(px - s->left + 0.5f) * clamp(s->right - px + 0.5f);
    cover = keep_run(cover, px, run);
    shade(s, dx, dy, square, &cover, bgr);
    blend(pixels, bgr, level_of(cover), false);
}

/* For some rows: the covered pixels, and those certainly covered fully, which are painted faster with the same result. */
enum { ROWS = 64 };
struct chords {
    struct run_lanes {
        ints first, end;
    } some[ROWS / LANES], all[ROWS / LANES];
};

/* Half the chords of a circle at distances from its centre. */
static inline reals half_chords(float r, reals distance)
{
    return ROOT_OF(LARGER((r - distance) * (r + distance), all(0)));
}

static inline struct run_lanes runs_of(reals from, reals to, const struct bead_rect *clip)
{
    const reals low = all((float)clip->x), high = low + (float)clip->width;
    return (struct run_lanes){ceiling(SMALLER(LARGER(from - 0.5f, low), high)), ceiling(SMALLER(LARGER(to - 0.5f, low), high))};
}

static void find_chords(const struct bead_ground *g, const struct sphere *s, struct run rows, struct chords *chords)
{
    const float safe = 0.5f + 0.02f + 4e-6f * s->r;
    for (int i = 0; i < rows.end - rows.first; i += LANES) {
        const reals dy = middles(rows.first + i) - s->y, reach = half_chords(s->r + 0.5f, dy);
        const reals sure = half_chords(s->r > safe ? s->r - safe : 0, dy);
        chords->some[i / LANES] =
            runs_of(LARGER(s->x - reach, all(s->left - 0.5f)), SMALLER(s->x + reach, all(s->right + 0.5f)), &g->clip);
        chords->all[i / LANES] =
            runs_of(LARGER(s->x - sure, all(s->left + safe)), SMALLER(s->x + sure, all(s->right - safe)), &g->clip);
    }
}

static void paint_rows(const struct bead_ground *g, const struct sphere *s, struct run rows)
{
    const int last = last_start(g);
    struct chords chords;
    find_chords(g, s, rows, &chords);
    for (int y = rows.first; y < rows.end; y++) {
        const int row = y - rows.first;
        const struct run_lanes *some = &chords.some[row / LANES], *sure = &chords.all[row / LANES];
        const int end = some->end[row % LANES], from = sure->first[row % LANES], to = sure->end[row % LANES] - LANES;
        const float dy = (float)y + 0.5f - s->y;
        for (int x = some->first[row % LANES]; x < end; x += LANES) {
            if (x >= from && x <= to)
                paint_inside(s, x, dy, pixels_at(g, x, y));
            else
                paint_edge(s, x < last ? x : last, dy, (struct run){x, end}, pixels_at(g, x < last ? x : last, y));
        }
    }
}

static void paint_balls(const struct bead_ground *g, const struct bead_ball *balls, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct bead_ball *b = &balls[i];
        if (!(b->r > 0) || !isfinite(b->x + b->y + b->r + b->left + b->right))
            continue;
        struct sphere s = {.x = b->x, .y = b->y, .r = b->r, .curvature = 1 / b->r, .left = b->left, .right = b->right};
        for (int c = 0; c < 3; c++)
            s.bgr[c] = (float)b->rgba[2 - c] * (1 / 255.0f);
        const struct run rows = run_of(b->y - b->r - 0.5f, b->y + b->r + 0.5f, g->clip.y, g->clip.height);
        for (int y = rows.first; y < rows.end; y += ROWS)
            paint_rows(g, &s, (struct run){y, y + ROWS < rows.end ? y + ROWS : rows.end});
    }
}
