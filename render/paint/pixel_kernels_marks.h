/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included by pixel_kernels_body.h: marks like those of assets/shaders/mark.frag and glow.frag, and the way to a lens. */

/* Cover of the pixels `px` in row `py`, without the mark's own opacity. */
typedef reals mark_cover(const struct bead_mark *m, reals px, float py);
/* Narrow reach[0]..reach[1], at first the whole box, to the part of the row that may be covered. */
typedef void mark_reach(const struct bead_mark *m, float py, float reach[2]);

static inline void whole_box(const struct bead_mark *, float, float[2]) {}

static inline float extent_of(const struct bead_mark *m, int axis)
{
    return 0.5f * (m->box[axis + 2] - m->box[axis]);
}

static inline float middle_of(const struct bead_mark *m, int axis)
{
    return 0.5f * (m->box[axis] + m->box[axis + 2]);
}

/* The part of each pixel between a and b along one axis. */
static inline reals within(reals x, reals a, reals b)
{
    return clamp(SMALLER(x + 0.5f, b) - LARGER(x - 0.5f, a));
}

static inline reals box_cover(const struct bead_mark *m, reals px, float py)
{
    return within(px, all(m->box[0]), all(m->box[2])) * within(all(py), all(m->box[1]), all(m->box[3]));
}

static inline reals hatched_cover(const struct bead_mark *m, reals px, float py)
{
    const float period = m->shape[0];
    reals at = px + py, stripe = at - period * whole_part(at / period);
    return box_cover(m, px, py) *
           (0.35f + 0.65f * clamp(0.5f * period - magnitude(stripe - 0.5f * period) - 0.18f * period + 0.5f));
}

static inline reals ring_cover(const struct bead_mark *m, reals px, float py)
{
    reals dx = px - middle_of(m, 0);
    float dy = py - middle_of(m, 1);
    return clamp(0.5f * m->shape[1] + 0.5f - magnitude(ROOT_OF(dx * dx + dy * dy) - m->shape[0]));
}

static inline reals arrow_cover(const struct bead_mark *m, reals px, float py)
{
    const float wide = extent_of(m, 0), high = extent_of(m, 1);
    reals edge = (high * (m->box[2] - px) / (2.0f * wide) - fabsf(py - middle_of(m, 1))) * 2.0f * wide /
                 sqrtf(4.0f * wide * wide + high * high);
    return clamp(edge + 0.5f) * within(px, all(m->box[0]), all(m->box[2]));
}

static inline reals glow_cover(const struct bead_mark *m, reals px, float py)
{
    reals dx = (px - middle_of(m, 0)) / extent_of(m, 0);
    float dy = (py - middle_of(m, 1)) / extent_of(m, 1);
    reals fall = LARGER(1.0f - (dx * dx + dy * dy), all(0));
    return fall * fall;
}

/* The two lines of a way to a lens in a row: their places, and the factor of distances along the row for their slope. */
struct rails {
    float at[2], steep[2];
};

static inline struct rails rails_of(const struct bead_mark *m, float py)
{
    const float height = m->box[3] - m->box[1], down = least(1, most(0, (py - m->box[1]) / height));
    const float part = down * down * (3.0f - 2.0f * down), slope = 6.0f * down * (1.0f - down) / height;
    struct rails rails;
    for (int side = 0; side < 2; side++) {
        const float way = m->shape[side + 2] - m->shape[side], lean = way * slope;
        rails.at[side] = m->shape[side] + part * way;
        rails.steep[side] = sqrtf(1.0f + lean * lean);
    }
    return rails;
}

static inline void zoom_reach(const struct bead_mark *m, float py, float reach[2])
{
    const struct rails rails = rails_of(m, py);
    const bool top = py < m->box[1] + 3;
    float from = rails.at[0], to = rails.at[0];
    for (int side = 0; side < 2; side++) {
        const float wide = 1.1f * rails.steep[side] + 1, place = top ? m->shape[side] : rails.at[side];
        from = least(from, least(rails.at[side] - wide, place - 1));
        to = most(to, most(rails.at[side] + wide, place + 1));
    }
    reach[0] = from;
    reach[1] = to;
}

