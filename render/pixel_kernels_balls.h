/* Included by pixel_kernels_body.h: assets/shaders/ball.frag, row by row along the chords of the disc. */

/* A ball, as every of its pixels needs it. */
struct sphere {
    float x, y, r, curvature, left, right;
    float bgr[3];
};

/* Directions of light and of its reflection to the eye, y downwards. */
static const float light[3] = {-0.36f, -0.56f, 0.746f}, halfway[3] = {-0.193f, -0.300f, 0.934f};

static inline reals along(const float direction[3], reals nx, float ny, reals nz)
{
    return LARGER((nz * direction[2] + ny * direction[1]) + nx * direction[0], all(0));
}

/* Squares of the distances from the middle to premultiplied levels; cover NULL: all of it. */
static inline __attribute__((always_inline)) void shade(const struct sphere *s, reals dx, float dy, reals square,
                                                        const reals *cover, ints bgr[3])
{
    reals nx = dx * s->curvature, nz = ROOT_OF(LARGER(1.0f - square * s->curvature * s->curvature, all(0)));
    float ny = dy * s->curvature;
    reals shine = along(halfway, nx, ny, nz);
    for (int i = 0; i < 5; i++)
        shine *= shine;
    reals lit = 0.34f + 0.74f * along(light, nx, ny, nz), gloss = 0.30f * shine;
    for (int c = 0; c < 3; c++) {
        reals level = SMALLER(s->bgr[c] * lit + gloss, all(1));
        bgr[c] = level_of(cover ? level * *cover : level);
    }
}

static inline void paint_inside(const struct sphere *s, int x, float dy, ints *pixels)
{
    ints bgr[3];
    reals dx = middles(x) - s->x;
    shade(s, dx, dy, dx * dx + dy * dy, NULL, bgr);
    *pixels = bgr[0] | bgr[1] << 8 | bgr[2] << 16 | (int32_t)0xff000000;
}

static inline void paint_edge(const struct sphere *s, int x, float dy, struct run run, ints *pixels)
{
    ints bgr[3];
    reals px = middles(x), dx = px - s->x, square = dx * dx + dy * dy;
    reals cover = clamp(s->r - ROOT_OF(square) + 0.5f) * clamp(px - s->left + 0.5f) * clamp(s->right - px + 0.5f);
    cover *= within_run(px, run);
    shade(s, dx, dy, square, &cover, bgr);
    blend(pixels, bgr, level_of(cover), false);
}

/* Half the chord of a circle at a distance from its middle. */
static inline float half_chord(float r, float distance)
{
    return r > fabsf(distance) ? sqrtf((r - distance) * (r + distance)) : 0;
}

static void paint_row(const struct bead_ground *g, const struct sphere *s, int y)
{
    const float dy = (float)y + 0.5f - s->y, reach = half_chord(s->r + 0.5f, dy);
    /* Fully covered beyond doubt; that what lies there is painted either way must not show. */
    const float safe = 0.5f + 0.02f + 4e-6f * s->r, sure = half_chord(s->r - safe, dy);
    struct run run = run_of(fmaxf(s->x - reach, s->left - 0.5f), fminf(s->x + reach, s->right + 0.5f), g->clip.x, g->clip.width);
    float from = fmaxf(s->x - sure, s->left + safe), to = fminf(s->x + sure, s->right - safe);
    if (run.end <= run.first)
        return;
    for (int x = vector_start(g, run.first); x < run.end; x += LANES) {
        ints *pixels = vector_at(g, x, y);
        if (x >= run.first && x + LANES <= run.end && (float)x + 0.5f > from && (float)(x + LANES) - 0.5f < to)
            paint_inside(s, x, dy, pixels);
        else
            paint_edge(s, x, dy, run, pixels);
    }
}

static void paint_balls(const struct bead_ground *g, const struct bead_ball *balls, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct bead_ball *b = &balls[i];
        if (!(b->r > 0) || !isfinite(b->x + b->y + b->r))
            continue;
        const struct sphere s = {
            b->x,
            b->y,
            b->r,
            1 / b->r,
            b->left,
            b->right,
            {(float)b->rgba[2] * (1 / 255.0f), (float)b->rgba[1] * (1 / 255.0f), (float)b->rgba[0] * (1 / 255.0f)}};
        struct run rows = run_of(b->y - b->r - 0.5f, b->y + b->r + 0.5f, g->clip.y, g->clip.height);
        for (int y = rows.first; y < rows.end; y++)
            paint_row(g, &s, y);
    }
}
