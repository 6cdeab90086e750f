/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances in movie frames: parts below and beside each other are exactly as far apart as labels and gaps require; the rest of the
 * room is around the cells. In units of the look's letters, at several sizes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/draw/looks.h"
#include "render/movie/movie_cells.h"
#include "render/movie/movie_layout.h"
#include "render/movie/movie_stage.h"
#include "render/movie/movie_words.h"
#include "render/stage/stage_key.h"
#include "render/view/views.h"
#include "strokes.h"

static int up(double x)
{
    return (int)ceil(x);
}

static struct bead_movie_wants wants_of(const struct bead_look *look, int width, int height, size_t chains)
{
    return (struct bead_movie_wants){.width = width,
                                     .height = height,
                                     .look = look,
                                     .orientation = BEAD_TIME_RIGHT,
                                     .chain_count = chains,
                                     .axes = true,
                                     .headings = true,
                                     .heading_width = 8 * look->label,
                                     .heading_least = 4 * look->label,
                                     .name_least = 4 * look->label,
                                     .keyed_heading = 20 * look->label,
                                     .key_width = 12 * look->label,
                                     .title_width = 9 * look->label,
                                     .time_width = 5 * look->title,
                                     .badge_width = 6 * look->label,
                                     .beads = 40,
                                     .striker = true,
                                     .left = 2.4 * look->tick,
                                     .along = 2 * look->label,
                                     .against = 5 * look->label,
                                     .below_beads = 2.3 * look->tick,
                                     .below_time = 2.9 * look->tick,
                                     .below_numbers = 1.5 * look->tick,
                                     .time_end = 0.9 * look->tick,
                                     .along_end = 1.3 * look->tick,
                                     .bar = 2.6 * look->tick,
                                     .bar_below = 1.4 * look->tick,
                                     .bar_title = 4 * look->label};
}

static void add_view(struct bead_movie_wants *w, enum bead_view_kind kind)
{
    w->views[w->view_count++] = bead_view_find(kind);
}

static const struct {
    int width, height;
} sizes[] = {{1920, 1080}, {1080, 1920}, {1080, 1080}, {854, 480}};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static int right_of(struct bead_rect r)
{
    return r.x + r.width;
}

static int end_of(struct bead_rect r)
{
    return r.y + r.height;
}

static void assert_px(int got, int expected, const char *what, const struct bead_movie_wants *w, int most)
{
    if (abs(got - expected) > most)
        fail_msg("%d x %d, layout %d, %zu chains, %zu views: %s is %d, not %d", w->width, w->height, w->layout, w->chain_count,
                 w->view_count, what, got, expected);
}

/* ---- words ---- */

/* Clock, badge and title side by side, or in separate lines if they do not fit; facts and the remark below, without a gap. */
static void assert_words(const struct bead_movie_wants *w, const struct bead_movie_layout *l, int left, int right)
{
    const struct bead_look *look = w->look;
    const int line = up(1.35 * look->label), margin = l->time.y, gap = up(look->gap);
    int y = margin;
    assert_px(l->time.x, left, "the clock's place", w, 0);
    assert_px(l->time.height, up(1.45 * look->title), "the clock's height", w, 0);
    assert_px(l->time.width, up(w->time_width), "the clock's width", w, 0);
    y = l->bar.width > l->bar.height && l->bar.y < end_of(l->time) ? y : end_of(l->time);
    const bool lying_beside = y == margin;
    const bool badge_beside = l->badge.y == margin, title_beside = l->title.width > 0 && l->title.y == margin;
    if (badge_beside)
        assert_px(l->badge.x, right_of(l->time) + 2 * gap, "the badge's place", w, 0);
    else if (!lying_beside)
        assert_true(right_of(l->time) + w->badge_width + 2 * look->gap +
                        (w->width < 1.5 * w->height ? w->bar_title + 8 * look->tick : 0) >
                    right - 3);
    if (title_beside) {
        assert_px(l->title.x, right_of(badge_beside ? l->badge : l->time) + 2 * gap, "the title's place", w, 0);
        assert_px(right_of(l->title), right, "the title's end", w, 0);
        assert_true(l->title.width >= w->title_width - 3);
    }
    if (lying_beside)
        return;
    const struct bead_rect *lines[] = {badge_beside ? NULL : &l->badge, title_beside ? NULL : &l->title, &l->facts,
                                       l->key.y == l->facts.y ? NULL : &l->key, &l->trust};
    for (size_t i = 0; i < 5; i++) {
        if (!lines[i] || lines[i]->width == 0)
            continue;
        assert_px(lines[i]->y, y, "a line of words", w, 0);
        assert_px(lines[i]->x, left, "a line's begin", w, l->key.y == l->facts.y && l->key.width > 0 ? w->width : 0);
        assert_px(right_of(*lines[i]), right, "a line's end", w, 0);
        if (i > 0)
            assert_true(lines[i]->height == line || (i == 1 && lines[i]->height == 2 * line));
        y = end_of(*lines[i]);
    }
    if (l->caption.width > 0) {
        assert_px(l->caption.height, up(w->caption_lines * w->caption_line), "the caption's height", w, 0);
        assert_px(end_of(l->caption), w->height - margin, "the caption's end", w, 0);
        assert_true(l->caption.x == margin && right_of(l->caption) == w->width - margin);
    }
}

