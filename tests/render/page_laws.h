/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that every page keeps, whatever it shows, in points: texts are on it, none is on another, no line goes through one, numbers
 * along an axis are where its scale says, each with a tick. */
#ifndef BEADREEL_TESTS_PAGE_LAWS_H
#define BEADREEL_TESTS_PAGE_LAWS_H

#include "drawn.h"
#include "tests/numbers.h"

#define assert_page(words, law)                                                                                       \
    do {                                                                                                              \
        if (!(law))                                                                                                   \
            fail_msg("page %zu, '%s' at %g, %g: not %s", (words)->page, (words)->text, (words)->x, (words)->y, #law); \
    } while (0)

static bool is_on_page(size_t stroke, size_t page)
{
    return strokes.list[stroke].surface == CAIRO_SURFACE_TYPE_PDF && drawn_page[stroke] == page;
}

static bool boxes_meet(const double low[2], const double high[2], const double other_low[2], const double other_high[2])
{
    return low[0] < other_high[0] && other_low[0] < high[0] && low[1] < other_high[1] && other_low[1] < high[1];
}

/* Does the line from a to b touch the box? By Liang and Barsky. */
static bool line_meets(const struct stroke_point *a, const struct stroke_point *b, const double low[2], const double high[2])
{
    const double from[2] = {a->x, a->y}, by[2] = {b->x - a->x, b->y - a->y};
    double begin = 0, end = 1;
    for (int k = 0; k < 2; k++) {
        if (by[k] == 0 && (from[k] <= low[k] || from[k] >= high[k]))
            return false;
        if (by[k] == 0)
            continue;
        double t[2] = {(low[k] - from[k]) / by[k], (high[k] - from[k]) / by[k]};
        begin = fmax(begin, fmin(t[0], t[1])), end = fmin(end, fmax(t[0], t[1]));
    }
    return begin < end;
}

static bool stroke_meets(const struct stroke *s, const double low[2], const double high[2])
{
    double least[2], most[2];
    for (int k = 0; k < 2; k++)
        least[k] = fmax(low[k], s->clip_low[k]), most[k] = fmin(high[k], s->clip_high[k]);
    if (s->filled || !boxes_meet(s->low, s->high, least, most) || least[0] >= most[0] || least[1] >= most[1])
        return false;
    for (size_t i = 1; i < s->count; i++) {
        if (!s->at[i].begins && line_meets(&s->at[i - 1], &s->at[i], least, most))
            return true;
    }
    return false;
}

/* Texts are on the page, none on another; nothing goes through them. */
static void texts_are_free(const struct drawn *d, double width, double height)
{
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        assert_page(a, a->low[0] >= 0 && a->low[1] >= 0 && a->high[0] <= width && a->high[1] <= height);
        for (size_t j = 0; j < i; j++)
            assert_page(a, a->page != d->text[j].page || !boxes_meet(a->low, a->high, d->text[j].low, d->text[j].high));
        for (size_t j = 0; j < strokes.count; j++)
            assert_page(a, !is_on_page(j, a->page) || !stroke_meets(&strokes.list[j], a->low, a->high));
    }
}

/* Triangles point at something: two sides, at least, are equally long. What ends where it begins is an arc. */
static void triangles_are_even(void)
{
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke_point *p = strokes.list[j].at;
        if (strokes.list[j].filled && strokes.list[j].count == 2 && hypot(p[1].x - p[0].x, p[1].y - p[0].y) < 30)
            fail_msg("from %g, %g to %g, %g there is no area", p[0].x, p[0].y, p[1].x, p[1].y);
        if (!strokes.list[j].filled || strokes.list[j].count != 3)
            continue;
        double side[3], odd = INFINITY;
        for (int k = 0; k < 3; k++)
            side[k] = hypot(p[k].x - p[(k + 1) % 3].x, p[k].y - p[(k + 1) % 3].y);
        for (int k = 0; k < 3; k++)
            odd = fmin(odd, fabs(side[k] - side[(k + 1) % 3]));
        if (side[2] > 0 && (odd > 0.02 || fmin(side[0], side[1]) < 0.5))
            fail_msg("a triangle has sides of %g, %g and %g", side[0], side[1], side[2]);
    }
}

/* ---- numbers along axes ---- */

enum { NUMBERS_MOST = 200 };
static const double usual_gap = 2.6; /* of numbers from ticks, 0.3 of type of 8 pt and what round figures lack */
struct numbers {
    size_t count;
    struct number {
        const struct words *words;
        double value, at;
    } number[NUMBERS_MOST];
};

static int by_place(const void *a, const void *b)
{
    const double x = ((const struct number *)a)->at, y = ((const struct number *)b)->at;
    return (x > y) - (x < y);
}

/* How far a number is from its place between the first and the last on such a scale. */
static double off_scale(const struct number *n, size_t count, int scale)
{
    const double first = scaled(n[0].value, scale), last = scaled(n[count - 1].value, scale);
    double off = isfinite(first) && isfinite(last) ? 0 : INFINITY;
    for (size_t i = 1; i + 1 < count && off < INFINITY; i++)
        off =
            fmax(off, fabs(n[0].at + (scaled(n[i].value, scale) - first) / (last - first) * (n[count - 1].at - n[0].at) - n[i].at));
    return off;
}

