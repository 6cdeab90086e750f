/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the parts of the row and the lens that must be painted again. If the lens moves by whole pixels, beads at rest only change
 * their places: they are moved in the frame, at a tenth of the cost of painting. */
#include <math.h>
#include <string.h>

#include "render/stage/beads.h"

enum { MERGE_GAP = 16 };

static void add_span(struct bead_spans *spans, double from, double to, const struct bead_rect *limits)
{
    int a = (int)floor(fmax(from, limits->x)), b = (int)ceil(fmin(to, limits->x + limits->width));
    if (b <= a)
        return;
    size_t last = spans->count - 1;
    if (spans->count > 0 && (a <= spans->to[last] + MERGE_GAP || spans->count == BEAD_MOST_SPANS)) {
        spans->from[last] = a < spans->from[last] ? a : spans->from[last];
        spans->to[last] = b > spans->to[last] ? b : spans->to[last];
    } else {
        spans->from[spans->count] = a;
        spans->to[spans->count++] = b;
    }
}

static struct bead_spans everything(const struct bead_rect *limits)
{
    return (struct bead_spans){{limits->x}, {limits->x + limits->width}, 1};
}

static void span_of_ball(struct bead_spans *spans, const struct bead_ball *ball, int by, const struct bead_rect *limits)
{
    add_span(spans, ball->x - by - ball->r - 3, ball->x - by + ball->r + 3, limits);
}

bool bead_beads_lens_is_plain(const struct bead_view *v, const struct bead_frame *background)
{
    const struct bead_rect *r = &v->lens.rect;
    for (int y = 0; y < r->height; y++) {
        const uint8_t *row =
            background->pixels + (size_t)(v->area.y + r->y + y) * background->stride + 4 * (size_t)(v->area.x + r->x);
        if (r->width > 1 && memcmp(row, row + 4, 4 * (size_t)(r->width - 1)) != 0)
            return false;
    }
    return true;
}

int bead_beads_lens_moves(const struct bead_view *v)
{
    double by = (v->lens.from - v->lens_drawn) * v->lens.scale, whole = round(by);
    bool can = v->drawn && v->plain && fabs(by - whole) < 1e-6 && fabs(whole) < v->lens.rect.width;
    return can ? (int)whole : 0;
}

/* Is ball i old ball j moved to the left? Sums of floats are exact here. */
static bool same_ball(const struct bead_drawing *d, size_t i, size_t j, int by)
{
    const struct bead_ball *now = &d->now.balls[i], *old = &d->old.balls[j];
    bool light = d->now.glow[i] == d->old.glow[j] && (i + 1 < d->now.count) == (j + 1 < d->old.count);
    return light && now->y == old->y && now->r == old->r && (double)now->x + by == old->x && (double)now->left + by == old->left &&
           (double)now->right + by == old->right && memcmp(now->rgba, old->rgba, sizeof now->rgba) == 0;
}

/* Adds arrow (at the left) or wall (at the right): the marks that do not belong to a ball. */
static void add_marks(struct bead_spans *spans, const struct bead_mark *marks, size_t count, bool arrow, int by,
                      const struct bead_rect *limits)
{
    for (size_t m = 0; m < count; m++) {
        enum bead_mark_kind kind = (enum bead_mark_kind)marks[m].kind;
        if (kind != BEAD_MARK_RING && kind != BEAD_MARK_GLOW && arrow == (kind == BEAD_MARK_ARROW))
            add_span(spans, marks[m].box[0] - by - 2, marks[m].box[2] - by + 2, limits);
    }
}

static void add_balls(struct bead_spans *spans, const struct bead_drawing *d, int by, const struct bead_rect *limits)
{
    size_t first = d->now.first < d->old.first ? d->now.first : d->old.first;
    size_t end =
        d->now.first + d->now.count > d->old.first + d->old.count ? d->now.first + d->now.count : d->old.first + d->old.count;
    for (size_t bead = first; bead < end; bead++) {
        size_t i = bead - d->now.first, j = bead - d->old.first; /* huge if the bead is before the first */
        bool now = i < d->now.count, old = j < d->old.count;
        if (now && old && same_ball(d, i, j, by))
            continue;
        if (old)
            span_of_ball(spans, &d->old.balls[j], by, limits);
        if (now)
            span_of_ball(spans, &d->now.balls[i], 0, limits);
    }
}

/* The row always shows all beads, so old and new balls correspond. */
struct bead_spans bead_beads_row_changes(const struct bead_view *v)
{
    const struct bead_drawing *d = &v->row_drawing;
    const struct bead_rect *limits = &v->row.rect;
    struct bead_spans spans = {.count = 0};
    if (!v->drawn || d->now.count != d->old.count || d->now.first != d->old.first)
        return everything(limits);
    /* The arrow is the first mark, and the only one that may be away from a changed ball. */
    if (!d->now.mark_count || !d->old.mark_count || memcmp(d->now.marks, d->old.marks, sizeof *d->now.marks) != 0) {
        add_marks(&spans, d->old.marks, d->old.mark_count, true, 0, limits);
        add_marks(&spans, d->now.marks, d->now.mark_count, true, 0, limits);
    }
    add_balls(&spans, d, 0, limits);
    return spans;
}

struct bead_spans bead_beads_lens_changes(const struct bead_view *v, int by)
{
    const struct bead_drawing *d = &v->lens_drawing;
    const struct bead_rect *r = &v->lens.rect;
    struct bead_spans spans = {.count = 0};
    if (!v->drawn)
        return everything(r);
    add_span(&spans, r->x, r->x - by, r); /* newly in view */
    add_marks(&spans, d->old.marks, d->old.mark_count, true, by, r);
    add_marks(&spans, d->now.marks, d->now.mark_count, true, 0, r);
    add_balls(&spans, d, by, r);
    add_marks(&spans, d->old.marks, d->old.mark_count, false, by, r);
    add_marks(&spans, d->now.marks, d->now.mark_count, false, 0, r);
    add_span(&spans, r->x + r->width - by, r->x + r->width, r);
    return spans;
}

/* Moves the pixels `by` to the right of columns from..to into these. */
static void move_gap(const struct bead_view *v, int from, int to, int by, struct bead_frame *frame)
{
    const struct bead_rect *r = &v->lens.rect;
    for (int y = r->y; from < to && y < r->y + r->height; y++) {
        uint8_t *row = frame->pixels + (size_t)(v->area.y + y) * frame->stride;
        memmove(row + 4 * (size_t)(v->area.x + from), row + 4 * (size_t)(v->area.x + from + by), 4 * (size_t)(to - from));
    }
}

/* Gaps are moved in the direction of the move, so that none is overwritten before it is read. */
void bead_beads_move(const struct bead_view *v, const struct bead_spans *spans, int by, struct bead_frame *frame)
{
    const struct bead_rect *r = &v->lens.rect;
    for (size_t k = 0; by && k <= spans->count; k++) {
        size_t gap = by > 0 ? k : spans->count - k;
        int from = gap > 0 ? spans->to[gap - 1] : r->x, to = gap < spans->count ? spans->from[gap] : r->x + r->width;
        move_gap(v, from, to, by, frame);
    }
}