/* A badge: round corners of 0.2 letters, in the middle of its line, its text 0.45 letters from the left. */
static void badges_are_round(void **)
{
    struct bead_look look;
    bead_look_film(&look, 1280, 720, true, false);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 600, 200);
    cairo_t *cr = cairo_create(surface);
    for (int low = 0; low < 2; low++) {
        const double em = look.label, height = low ? em : 1.4 * em, round = 0.2 * em;
        const struct bead_rect rect = {30, 40, 400, low ? (int)em : 80};
        const struct bead_text_style style = {.family = look.family, .size = em};
        double text, lines;
        bead_text_size(NULL, &style, "slow", &text, &lines);
        strokes_begin();
        bead_badge_draw(cr, &look, "slow", rect);
        strokes.on = false;
        const double right = 30 + text + 0.9 * em, top = 40 + (rect.height - (low ? (int)em : height)) / 2,
                     bottom = top + (low ? (int)em : height);
        const struct stroke *s = &strokes.list[0];
        assert_true(strokes.count == 1 && stroke_has(s, true, look.accent) && s->count == 8);
        const double corners[8][2] = {{30, top + round},       {30 + round, top},       {right - round, top}, {right, top + round},
                                      {right, bottom - round}, {right - round, bottom}, {30 + round, bottom}, {30, bottom - round}};
        for (size_t i = 0; i < 8; i++) {
            assert_at(s->at[i].x, corners[i][0]);
            assert_at(s->at[i].y, corners[i][1]);
        }
    }
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
}

/* ---- cells ---- */

/* Has a view of this row labels? The last of a column has, whichever row it is in. */
static bool labelled(const struct bead_movie_wants *w, const struct bead_movie_layout *l, size_t columns, size_t row, size_t view)
{
    bool any = false;
    for (size_t c = row * columns; c < (row + 1) * columns && c < w->chain_count; c++)
        any = any || l->chains[c].labels[view];
    return any;
}

/* Between the views of a cell: labels below the upper, a gap, the title above the lower. */
static void assert_cell(const struct bead_movie_wants *w, const struct bead_movie_layout *l, size_t columns, size_t c)
{
    const struct bead_look *look = w->look;
    const struct bead_movie_chain *chain = &l->chains[c];
    const struct bead_rect *last = NULL;
    int below = 0;
    for (size_t v = 0; v < w->view_count; v++) {
        const struct bead_rect *plot = &chain->plot[v];
        if (plot->width == 0 || v == l->overlay)
            continue;
        const bool beads = bead_view_has(w->views[v], BEAD_SHOWS_BEADS), time = bead_movie_across(w, v) == BEAD_ACROSS_TIME;
        const int above = beads ? 0 : up(1.35 * look->label),
                  beyond = bead_movie_across(w, v) == BEAD_ACROSS_CHAIN ? l->beyond[0] : 0;
        if (last)
            assert_px(plot->y - end_of(*last), below + up(0.3 * look->tick) + above, "the gap between views", w, 0);
        else if (chain->heading.width > 0) {
            assert_px(end_of(chain->heading) + above, plot->y, "the heading's end", w, 0);
            assert_px(chain->heading.x, plot->x - beyond, "the heading's place", w, 0);
            assert_px(right_of(chain->heading), right_of(*plot) - (beyond > 0 ? 0 : l->beyond[1]), "its end", w, 0);
            assert_true(chain->heading.height == up(1.5 * look->title) || chain->heading.height == up(1.25 * look->title) ||
                        l->label_lines);
        }
        below = !labelled(w, l, columns, c / columns, v) || beads ? 0 : up(time ? w->below_time : w->below_beads);
        last = plot;
    }
}

/* Side by side: the first column has room for labels, the others for the numbers of their neighbours; all are of one width. */
static void assert_columns(const struct bead_movie_wants *w, const struct bead_movie_layout *l, size_t columns, int margin)
{
    const struct bead_look *look = w->look;
    const bool along = bead_movie_across(w, 0) == BEAD_ACROSS_CHAIN;
    const int beyond = along ? l->beyond[0] : 0;
    assert_px(l->chains[0].plot[0].x - beyond, margin + up(fmax(w->left, w->time_end - look->gap)), "the first panel's place", w,
              0);
    double ends = 0;
    for (size_t v = 0; v < w->view_count; v++)
        ends = fmax(ends, bead_movie_across(w, v) == BEAD_ACROSS_TIME ? w->time_end : w->along_end - l->beyond[1]);
    for (size_t c = 1; c < w->chain_count; c++) {
        const struct bead_rect before = l->chains[c - 1].plot[0], here = l->chains[c].plot[0];
        assert_true(here.width == before.width);
        if (c % columns > 0) {
            double left = 0; /* numbers of times reach out at both sides */
            for (size_t v = 0; v < w->view_count; v++)
                left = bead_movie_across(w, v) == BEAD_ACROSS_TIME ? w->time_end : left;
            const int room = up(fmax(1.2 * look->tick, ends > 0 ? ends + 0.5 * look->tick : 0)) + up(left);
            assert_true(here.y == before.y && here.height == before.height);
            assert_px(here.x - right_of(before), room + (along ? l->beyond[0] + l->beyond[1] : 0), "the gap between columns", w, 0);
        }
    }
    /* The bar is right of everything, with the height of the plots. */
    const struct bead_rect last = l->chains[columns - 1].plot[0];
    assert_true((l->bar.height > l->bar.width) == (!w->colourless && w->width >= 1.5 * w->height));
    if (l->bar.height > l->bar.width) {
        const int pad = up(0.6 * look->tick), room = up(fmax(0, ends - 0.5 * look->gap));
        assert_px(l->bar.width, up(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE)), "the bar's width", w, 0);
        assert_px(l->bar.x, right_of(last) + (along ? l->beyond[1] : 0) + room + up(0.8 * look->tick), "the bar's place", w,
                  (int)columns);
        assert_true(l->bar.y >= end_of(l->bar_title) + pad && l->bar.x == l->bar_title.x);
        assert_px(right_of(l->bar_title), w->width - margin, "the end of the bar's title", w, 0);
        int bottom = 0, top = w->height;
        for (size_t v = 0; v < w->view_count; v++) {
            for (size_t c = 0; c < w->chain_count; c++) {
                bottom = end_of(l->chains[c].plot[v]) > bottom ? end_of(l->chains[c].plot[v]) : bottom;
                top = l->chains[c].plot[v].y < top ? l->chains[c].plot[v].y : top;
            }
        }
        assert_px(end_of(l->bar), bottom - pad, "the bar's end", w, 0);
        assert_px(l->bar.y, (top > end_of(l->bar_title) ? top : end_of(l->bar_title)) + pad, "the bar's begin", w, 0);
    }
}