/* How far a number is from the end of its tick, the nearest short line that points at its middle; INFINITY: it has none. */
static double tick_gap(const struct number *n, int along)
{
    enum { LONGEST = 8 };
    double gap = INFINITY;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        for (size_t k = 1; !s->filled && is_on_page(j, n->words->page) && k < s->count; k++) {
            const double from[2] = {s->at[k - 1].x, s->at[k - 1].y}, to[2] = {s->at[k].x, s->at[k].y};
            const double begin = fmin(from[!along], to[!along]), end = fmax(from[!along], to[!along]);
            if (!s->at[k].begins && from[along] == to[along] && end - begin < LONGEST && fabs(from[along] - n->at) < 0.25)
                gap = fmin(gap, fmax(begin - n->words->high[!along], n->words->low[!along] - end));
        }
    }
    return gap;
}

static void numbers_are_in_place(const struct number *n, size_t count, int along)
{
    double off = INFINITY;
    for (int scale = 0; scale < SCALES; scale++)
        off = fmin(off, off_scale(n, count, scale));
    assert_page(n->words, off < 0.15);
    for (size_t i = 0; i < count; i++)
        assert_page(n[i].words,
                    fabs(tick_gap(&n[i], along) - usual_gap) < 0.9); /* digits differ so much in how they fill their widths */
}

/* Those in a line with the first; along[k] is the axis. */
static void axes_have_scales(const struct drawn *d, size_t page, int along)
{
    bool done[WORDS_MOST] = {false};
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        struct numbers line = {0};
        if (a->page != page || done[i] || isnan(number_of(a->text)))
            continue;
        for (size_t j = i; j < d->texts; j++) {
            const struct words *b = &d->text[j];
            bool level = along == 0 ? fabs(b->centre[1] - a->centre[1]) < 0.01
                                    : fabs(2 * b->centre[0] - b->x - (2 * a->centre[0] - a->x)) < 0.01 || fabs(b->x - a->x) < 0.01;
            if (b->page == page && level && !isnan(number_of(b->text)) && line.count < NUMBERS_MOST)
                line.number[line.count++] =
                    (struct number){b, number_of(b->text), along ? (b->low[1] + b->high[1]) / 2 : b->centre[0]},
                done[j] = true;
        }
        qsort(line.number, line.count, sizeof *line.number, by_place);
        for (size_t from = 0, to; from < line.count; from = to) {
            for (to = from + 1; to < line.count &&
                                (along == 0 ? line.number[to].value > line.number[to - 1].value
                                            : line.number[to].value < line.number[to - 1].value) &&
                                labs(line.number[to].words - line.number[to - 1].words) == 1;)
                to++;
            if (to - from > 2)
                numbers_are_in_place(line.number + from, to - from, along);
        }
    }
}

/* ---- titles of axes ---- */

static bool is_frame(const struct stroke *s)
{
    enum { LEAST = 15 };
    return !s->filled && s->begun == 1 && s->count >= 4 && s->count <= 5 && s->high[0] - s->low[0] > LEAST &&
           s->high[1] - s->low[1] > LEAST;
}

static bool is_beside(const struct stroke *frame, const double place[2], int along)
{
    enum { FARTHEST = 40 };
    const double before = frame->low[!along] - place[!along], after = place[!along] - frame->high[!along];
    return (after > 0 && after < FARTHEST) || (along == 1 && before > 0 && before < FARTHEST);
}

/* The frame that a title of an axis is beside, the one whose middle is nearest; NULL: none. Those that are not upright are below.
 */
static const struct stroke *frame_of(const struct words *title, int along)
{
    const struct stroke *found = NULL;
    double nearest = INFINITY;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        const double *c = title->centre, off = fabs(c[along] - (s->low[along] + s->high[along]) / 2);
        if (is_on_page(j, title->page) && is_frame(s) && s->low[along] < c[along] && c[along] < s->high[along] &&
            is_beside(s, c, along) && off < nearest)
            found = s, nearest = off;
    }
    return found;
}

/* From the ink of a title to that of the nearest number along the same side of the frame; INFINITY: there are none. */
static double title_gap(const struct drawn *d, const struct words *title, const struct stroke *frame, int along)
{
    double gap = INFINITY;
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *n = &d->text[i];
        const double towards = title->low[!along] - n->high[!along], back = n->low[!along] - title->high[!along];
        if (n->page == title->page && !isnan(number_of(n->text)) && n->centre[along] > frame->low[along] - 5 &&
            n->centre[along] < frame->high[along] + 5 && is_beside(frame, n->centre, along))
            gap = fmin(gap, fmax(towards, back));
    }
    return gap;
}