static inline reals zoom_cover(const struct bead_mark *m, reals px, float py)
{
    const struct rails rails = rails_of(m, py);
    reals lines = all(0);
    for (int side = 0; side < 2; side++)
        lines = LARGER(lines, clamp(1.1f - magnitude(px - rails.at[side]) * (1 / rails.steep[side])));
    reals top = within(all(py), all(m->box[1]), all(m->box[1] + 2)); /* a line of two pixels */
    reals edges = LARGER(0.6f * lines, top * within(px, all(m->shape[0]), all(m->shape[1])));
    return within(all(py), all(m->box[1]), all(m->box[3])) * LARGER(0.13f * within(px, all(rails.at[0]), all(rails.at[1])), edges);
}

/* `hiding`: opacity of the mark, as a part of its cover. */
static inline __attribute__((always_inline)) void paint_mark(const struct bead_ground *g, const struct bead_mark *m,
                                                             mark_cover *cover_of, mark_reach *reach_of, float hiding)
{
    float bgra[4];
    for (int c = 0; c < 4; c++)
        bgra[c] = (float)m->rgba[c < 3 ? 2 - c : 3] * (1 / 255.0f);
    /* Pixels with centres at most one pixel outside the box. */
    const struct run rows = run_of(m->box[1] - 1, m->box[3] + 1, g->clip.y, g->clip.height);
    const int last = last_start(g);
    for (int y = rows.first; y < rows.end; y++) {
        float reach[2] = {m->box[0] - 1, m->box[2] + 1};
        reach_of(m, (float)y + 0.5f, reach);
        const struct run run = run_of(most(reach[0], m->box[0] - 1), least(reach[1], m->box[2] + 1), g->clip.x, g->clip.width);
        for (int x = run.first; x < run.end; x += LANES) {
            const int at = x < last ? x : last;
            reals px = middles(at), cover = keep_run(cover_of(m, px, (float)y + 0.5f) * bgra[3], px, (struct run){x, run.end});
            words bgr[3];
            for (int c = 0; c < 3; c++)
                bgr[c] = level_of(bgra[c] * cover);
            blend(pixels_at(g, at, y), bgr, level_of(cover * hiding), hiding < 1);
        }
    }
}

#define MARK_FUNCTION(kind, reach, hiding)                                           \
    static void paint_##kind(const struct bead_ground *g, const struct bead_mark *m) \
    {                                                                                \
        paint_mark(g, m, kind##_cover, reach, hiding);                               \
    }
MARK_FUNCTION(box, whole_box, 1)
MARK_FUNCTION(hatched, whole_box, 1)
MARK_FUNCTION(ring, whole_box, 1)
MARK_FUNCTION(arrow, whole_box, 1)
MARK_FUNCTION(glow, whole_box, 0.35f)
MARK_FUNCTION(zoom, zoom_reach, 1)
#undef MARK_FUNCTION

static bool has_area(const struct bead_mark *m)
{
    const float *box = m->box;
    return box[2] > box[0] && box[3] > box[1] && isfinite(box[0] + box[1] + box[2] + box[3]);
}

static void paint_way(const struct bead_ground *g, const struct bead_mark *way)
{
    if (has_area(way))
        paint_zoom(g, way);
}

static void paint_marks(const struct bead_ground *g, const struct bead_mark *marks, size_t count)
{
    static void (*const kinds[])(const struct bead_ground *, const struct bead_mark *) = {[BEAD_MARK_BOX] = paint_box,
                                                                                          [BEAD_MARK_HATCHED] = paint_hatched,
                                                                                          [BEAD_MARK_RING] = paint_ring,
                                                                                          [BEAD_MARK_ARROW] = paint_arrow,
                                                                                          [BEAD_MARK_GLOW] = paint_glow};
    for (size_t i = 0; i < count; i++) {
        if (has_area(&marks[i]))
            kinds[(int)(marks[i].kind + 0.5f)](g, &marks[i]);
    }
}