/* What no view can use is around the cells: half as much above the first and below the last as between them. */
static void assert_rows(const struct bead_movie_wants *w, const struct bead_movie_layout *l, size_t columns, int top, int bottom)
{
    const struct bead_look *look = w->look;
    const size_t rows = (w->chain_count + columns - 1) / columns, lowest = w->view_count - 1;
    double between = INFINITY;
    for (size_t r = 1; r < rows; r++) {
        const struct bead_movie_chain *upper = &l->chains[(r - 1) * columns], *lower = &l->chains[r * columns];
        const bool time = bead_movie_across(w, lowest) == BEAD_ACROSS_TIME;
        const bool below = labelled(w, l, columns, r - 1, lowest) && !bead_view_has(w->views[lowest], BEAD_SHOWS_BEADS);
        const int labels = below ? up(time ? w->below_time : w->below_beads) : 0;
        const double free = lower->heading.y - end_of(upper->plot[lowest]) - labels;
        assert_true(free >= up(0.54 * look->tick)); /* 0.9 on roomy levels */
        between = fmin(between, free);
        for (size_t v = 0; v < w->view_count; v++)
            assert_true(abs(lower->plot[v].height - upper->plot[v].height) <= 1);
    }
    const struct bead_movie_chain *last = &l->chains[w->chain_count - 1];
    const bool time = bead_movie_across(w, lowest) == BEAD_ACROSS_TIME, beads = bead_view_has(w->views[lowest], BEAD_SHOWS_BEADS);
    const int labels = last->labels[lowest] && !beads ? up(time ? w->below_time : w->below_beads) : 0;
    const int above = l->chains[0].heading.y - top, below = bottom - end_of(last->plot[lowest]) - labels;
    assert_true(above >= 0 && below >= 0);
    assert_px(above, below, "the room above the cells", w, 3 + (int)rows);
    if (rows > 1 && above > 3)
        assert_true(fabs(between - 0.54 * look->tick - 2 * above) <= 0.4 * look->tick + 4);
}

static void cells_are_as_far_apart_as_labels_need(void **)
{
    static const enum bead_view_kind kinds[][4] = {{BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME},
                                                   {BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME},
                                                   {BEAD_VIEW_PROFILE, BEAD_VIEW_SENSORS},
                                                   {BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE},
                                                   {BEAD_VIEW_SENSORS}};
    static const size_t counts[] = {3, 2, 2, 2, 1};
    size_t seen = 0, tall = 0;
    for (unsigned i = 0; i < SIZES * 5 * 4 * 3 * 2; i++) {
        const unsigned size = i % SIZES, set = i / SIZES % 5, chains = 1 + i / SIZES / 5 % 4, which = i / SIZES / 20 % 3,
                       flags = i / SIZES / 60;
        struct bead_look look;
        struct bead_movie_layout l;
        bead_look_film(&look, sizes[size].width, sizes[size].height, true, false);
        struct bead_movie_wants w = wants_of(&look, sizes[size].width, sizes[size].height, chains);
        w.layout = (enum bead_layout[]){BEAD_LAYOUT_STACKED, BEAD_LAYOUT_COLUMNS, BEAD_LAYOUT_GRID}[which];
        w.same_beads = flags;
        w.wall = flags;
        w.trust = flags;
        w.colourless = set == 2 || set == 4;
        w.caption_lines = (int)flags;
        w.caption_line = 1.4 * look.title;
        for (size_t v = 0; v < counts[set]; v++)
            add_view(&w, kinds[set][v]);
        if (bead_movie_arrange(&w, &l, NULL))
            continue;
        const size_t columns = which == 0 ? 1 : which == 1 ? chains : (size_t)ceil(sqrt(chains));
        const bool full =
            l.titles && l.axes && l.chains[0].values[0] && l.chains[0].plot[counts[set] - 1].width > 0 && l.facts.width > 0;
        if (full) {
            const int margin = l.time.y;
            const struct bead_rect last = l.chains[columns - 1].plot[0];
            const bool along = bead_movie_across(&w, 0) == BEAD_ACROSS_CHAIN;
            assert_true(margin == up(look.gap) || margin == up(2 * look.gap));
            assert_true(margin == up(look.gap) || chains == 1 || (set != 0 && set != 1));
            assert_words(&w, &l, l.time.x, right_of(last) + (along ? l.beyond[1] : 0));
            assert_columns(&w, &l, columns, margin);
            for (size_t c = 0; c < chains; c++)
                assert_cell(&w, &l, columns, c);
            const struct bead_rect lowest = l.trust.width > 0 ? l.trust : l.facts;
            const bool bar_below = l.bar.width > l.bar.height && l.bar.y >= end_of(lowest);
            if (!bar_below)
                assert_rows(&w, &l, columns, end_of(lowest),
                            l.caption.width > 0 ? l.caption.y - up(0.5 * look.gap) : w.height - margin);
            seen++;
            tall += columns < chains;
        }
        bead_movie_layout_free(&l);
    }
    assert_true(seen > 100 && tall > 20); /* most have room for all */
}