/* The bar of colours on the left of a title; NULL: there is none. */
static const struct stroke *bar_of(const struct words *title)
{
    enum { NARROW = 3, WIDE = 15, HIGH = 30 };
    const struct stroke *found = NULL;
    for (size_t j = 0; j < strokes.count; j++) {
        const struct stroke *s = &strokes.list[j];
        const double width = s->high[0] - s->low[0], off = title->low[0] - s->high[0];
        if (is_on_page(j, title->page) && !s->filled && s->begun == 1 && s->count >= 4 && s->count <= 5 && width > NARROW &&
            width < WIDE && s->high[1] - s->low[1] > HIGH && off > 0 && (!found || off < title->low[0] - found->high[0]))
            found = s;
    }
    return found;
}

/* Titles of axes are in the middle of their frames, those of bars of their bars, as far from their numbers as all; those that are
 * too long for their axis have smaller type, and letters that reach below their lines come nearer. */
static void titles_are_in_place(const struct drawn *d, size_t page)
{
    /* Empirical, pt, read off the pages of these tests: titles below their axes, and beside them. The layout gives lines of type
     * their room; how much of it is ink depends on letters, font and size. */
    static const double gaps[2][2] = {{3.5, 4.3}, {3, 8.5}};
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        const struct stroke *frame = a->upwards || strstr(a->text, " (") ? frame_of(a, a->upwards) : NULL;
        if (!frame || a->page != page)
            continue;
        const double gap = title_gap(d, a, frame, a->upwards);
        const struct stroke *bar = a->upwards && a->low[0] > frame->high[0] ? bar_of(a) : NULL;
        const struct stroke *along = bar ? bar : frame;
        assert_page(a, fabs(2 * a->centre[a->upwards] - along->low[a->upwards] - along->high[a->upwards]) < 0.6);
        assert_page(a, gap == INFINITY || (gap > gaps[a->upwards][0] && gap < gaps[a->upwards][1]));
    }
}

/* ---- panels ---- */

/* Do two frames share most of their height (or width)? */
static bool is_level(const struct stroke *a, const struct stroke *b, int k)
{
    return fmin(a->high[k], b->high[k]) - fmax(a->low[k], b->low[k]) > 0.5 * fmin(a->high[k] - a->low[k], b->high[k] - b->low[k]);
}

static bool is_panel(size_t stroke, size_t page)
{
    enum { LEAST_PANEL = 30 };
    const struct stroke *s = &strokes.list[stroke];
    return is_on_page(stroke, page) && is_frame(s) && fmin(s->high[0] - s->low[0], s->high[1] - s->low[1]) > LEAST_PANEL;
}

/* Panels beside each other begin or end at one height, those below each other at one place across; both do if one is no stack. */
static void frames_are_aligned(size_t page)
{
    for (size_t i = 0; i < strokes.count; i++) {
        for (size_t j = 0; is_panel(i, page) && j < i; j++) {
            const struct stroke *a = &strokes.list[i], *b = &strokes.list[j];
            for (int k = 0; k < 2 && is_panel(j, page); k++) {
                const bool begin = fabs(a->low[k] - b->low[k]) < 0.3, end = fabs(a->high[k] - b->high[k]) < 0.3;
                const double size = (a->high[k] - a->low[k]) / (b->high[k] - b->low[k]);
                if (is_level(a, b, k) && !is_level(a, b, !k) && !(size > 0.6 && size < 1.6 ? begin && end : begin || end))
                    fail_msg("page %zu: panels from %g to %g and from %g to %g are not aligned", page, a->low[k], a->high[k],
                             b->low[k], b->high[k]);
            }
        }
    }
}

/* Axes fill their page: from the left and the lower edge, words are as far as the margin, and what letters lack of their lines.
 * Pages that beads do not fill are left out. */
static inline void margins_are_kept(const struct drawn *d, size_t page, double width, double height)
{
    const double least = 2.5, most = 7.5; /* empirical, pt, read off the pages of these tests: to ink, as above */
    double left = INFINITY, below = INFINITY, right = 0;
    bool axes = false;
    for (size_t i = 0; i < d->texts; i++) {
        const struct words *a = &d->text[i];
        if (a->page != page)
            continue;
        left = fmin(left, a->low[0]), below = fmin(below, height - a->high[1]), right = fmax(right, a->high[0]);
        axes = axes || (a->upwards && frame_of(a, true));
    }
    if (axes && right > 0.8 * width && !(left > least && left < most && below > least && below < most))
        fail_msg("page %zu: words are %g from the left edge, %g from the lower one", page, left, below);
}

/* Of all pages. */
static inline void page_laws_everywhere(const struct drawn *d, double width, double height)
{
    texts_are_free(d, width, height);
    triangles_are_even();
}

/* Of pages whose axes have one scale, from end to end. */
static inline void page_laws_of_axes(const struct drawn *d, size_t page)
{
    titles_are_in_place(d, page);
    frames_are_aligned(page);
    for (int along = 0; along < 2; along++)
        axes_have_scales(d, page, along);
}

static inline void page_laws(const struct drawn *d, double width, double height)
{
    page_laws_everywhere(d, width, height);
    for (size_t p = 0; p < d->pages; p++) {
        page_laws_of_axes(d, p);
        margins_are_kept(d, p, width, height);
    }
}

#endif
