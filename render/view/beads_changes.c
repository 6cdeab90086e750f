/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of the row and the lens must be painted again. Where the lens goes in whole pixels, beads at rest look the same but for
 * their place: they are moved in the frame, which costs a tenth of painting them. */
#include <math.h>
#include <string.h>

#include "render/view/beads.h"

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

/* The row always shows all beads, so old and new balls correspond. */
struct bead_spans bead_beads_row_changes(const struct bead_view *v)
{
    const struct bead_drawing *d = &v->row_drawing;
    const struct bead_rect *limits = &v->row.rect;
    struct bead_spans spans = {.count = 0};
    if (!v->drawn || d->count != d->old_count || d->first != d->old_first)
        return everything(limits);
    for (size_t m = 0; m < 2 && v->striker; m++) { /* arrow: the only mark that is not beside a bead that changed */
        const struct bead_mark *now = &d->marks[0], *old = &d->old_marks[0];
        bool same = d->mark_count && d->old_mark_count && memcmp(now, old, sizeof *now) == 0;
        const struct bead_mark *mark = m ? now : old;
        if (!same && (m ? d->mark_count : d->old_mark_count) && mark->kind == BEAD_MARK_ARROW)
            add_span(&spans, mark->box[0] - 2, mark->box[2] + 2, limits);
    }
    for (size_t i = 0; i < d->count; i++) {
        if (d->glow[i] == d->old_glow[i] && memcmp(&d->balls[i], &d->old_balls[i], sizeof d->balls[i]) == 0)
            continue;
        span_of_ball(&spans, &d->old_balls[i], 0, limits);
        span_of_ball(&spans, &d->balls[i], 0, limits);
    }
    return spans;
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

/* Ball i, and old ball j moved to the left. Sums of floats are exact here. */
static bool same_ball(const struct bead_drawing *d, size_t i, size_t j, int by)
{
    const struct bead_ball *now = &d->balls[i], *old = &d->old_balls[j];
    bool light = d->glow[i] == d->old_glow[j] && (i + 1 < d->count) == (j + 1 < d->old_count);
    return light && now->y == old->y && now->r == old->r && (double)now->x + by == old->x && (double)now->left + by == old->left &&
           (double)now->right + by == old->right && memcmp(now->rgba, old->rgba, sizeof now->rgba) == 0;
}

/* Arrow (at the left) or wall (at the right): the marks that do not go with a ball. */
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
    size_t first = d->first < d->old_first ? d->first : d->old_first;
    size_t end = d->first + d->count > d->old_first + d->old_count ? d->first + d->count : d->old_first + d->old_count;
    for (size_t bead = first; bead < end; bead++) {
        size_t i = bead - d->first, j = bead - d->old_first; /* huge where bead is before the first */
        bool now = i < d->count, old = j < d->old_count;
        if (now && old && same_ball(d, i, j, by))
            continue;
        if (old)
            span_of_ball(spans, &d->old_balls[j], by, limits);
        if (now)
            span_of_ball(spans, &d->balls[i], 0, limits);
    }
}

struct bead_spans bead_beads_lens_changes(const struct bead_view *v, int by)
{
    const struct bead_drawing *d = &v->lens_drawing;
    const struct bead_rect *r = &v->lens.rect;
    struct bead_spans spans = {.count = 0};
    if (!v->drawn || (by == 0 && v->lens.from != v->lens_drawn))
        return everything(r);
    add_span(&spans, r->x, r->x - by, r); /* what comes into view */
    add_marks(&spans, d->old_marks, d->old_mark_count, true, by, r);
    add_marks(&spans, d->marks, d->mark_count, true, 0, r);
    add_balls(&spans, d, by, r);
    add_marks(&spans, d->old_marks, d->old_mark_count, false, by, r);
    add_marks(&spans, d->marks, d->mark_count, false, 0, r);
    add_span(&spans, r->x + r->width - by, r->x + r->width, r);
    return spans;
}

/* Columns from..to get what is `by` pixels to their right. */
static void move_gap(const struct bead_view *v, int from, int to, int by, struct bead_frame *frame)
{
    const struct bead_rect *r = &v->lens.rect;
    for (int y = r->y; from < to && y < r->y + r->height; y++) {
        uint8_t *row = frame->pixels + (size_t)(v->area.y + y) * frame->stride;
        memmove(row + 4 * (size_t)(v->area.x + from), row + 4 * (size_t)(v->area.x + from + by), 4 * (size_t)(to - from));
    }
}

/* In the direction of the move, so that nothing is overwritten before it is read. */
void bead_beads_move(const struct bead_view *v, const struct bead_spans *spans, int by, struct bead_frame *frame)
{
    const struct bead_rect *r = &v->lens.rect;
    for (size_t k = 0; by && k <= spans->count; k++) {
        size_t gap = by > 0 ? k : spans->count - k;
        int from = gap > 0 ? spans->to[gap - 1] : r->x, to = gap < spans->count ? spans->from[gap] : r->x + r->width;
        move_gap(v, from, to, by, frame);
    }
}