/* Beside the clock, if there is room: badge, title, a horizontal bar; each if it fits into the remaining room. */
static void words_are_beside_the_clock_where_they_fit(void **)
{
    struct bead_look look;
    struct bead_movie_layout l;
    bead_look_film(&look, 1920, 1080, true, false);
    for (int of_title = 0; of_title < 2; of_title++) {
        int most = 0, left = 0, right = 0, least = 1920;
        const int gap = up(look.gap), badge = up(6 * look.label);
        for (int width = 40; width < 1900; width += 10) {
            struct bead_movie_wants w = wants_of(&look, 1920, 1080, 1);
            w.badge_width = of_title ? 6 * look.label : width;
            w.title_width = of_title ? width : 0;
            w.colourless = true;
            add_view(&w, BEAD_VIEW_PROFILE);
            assert_int_equal(bead_movie_arrange(&w, &l, NULL), BEAD_OK);
            const struct bead_rect word = of_title ? l.title : l.badge, panel = l.chains[0].plot[0];
            const bool beside = word.y == l.time.y;
            left = panel.x - l.beyond[0];
            right = right_of(panel) + l.beyond[1];
            most = beside && width > most ? width : most;
            least = !beside && width < least ? width : least;
            assert_true(!of_title || l.words_left == !beside);
            assert_true(beside || word.y == end_of(l.time)); /* a long title has two lines */
            if (!beside && of_title && (width > right - left || width < right - left - 3 * look.tick))
                assert_true(word.height == (width > right - left ? 2 : 1) * up(1.35 * look.label));
            assert_true(beside || of_title || word.height == up(1.5 * look.label));
            bead_movie_layout_free(&l);
        }
        assert_int_equal(least, most + 10);
        const int room = right - left - up(5 * look.title) - 2 * gap - (of_title ? badge + 2 * gap : 0);
        assert_true(most <= room + 2 && most > room - 10 - 3 * look.tick);
    }
}

static void bars_lie_beside_the_clock_or_below_the_words(void **)
{
    size_t beside = 0, below = 0;
    for (unsigned i = 0; i < 2 * 12 * 2; i++) {
        struct bead_look look;
        struct bead_movie_layout l;
        const int width = 1080, height = i % 2 ? 1080 : 1920;
        bead_look_film(&look, width, height, true, false);
        struct bead_movie_wants w = wants_of(&look, width, height, 1);
        w.headings = false;
        w.time_end = w.along_end = 0;
        w.title_width = 0;
        w.bar_title = (1 + i / 2 % 12) * 1.3 * look.label;
        w.badge_width = i / 24 ? 3 * look.label : 0;
        add_view(&w, BEAD_VIEW_PROFILE);
        assert_int_equal(bead_movie_arrange(&w, &l, NULL), BEAD_OK);
        const int pad = up(1.2 * look.tick), gap = up(look.gap), margin = l.time.y,
                  words = right_of(l.badge.y == l.time.y ? l.badge : l.time);
        const int thick = up(bead_colour_bar_width(&look, BEAD_BAR_OF_MOVIE));
        if (l.bar.width == 0) { /* too short even in a separate line */
            const struct bead_rect plot = l.chains[0].plot[0];
            assert_true(plot.width - w.bar_title - 2 * pad < 4 * look.tick + 8);
            bead_movie_layout_free(&l);
            continue;
        }
        assert_true(l.bar.width >= 4 * look.tick && l.bar.height == thick);
        assert_px(right_of(l.bar) + pad, width - margin, "the lying bar's end", &w, 0);
        assert_px(right_of(l.bar_title) + pad, l.bar.x, "the end of its title", &w, 0);
        assert_px(l.bar.y + thick / 2, l.bar_title.y + l.bar_title.height / 2, "the bar's middle", &w, 1);
        assert_true(l.bar_title.height == l.time.height);
        if (l.bar_title.y == l.time.y) {
            beside++;
            const int free = width - margin - words - gap - 2 * pad - up(w.bar_title + 0.5 * look.gap);
            assert_px(l.bar_title.width, up(w.bar_title + 0.5 * look.gap), "the width of its title", &w, 0);
            assert_px(l.bar.width, free < (int)(0.4 * width) ? free : (int)(0.4 * width), "the bar's length", &w, 0);
        } else {
            below++;
            const int lowest = end_of(l.facts), line = up(fmax(l.time.height, 0.5 * (l.time.height + thick) + w.bar_below));
            assert_px(l.bar_title.x, l.time.x, "the begin of its title", &w, 0);
            assert_px(l.bar_title.width, up(w.bar_title), "the width of its title", &w, 0);
            assert_px(l.bar_title.y, lowest, "the bar below the words", &w, 0);
            const struct bead_rect plot = l.chains[0].plot[0];
            assert_true(plot.y - up(1.35 * look.label) >= lowest + line);
            /* Beside the clock it would have been too short. */
            assert_true(right_of(plot) + l.beyond[1] - words - 2 * look.gap - w.bar_title - 2 * pad - 1.5 * look.gap <
                        4 * look.tick + 8);
        }
        bead_movie_layout_free(&l);
    }
    assert_true(beside > 5 && below > 5);
}

/* `auto` overlays profiles of several chains where nothing else is shown; numbers of columns are those that the layout says. */
static void layouts_have_the_columns_of_their_names(void **)
{
    struct bead_look look;
    struct bead_movie_layout l;
    bead_look_film(&look, 1920, 1080, true, false);
    for (size_t chains = 1; chains <= 8; chains++) {
        for (int layout = BEAD_LAYOUT_AUTO; layout <= BEAD_LAYOUT_GRID; layout++) {
            for (int views = 1; views <= 2; views++) {
                struct bead_movie_wants w = wants_of(&look, 1920, 1080, chains);
                w.layout = (enum bead_layout)layout;
                add_view(&w, BEAD_VIEW_PROFILE);
                if (views == 2)
                    add_view(&w, BEAD_VIEW_SENSORS);
                assert_int_equal(bead_movie_arrange(&w, &l, NULL), BEAD_OK);
                size_t across = 1;
                while (across < chains && l.chains[across].plot[views - 1].y == l.chains[0].plot[views - 1].y)
                    across++;
                const bool overlay =
                    layout == BEAD_LAYOUT_OVERLAY || (layout == BEAD_LAYOUT_AUTO && views == 1 && chains > 1 && chains <= 6);
                assert_true((l.layout == BEAD_LAYOUT_OVERLAY) == overlay && (l.overlay < w.view_count) == overlay);
                if (layout == BEAD_LAYOUT_STACKED)
                    assert_int_equal(across, 1);
                if (layout == BEAD_LAYOUT_COLUMNS)
                    assert_int_equal(across, chains);
                if (layout == BEAD_LAYOUT_GRID)
                    assert_int_equal(across, (size_t)ceil(sqrt((double)chains)));
                bead_movie_layout_free(&l);
            }
        }
    }
}

/* ---- stages ---- */

/* Rows of beads below each other, one gap apart; curve and images in one row or below each other; the bar beside the last image. */
static void parts_of_stages_are_as_far_apart_as_labels_need(void **)
{
    size_t beside = 0, below = 0, bars = 0, drawn = 0;
    for (unsigned i = 0; i < SIZES * 4 * 2 * 2 * 2; i++) {
        const unsigned size = i % SIZES, chains = 1 + i / SIZES % 4, down = i / SIZES / 4 % 2, flags = i / SIZES / 8 % 2,
                       inset = i / SIZES / 16;
        struct bead_look look;
        struct bead_movie_layout l;
        bead_look_film(&look, sizes[size].width, sizes[size].height, true, false);
        struct bead_movie_wants w = wants_of(&look, sizes[size].width, sizes[size].height, chains);
        const double em = look.label, area = (double)w.width * w.height;
        w.layout = BEAD_LAYOUT_STAGE;
        w.orientation = down ? BEAD_TIME_DOWN : BEAD_TIME_RIGHT;
        w.same_beads = flags;
        w.inset = inset ? 7 * em : 0;
        w.time_end = flags ? w.time_end : 0.3 * look.tick; /* within the gap to a bar */
        add_view(&w, BEAD_VIEW_STAGE);
        add_view(&w, BEAD_VIEW_PROFILE);
        add_view(&w, BEAD_VIEW_SPACETIME);
        if (bead_movie_arrange(&w, &l, NULL))
            continue;
        const int margin = l.time.y, right = w.width - margin, in = bead_stage_inset(&w);
        const size_t columns = bead_stage_columns(&w), rows = (chains + columns - 1) / columns;
        assert_px(margin, up(2 * look.gap), "the margin", &w, 0);
        assert_px(in, up(w.width >= 1.5 * w.height ? 0.03 * w.width : fmax(0, w.along_end - look.gap)), "the inset", &w, 0);
        assert_int_equal(columns, chains == 4 && w.width >= w.height ? 2 : 1);
        assert_words(&w, &l, margin + in, right - in);
        /* Beads. */
        const int numbers = up(BEAD_STAGE_NUMBERS * look.tick), heading = l.chains[0].heading.height;
        int gap = -1;
        for (size_t c = 0; c < chains; c++) {
            const struct bead_movie_chain *chain = &l.chains[c];
            const struct bead_rect p = chain->plot[0], first = l.chains[0].plot[0];
            const bool last = c / columns + 1 == rows;
            assert_true(chain->labels[0] == (!flags || last));
            assert_px(p.width, first.width, "a stage's width", &w, 0);
            assert_px(p.height, first.height + (chain->labels[0] ? numbers : 0) - (l.chains[0].labels[0] ? numbers : 0),
                      "a stage's height", &w, 0);
            assert_px(p.x, margin + in + (int)(c % columns) * (p.width + up(0.6 * em)), "a stage's place", &w, 0);
            assert_true(c % columns > 0 || columns == 2 || right_of(p) == right - in);
            assert_true(chain->heading.x == p.x && chain->heading.width == p.width);
            assert_px(chain->heading.y, l.head > 0 ? p.y : p.y - heading, "a heading's place", &w, 0);
            assert_true(l.head == 0 || l.head == heading);
            if (c < columns)
                continue;
            const struct bead_rect before = l.chains[c - columns].plot[0];
            const int free = chain->heading.y - end_of(before);
            assert_true(free == up(0.6 * em) || free == up(0.4 * 0.6 * em) || free == up(0.2 * 0.6 * em));
            assert_true(gap < 0 || gap == free);
            gap = free;
        }
        const int end = end_of(l.chains[chains - 1].plot[0]);
        assert_px(l.chains[0].heading.y - end_of(l.facts.width ? l.facts : l.time),
                  l.title.y > l.facts.y ? 0 : l.chains[0].heading.y - end_of(l.facts), "beads below words", &w, 0);
        /* Curve and images. */
        const struct bead_rect curve = l.chains[0].plot[1], first = l.chains[0].plot[2], last = l.chains[chains - 1].plot[2];
        const int above = up(1.35 * em), time = !down,
                  under = up(!time       ? w.below_beads
                             : l.against ? w.below_numbers
                                         : w.below_time);
        if (first.width == 0 || curve.width == 0) {
            bead_movie_layout_free(&l);
            continue;
        }
        const int named =
            l.chains[0].name.width > 0 && l.chains[0].name.y < first.y - above ? above : 0; /* names in a separate line */
        assert_true(l.overlay == 1 && (l.bar.width > 0) == (l.colours == 0));
        assert_true((double)chains * first.width * first.height <= 0.25 * area + first.width);
        for (size_t c = 0; c < chains; c++) {
            const struct bead_movie_chain *chain = &l.chains[c];
            assert_memory_equal(&chain->plot[1], &curve, sizeof curve);
            assert_true(chain->labels[2] && chain->values[2] == (c == 0) && chain->labels[1] == (c == 0) &&
                        chain->values[1] == (c == 0));
            assert_true(chain->plot[2].y == first.y && chain->plot[2].height == first.height &&
                        chain->plot[2].width == first.width);
            if (c > 0)
                assert_px(chain->plot[2].x - right_of(l.chains[c - 1].plot[2]), (int)round(0.5 * em + 2 * w.time_end),
                          "the gap between images", &w, 1);
            if (chain->name.width == 0)
                continue;
            assert_px(right_of(chain->name), right_of(chain->plot[2]), "a name's end", &w, 0);
            assert_px(chain->name.height, above, "a name's height", &w, 0);
            assert_px(chain->name.y, first.y - above - named, "a name's place", &w, 0);
            const double before = c == 0 ? w.left : 0.5 * em + 2 * w.time_end;
            const double taken = c == 0 && !named ? (l.against ? w.against : w.along) + 0.5 * em : 0.5 * em - before;
            assert_px(chain->name.x - chain->plot[2].x, up(taken), "a name's begin", &w, 0);
        }
        const double ends = fmax(0, w.time_end - (l.bar.width > 0 ? 0.4 * em : look.gap));
        const double bar =
            l.bar.width > 0 ? up(0.8 * look.tick) + up(fmax(bead_colour_bar_width(&look, BEAD_BAR_OF_MOVIE) + w.bar, w.bar_title))
                            : 0;
        assert_px(right_of(last), right - (int)round(ends + bar), "the images' end", &w, (int)chains + 1);
        if (first.y == curve.y) { /* in one row */
            beside++;
            assert_true(curve.height == first.height);
            assert_px(first.x - right_of(curve), (int)round(w.left), "the gap between curve and images", &w, 1);
            const double drawing = w.inset > 0 ? in + w.inset + 0.7 * em : 0;
            const double left = drawing > 0 ? drawing + w.left + l.colours : fmax(w.left + l.colours, in);
            assert_px(curve.x, up(margin + left), "the curve's place", &w, 0);
            assert_true(curve.width >= 8 * em - 1 && curve.height >= 2.4 * em);
            const int lowest = up(w.below_beads) > under ? up(w.below_beads) : under;
            assert_px(end_of(curve) + lowest, w.height - margin, "the curve's end", &w, 0);
            if (w.inset > 0) {
                drawn++;
                assert_true(l.inset.x == margin + in && l.inset.width == (int)floor(w.inset) &&
                            end_of(l.inset) == w.height - margin);
                assert_px(l.inset.y, curve.y - above - named, "the drawing's place", &w, 0);
            }
        } else { /* the images below the curve */
            below++;
            assert_true(w.inset == 0 && l.inset.width == 0);
            assert_px(curve.x, margin + up(w.left + l.colours), "the curve's place", &w, 0);
            assert_px(right_of(curve), right - up(fmax(ends, w.along_end - look.gap)), "the curve's end", &w, 0);
            assert_px(first.x, up(margin + w.left), "the first image's place", &w, 0);
            const int free = first.y - end_of(curve) - up(w.below_beads) - above - named;
            assert_true(free == up(0.6 * em) || free == up(0.4 * 0.6 * em) || free == up(0.2 * 0.6 * em));
            assert_px(end_of(first) + under, w.height - margin, "the images' end", &w, 2);
            assert_true(curve.height >= 2.4 * em - 1);
        }
        const int start = curve.y - above - (first.y == curve.y ? named : 0) - end;
        assert_true(start == up(0.7 * em) || start == up(0.4 * 0.7 * em) || start == up(0.2 * 0.7 * em));
        if (l.bar.width > 0) {
            const int pad = up(0.6 * look.tick);
            bars++;
            assert_px(l.bar.x, right_of(last) + up(ends + 0.8 * look.tick), "the bar's place", &w, 0);
            assert_true(l.bar.y == last.y + pad && l.bar.height == last.height - 2 * pad);
            assert_px(l.bar.width, up(bead_colour_bar_width(&look, BEAD_BAR_OF_MOVIE)), "the bar's width", &w, 0);
            assert_true(l.bar_title.x == l.bar.x && l.bar_title.y == last.y - above && l.bar_title.height == above &&
                        right_of(l.bar_title) == right);
        }
        bead_movie_layout_free(&l);
    }
    assert_true(beside > 20 && below > 4 && bars > 10 && drawn > 5);
}

/* Curves without images end where the numbers of their own axis require, whatever times would; images without curves begin where
 * times require. Both extend from the air below the beads down to their labels. */
static void parts_of_stages_stand_alone(void **)
{
    size_t seen[2] = {0};
    for (unsigned i = 0; i < SIZES * 3 * 2 * 4; i++) {
        const unsigned size = i % SIZES, chains = 1 + i / SIZES % 3, image = i / SIZES / 3 % 2, ends = i / SIZES / 6;
        struct bead_look look;
        struct bead_movie_layout l;
        bead_look_film(&look, sizes[size].width, sizes[size].height, true, false);
        struct bead_movie_wants w = wants_of(&look, sizes[size].width, sizes[size].height, chains);
        const double em = look.label;
        w.layout = BEAD_LAYOUT_STAGE;
        w.headings = false;
        w.keyed_heading = w.key_width = 0;
        w.time_end = (ends & 1 ? 3 : 0) * look.gap;
        w.along_end = (ends & 2 ? 2 : 0) * look.gap;
        add_view(&w, BEAD_VIEW_STAGE);
        add_view(&w, image ? BEAD_VIEW_SPACETIME : BEAD_VIEW_PROFILE);
        assert_int_equal(bead_movie_arrange(&w, &l, NULL), BEAD_OK);
        const int margin = l.time.y, right = w.width - margin, in = bead_stage_inset(&w), above = up(1.35 * em);
        const struct bead_rect first = l.chains[0].plot[1], last = l.chains[chains - 1].plot[1];
        const int start = first.y - above - end_of(l.chains[chains - 1].plot[0]);
        if (first.width == 0) {
            bead_movie_layout_free(&l);
            continue;
        }
        seen[image]++;
        assert_true(start == up(0.7 * em) || start == up(0.4 * 0.7 * em) || start == up(0.2 * 0.7 * em));
        if (!image) {
            assert_true(l.overlay == 1 && l.bar.width == 0 && l.colours == 0);
            assert_px(first.x, margin + up(fmax(w.left, in)), "the curve's place", &w, 0);
            assert_px(first.width, (int)(right - margin - fmax(w.left, in) - fmax(0, w.along_end - look.gap)), "the curve's width",
                      &w, 0);
            assert_px(end_of(first), w.height - margin - up(w.below_beads), "the curve's lower end", &w, 0);
        } else {
            const double bar = up(0.8 * look.tick) + up(fmax(bead_colour_bar_width(&look, BEAD_BAR_OF_MOVIE) + w.bar, w.bar_title)),
                         beyond = fmax(0, w.time_end - 0.4 * em), between = 0.5 * em + 2 * w.time_end,
                         room = right - margin - bar - beyond - w.left - (chains - 1) * between,
                         height = w.height - margin - up(l.against ? w.below_numbers : w.below_time) - first.y,
                         most = floor(0.25 * w.width * w.height / (chains * height));
            assert_true(l.overlay == w.view_count && l.bar.width > 0);
            assert_px(first.height, (int)height, "an image's height", &w, 0);
            assert_px(first.width, (int)fmin(most, floor(room / chains)), "an image's width", &w, 0);
            assert_px(first.x, up(margin + w.left), "the first image's place", &w, 0);
            assert_px(l.bar.x, right_of(last) + up(beyond + 0.8 * look.tick), "the bar's place", &w, 0);
        }
        bead_movie_layout_free(&l);
    }
    assert_true(seen[0] > SIZES * 10 && seen[1] > SIZES * 10);
}

/* On upright frames labels that have no room beside names have a line below them, where that is long enough for them in small type,
 * which is 0.85 of the stage's width; names that have the key beside them do not give it up. */
static void labels_are_below_names_where_they_fit(void **)
{
    size_t below = 0;
    for (unsigned i = 0; i < 2 * 2 * 2 * 40; i++) {
        const bool upright = i % 2, keyed = i / 2 % 2, wider = i / 4 % 2;
        const int width = 1080, height = upright ? 1920 : 1080;
        struct bead_look look;
        struct bead_movie_layout l;
        bead_look_film(&look, width, height, true, false);
        struct bead_movie_wants w = wants_of(&look, width, height, 2);
        w.layout = BEAD_LAYOUT_STAGE;
        w.keyed_heading = keyed ? 4 * look.label : width;
        w.key_width = 0;
        w.label_width = (0.5 + 0.02 * (i / 8)) * width;
        w.heading_width = wider ? 2 * width : 4 * look.label;
        add_view(&w, BEAD_VIEW_STAGE);
        add_view(&w, BEAD_VIEW_PROFILE);
        assert_int_equal(bead_movie_arrange(&w, &l, NULL), BEAD_OK);
        const double room = w.width - 2 * up(2 * look.gap), needed = BEAD_SMALLER_LABEL * w.label_width;
        if (fabs(needed - 0.85 * room) > 2 || !upright || keyed || !wider) {
            const bool expected = upright && !keyed && wider && needed < 0.85 * room;
            if (l.label_lines != expected)
                fail_msg("%s, %s key, names of %g px, labels of %g px: labels %s", upright ? "upright" : "square",
                         keyed ? "with" : "without", w.heading_width, w.label_width, l.label_lines ? "below" : "beside");
            below += expected;
        }
        bead_movie_layout_free(&l);
    }
    assert_true(below > 5 && below < 35);
}

/* ---- what is left out ---- */

static bool shows(const struct bead_movie_wants *w, const struct bead_movie_layout *l, unsigned trait)
{
    for (size_t i = 0; i < w->chain_count * w->view_count; i++) {
        if (bead_view_has(w->views[i % w->view_count], trait) && l->chains[i / w->view_count].plot[i % w->view_count].width > 0)
            return true;
    }
    return false;
}

/* The facts, or a scale for colours that are shown, are words that are lacking; else curves too low for numbers lack these, and
 * `layout: images` its images. */
static void assert_lacks(const struct bead_movie_wants *w, const struct bead_movie_layout *l, size_t seen[4])
{
    const bool coloured = shows(w, l, BEAD_SHOWS_IMAGE) || shows(w, l, BEAD_SHOWS_BEADS);
    const bool words = l->facts.width == 0 || (coloured && !w->colourless && l->bar.width == 0);
    double lowest = INFINITY;
    for (size_t i = 0; i < w->chain_count * w->view_count; i++) {
        const size_t v = i % w->view_count;
        const struct bead_rect *plot = &l->chains[i / w->view_count].plot[v];
        if (plot->width > 0 && !bead_view_has(w->views[v], BEAD_SHOWS_IMAGE | BEAD_SHOWS_BEADS))
            lowest = fmin(lowest, plot->height);
    }
    const bool images = w->layout == BEAD_LAYOUT_IMAGES && shows(w, l, BEAD_SHOWS_IMAGE);
    if ((l->lacks == BEAD_LACKS_WORDS) != words || (l->lacks < BEAD_LACKS_NUMBERS && lowest < floor(2.6 * w->look->tick)) ||
        (l->lacks == BEAD_LACKS_IMAGES && (w->layout != BEAD_LAYOUT_IMAGES || images)) || (images && l->lacks == BEAD_LACKS_IMAGES))
        fail_msg("%d x %d, layout %d, %zu chains, %zu views: lacks %d; facts %d px, bar %d px, lowest curve %g px", w->width,
                 w->height, w->layout, w->chain_count, w->view_count, l->lacks, l->facts.width, l->bar.width, lowest);
    seen[l->lacks]++;
}

static void what_is_lacking_is_told(void **)
{
    static const enum bead_view_kind views[][3] = {{BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME},
                                                   {BEAD_VIEW_PROFILE, BEAD_VIEW_SENSORS, BEAD_VIEW_SPACETIME},
                                                   {BEAD_VIEW_BEADS, BEAD_VIEW_SPACETIME, BEAD_VIEW_SPACETIME},
                                                   {BEAD_VIEW_PROFILE, BEAD_VIEW_SENSORS, BEAD_VIEW_PROFILE}};
    size_t seen[4] = {0};
    for (size_t i = 0; i < 4 * 4 * 5 * 12; i++) {
        const size_t set = i % 4, chains = 1 + i / 4 % 4, step = i / 80;
        const int width = (int)(1280 * pow(0.78, (double)step)), height = i / 16 % 5 < 3 ? width * 9 / 16 : width * 4 / 3;
        struct bead_look look;
        struct bead_movie_layout l;
        bead_look_film(&look, width, height, true, false);
        struct bead_movie_wants w = wants_of(&look, width, height, chains);
        w.layout = (enum bead_layout[]){BEAD_LAYOUT_AUTO, BEAD_LAYOUT_STACKED, BEAD_LAYOUT_IMAGES, BEAD_LAYOUT_COLUMNS,
                                        BEAD_LAYOUT_BESIDE}[i / 16 % 5];
        w.colourless = set == 3;
        for (size_t v = 0; v < 3; v++)
            add_view(&w, views[set][v]);
        if (bead_movie_arrange(&w, &l, NULL))
            continue;
        assert_lacks(&w, &l, seen);
        bead_movie_layout_free(&l);
    }
    for (size_t k = 0; k < 4; k++)
        assert_true(seen[k] > 3);
}

/* A frame twice as large has everything twice as large, where it gives up the same: whole pixels can decide that. */
static void frames_scale(void **)
{
    static const enum bead_view_kind kinds[] = {BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME};
    size_t scaled = 0;
    for (unsigned i = 0; i < 3 * 4 * 6; i++) {
        const unsigned size = i % 3, chains = 1 + i / 3 % 4;
        struct bead_movie_layout l[2];
        struct bead_look looks[2];
        bool failed = false;
        for (int k = 0; k < 2; k++) {
            bead_look_film(&looks[k], (k + 1) * sizes[size].width, (k + 1) * sizes[size].height, true, false);
            struct bead_movie_wants w = wants_of(&looks[k], (k + 1) * sizes[size].width, (k + 1) * sizes[size].height, chains);
            w.layout = (enum bead_layout[]){BEAD_LAYOUT_AUTO,    BEAD_LAYOUT_STACKED, BEAD_LAYOUT_BESIDE,
                                            BEAD_LAYOUT_OVERLAY, BEAD_LAYOUT_GRID,    BEAD_LAYOUT_STAGE}[i / 12];
            for (int v = 0; v < 3; v++)
                add_view(&w, i / 12 == 5 && v == 0 ? BEAD_VIEW_STAGE : kinds[v]);
            failed = failed || bead_movie_arrange(&w, &l[k], NULL);
        }
        assert_false(failed);
        const struct bead_rect *a[4 + 3 * 4] = {&l[0].time, &l[0].title, &l[0].facts, &l[0].bar},
                                          *b[4 + 3 * 4] = {&l[1].time, &l[1].title, &l[1].facts, &l[1].bar};
        for (size_t c = 0; c < chains; c++) {
            for (size_t v = 0; v < 3; v++) {
                a[4 + 3 * c + v] = &l[0].chains[c].plot[v];
                b[4 + 3 * c + v] = &l[1].chains[c].plot[v];
            }
        }
        const struct bead_rect *image[2] = {&l[0].chains[0].plot[2], &l[1].chains[0].plot[2]};
        const bool same = abs(2 * image[0]->height - image[1]->height) < 24;
        scaled += same;
        for (size_t k = 0; same && k < 4 + 3 * chains; k++) {
            const int near = 12;
            if (abs(2 * a[k]->x - b[k]->x) > near || abs(2 * a[k]->y - b[k]->y) > near ||
                abs(2 * a[k]->width - b[k]->width) > near || abs(2 * a[k]->height - b[k]->height) > near)
                fail_msg("%d x %d, layout %u, %u chains: part %zu at %d, %d of %d x %d is at %d, %d of %d x %d", sizes[size].width,
                         sizes[size].height, i / 12, chains, k, a[k]->x, a[k]->y, a[k]->width, a[k]->height, b[k]->x, b[k]->y,
                         b[k]->width, b[k]->height);
        }
        for (int k = 0; k < 2; k++)
            bead_movie_layout_free(&l[k]);
    }
    assert_true(scaled > 65);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(badges_are_round),
                                       cmocka_unit_test(cells_are_as_far_apart_as_labels_need),
                                       cmocka_unit_test(words_are_beside_the_clock_where_they_fit),
                                       cmocka_unit_test(bars_lie_beside_the_clock_or_below_the_words),
                                       cmocka_unit_test(layouts_have_the_columns_of_their_names),
                                       cmocka_unit_test(parts_of_stages_are_as_far_apart_as_labels_need),
                                       cmocka_unit_test(parts_of_stages_stand_alone),
                                       cmocka_unit_test(labels_are_below_names_where_they_fit),
                                       cmocka_unit_test(what_is_lacking_is_told),
                                       cmocka_unit_test(frames_scale)};
    return cmocka_run_group_tests_name("gaps of movies", tests, NULL, NULL);
}
