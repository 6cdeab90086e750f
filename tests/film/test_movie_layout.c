/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layouts of movie frames: whatever is asked for, rectangles stay within the frame and do not overlap. */
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
#include "render/view/views.h"

enum { MOST_RECTS = 128 };

struct named {
    struct bead_rect rect;
    const char *name;
};

static size_t add(struct named *all, size_t count, struct bead_rect rect, const char *name)
{
    if (rect.width == 0)
        return count;
    assert_true(count < MOST_RECTS);
    all[count] = (struct named){rect, name};
    return count + 1;
}

static void check(const struct bead_movie_wants *w, const struct bead_movie_layout *layout)
{
    struct named all[MOST_RECTS];
    size_t count = 0;
    count = add(all, count, layout->time, "time");
    count = add(all, count, layout->badge, "badge");
    count = add(all, count, layout->title, "title");
    count = add(all, count, layout->facts, "facts");
    count = add(all, count, layout->key, "key");
    count = add(all, count, layout->bar, "bar");
    count = add(all, count, layout->bar_title, "title of the bar");
    count = add(all, count, layout->inset, "inset");
    count = add(all, count, layout->caption, "caption");
    for (size_t c = 0; c < layout->chain_count; c++) {
        if (layout->head == 0) /* else it is over a stage */
            count = add(all, count, layout->chains[c].heading, "heading");
        count = add(all, count, layout->chains[c].name, "name");
        const size_t first = count;
        for (size_t v = 0; v < w->view_count; v++) {
            bool along = bead_movie_across(w, v) == BEAD_ACROSS_CHAIN;
            struct bead_rect panel = layout->chains[c].plot[v];
            if (panel.width == 0) /* no room for it */
                continue;
            assert_true(panel.height > 0);
            if (v == layout->overlay && c > 0) { /* the one of the first chain */
                assert_memory_equal(&panel, &layout->chains[0].plot[v], sizeof panel);
                continue;
            }
            panel.x -= along ? layout->beyond[0] : 0;
            panel.width += along ? layout->beyond[0] + layout->beyond[1] : 0;
            panel.x -= v == layout->overlay ? layout->colours : 0;
            panel.width += v == layout->overlay ? layout->colours : 0;
            count = add(all, count, panel, "panel");
            if (layout->layout <= BEAD_LAYOUT_GRID && panel.x == all[first].rect.x &&
                panel.width != all[first].rect.width) /* whatever runs along them */
                fail_msg("%d x %d, %zu chains, %zu views: panels below each other are %d and %d px wide", w->width, w->height,
                         w->chain_count, w->view_count, all[first].rect.width, panel.width);
        }
    }
    for (size_t i = 0; i < count; i++) {
        const struct bead_rect *a = &all[i].rect;
        if (a->x < 0 || a->y < 0 || a->width < 1 || a->height < 1 || a->x + a->width > w->width || a->y + a->height > w->height)
            fail_msg("%d x %d, %zu chains, %zu views: %s at %d, %d of %d x %d leaves the frame", w->width, w->height,
                     w->chain_count, w->view_count, all[i].name, a->x, a->y, a->width, a->height);
        for (size_t j = 0; j < i; j++) {
            const struct bead_rect *b = &all[j].rect;
            if (a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height)
                fail_msg("%d x %d, %zu chains, %zu views: %s overlaps %s", w->width, w->height, w->chain_count, w->view_count,
                         all[i].name, all[j].name);
        }
    }
}

static struct bead_movie_wants wants_of(const struct bead_look *look, int width, int height)
{
    return (struct bead_movie_wants){.width = width,
                                     .height = height,
                                     .look = look,
                                     .orientation = BEAD_TIME_DOWN,
                                     .axes = true,
                                     .title_width = 9 * look->label,
                                     .headings = true,
                                     .heading_width = 25 * look->label,
                                     .beads = 40,
                                     .striker = true,
                                     .wall = true,
                                     .name_least = 4 * look->label,
                                     .along = 2 * look->label,
                                     .time_width = 5 * look->title,
                                     .left = 2.4 * look->tick,
                                     .below_beads = 1.4 * look->tick,
                                     .below_time = 2.9 * look->tick,
                                     .time_end = 0.9 * look->tick,
                                     .bar = 2.6 * look->tick,
                                     .bar_below = 1.4 * look->tick,
                                     .bar_title = 4 * look->label};
}

/* Some chains, views and extras. */
static void vary(struct bead_movie_wants *w, unsigned variant)
{
    w->chain_count = 1 + variant % 6;
    unsigned views = 1 + variant / 6 % 31, flags = variant / 186;
    for (int kind = 0; kind < BEAD_VIEW_KINDS; kind++) {
        if (views & (1u << kind))
            w->views[w->view_count++] = bead_view_find((enum bead_view_kind)kind);
    }
    w->axes = flags & 1;
    w->headings = flags & 2;
    w->title_width = flags & 2 ? w->title_width : 0;
    w->same_beads = flags & 4;
    w->caption_lines = (int)(flags / 8);
    w->caption_line = 1.4 * w->look->title;
}

static void arrange(const struct bead_movie_wants *w)
{
    struct bead_movie_layout layout;
    struct bead_message msg = {""};
    if (bead_movie_arrange(w, &layout, &msg))
        fail_msg("%d x %d, layout %d, %zu chains, %zu views: %s", w->width, w->height, w->layout, w->chain_count, w->view_count,
                 msg.text);
    check(w, &layout);
    if (w->axes && w->caption_lines > 0 && !(layout.caption.height >= w->caption_lines * w->caption_line))
        fail_msg("%d x %d, %zu chains, %zu views: captions are dropped", w->width, w->height, w->chain_count, w->view_count);
    bead_movie_layout_free(&layout);
}

static void test_rectangles(void **state)
{
    (void)state;
    static const int sizes[][2] = {{320, 180},   {640, 360},  {854, 480}, {1280, 720}, {1920, 1080}, {3840, 2160},
                                   {1080, 1920}, {720, 1280}, {600, 600}, {400, 1200}, {1600, 300},  {2560, 1080}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        struct bead_look look;
        bead_look_film(&look, sizes[s][0], sizes[s][1], true, s % 2);
        for (unsigned variant = s % 5; variant < 6 * 31 * 8 * 3; variant += 5) { /* each at two sizes or three */
            for (int layout = BEAD_LAYOUT_AUTO; layout <= BEAD_LAYOUT_STAGE; layout++) {
                struct bead_movie_wants w = wants_of(&look, sizes[s][0], sizes[s][1]);
                w.layout = (enum bead_layout)layout;
                vary(&w, variant);
                arrange(&w);
                w.orientation = BEAD_TIME_RIGHT;
                if (variant / 5 % 3 == s % 3)
                    arrange(&w);
            }
        }
    }
}

static const int shapes[][2] = {{1920, 1080}, {1440, 1080}, {1080, 1080}, {1080, 1920}, {640, 360}, {480, 480}};
enum { SHAPES = sizeof shapes / sizeof shapes[0], FULL_SIZE = 4 };

static struct bead_movie_wants story(const struct bead_look *look, const int size[2], size_t chains, enum bead_view_kind first)
{
    const enum bead_view_kind kinds[3] = {first, BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME};
    struct bead_movie_wants w = wants_of(look, size[0], size[1]);
    w.chain_count = chains;
    w.same_beads = true;
    for (int i = 0; i < 3; i++)
        w.views[w.view_count++] = bead_view_find(kinds[i]);
    return w;
}

static double share_of(const struct bead_movie_wants *w, const struct bead_movie_layout *layout, size_t view)
{
    double area = 0;
    for (size_t c = 0; c < layout->chain_count; c++)
        area += (double)layout->chains[c].plot[view].width * layout->chains[c].plot[view].height;
    return area / ((double)w->width * w->height);
}

static double share_of_headings(const struct bead_movie_wants *w, const struct bead_movie_layout *layout)
{
    double area = 0;
    for (size_t c = 0; c < layout->chain_count; c++)
        area += (double)layout->chains[c].heading.width * layout->chains[c].heading.height;
    return area / ((double)w->width * w->height);
}

/* Beads have 35 to 45 % of the frame and, in the usual type, images 15 to 25 %; if room is short, images give way, never things a
 * viewer cannot do without. */
static void test_stage_has_its_share(void **state)
{
    (void)state;
    for (unsigned i = 0; i < FULL_SIZE * 4 * 2 * 3; i++) {
        const int *size = shapes[i % FULL_SIZE];
        size_t chains = 1 + i / FULL_SIZE % 4;
        bool large = i / FULL_SIZE / 4 % 2;
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, size[0], size[1], true, large);
        struct bead_movie_wants w = story(&look, size, chains, BEAD_VIEW_STAGE);
        w.layout = BEAD_LAYOUT_STAGE;
        w.orientation = BEAD_TIME_RIGHT;
        w.badge_width = 9 * look.label;
        w.key_width = 29 * look.label;
        w.key_brief = w.key_part = 23 * look.label;
        w.keyed_heading = size[1] > size[0] ? 40 * look.label : 0; /* on phones, no key has room beside a heading */
        w.caption_lines = (int)(i / FULL_SIZE / 8);
        w.caption_line = 1.4 * look.title;
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        double beads = share_of(&w, &found, 0) + (found.head == 0 ? share_of_headings(&w, &found) : 0),
               images = share_of(&w, &found, 2);
        bool curve = found.chains[0].plot[1].width > 0, upright = size[1] > size[0],
             usual = !large && w.caption_lines == 0 && !(upright && chains > 3);
        if (getenv("SHOW"))
            printf("%d x %d, %zu chains%s, %d captions: beads %.1f %%, images %.1f %%, curve %d, bar %d\n", size[0], size[1],
                   chains, large ? ", large" : "", w.caption_lines, 100 * beads, 100 * images, curve, found.bar.width > 0);
        /* On phones, of the frame's width: a bead, less than half of the picture of its stage, which has a row of all below. */
        const double across = 2 / 2.9 * (found.chains[0].plot[0].height - ceil(0.8 * look.tick)) / size[0];
        if ((curve && (usual || chains + large < 5) && !(beads > 0.35 && beads < (w.caption_lines > 0 ? 0.505 : 0.45))) ||
            images > 0.26 ||
            (usual && images < (upright && chains > 2              ? 0.11
                                : size[0] == size[1] && chains > 3 ? 0.135
                                : upright                          ? 0.148
                                                                   : 0.149)) ||
            (upright && !large && across < 0.05))
            fail_msg("%d x %d, %zu chains: beads have %.1f %%, images %.1f %%", size[0], size[1], chains, 100 * beads,
                     100 * images);
        assert_true(images == 0 || found.bar.width > 0 || found.colours > 0); /* their colours have a scale */
        assert_true(curve || (!found.grid && large && w.caption_lines == 2));
        assert_true(found.grid == (chains == 4 && !upright) && (!(found.grid || (upright && !large)) || found.key.width > 0));
        assert_true(found.axes && found.time.width && found.badge.width && found.title.width && found.facts.width);
        assert_true(found.chains[chains - 1].heading.width > 0);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
}

/* Without a curve, whose axis could have their colours, images have a bar, or there are none. */
static void test_images_have_a_bar(void **state)
{
    (void)state;
    size_t bars = 0;
    for (unsigned i = 0; i < SHAPES * 4 * 2 * 3; i++) {
        const int *size = shapes[i % SHAPES];
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, size[0], size[1], true, i / SHAPES / 4 % 2);
        struct bead_movie_wants w = story(&look, size, 1 + i / SHAPES % 4, BEAD_VIEW_STAGE);
        w.layout = BEAD_LAYOUT_STAGE;
        w.views[1] = w.views[2];
        w.view_count = 2;
        w.caption_lines = (int)(i / SHAPES / 8);
        w.caption_line = 1.4 * look.title;
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        if (share_of(&w, &found, 1) > 0 && found.bar.width == 0)
            fail_msg("%d x %d, %zu chains: images have no bar", size[0], size[1], w.chain_count);
        bars += found.bar.width > 0;
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
    assert_true(bars > SHAPES);
}

/* The title of both axes of three images on a phone is wider than one of them, but not than all: in a separate line it is above
 * all, no image has a title of its time below, and images are larger. */
static void test_one_title_for_all_images(void **state)
{
    (void)state;
    static const int phone[2] = {1080, 1920};
    double images[2];
    for (int wide = 0; wide < 2; wide++) {
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, phone[0], phone[1], true, false);
        struct bead_movie_wants w = story(&look, phone, 3, BEAD_VIEW_STAGE);
        w.layout = BEAD_LAYOUT_STAGE;
        w.orientation = BEAD_TIME_RIGHT;
        w.key_width = 29 * look.label;
        w.below_numbers = w.below_beads;
        w.against = (wide ? 30 : 9) * look.label;
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const struct bead_rect first = found.chains[0].plot[2], last = found.chains[2].plot[2];
        assert_true(w.against > first.width);
        assert_true(found.against == (w.against < last.x + last.width - first.x));
        assert_true(found.against == !wide);
        images[wide] = share_of(&w, &found, 2);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
    if (!(images[0] > images[1]))
        fail_msg("images have %.1f %% with one title, %.1f %% without", 100 * images[0], 100 * images[1]);
}

/* The layout that `auto` takes, by number of chains: 1, 2, 3, 4. */
static void test_automatic_layouts(void **state)
{
    (void)state;
    static const enum bead_layout S = BEAD_LAYOUT_STACKED, C = BEAD_LAYOUT_COLUMNS, G = BEAD_LAYOUT_GRID;
    const enum bead_layout expected[4][4] = {{S, C, C, C}, {S, C, C, G}, {S, C, C, G}, {S, S, G, G}};
    for (size_t s = 0; s < 4; s++) {
        for (size_t n = 1; n <= 4; n++) {
            struct bead_look look;
            struct bead_movie_layout found;
            bead_look_film(&look, shapes[s][0], shapes[s][1], true, false);
            struct bead_movie_wants w = story(&look, shapes[s], n, BEAD_VIEW_BEADS);
            assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
            if (found.layout != expected[s][n - 1])
                fail_msg("%d x %d, %zu chains: layout %d", shapes[s][0], shapes[s][1], n, found.layout);
            assert_true(found.axes && found.chains[n - 1].heading.width > 0);
            bead_movie_layout_free(&found);
        }
    }
}

static void test_full_size_keeps_everything(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout layout;
    bead_look_film(&look, 1920, 1080, true, false);
    struct bead_movie_wants w = wants_of(&look, 1920, 1080);
    static const enum bead_view_kind kinds[3] = {BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE, BEAD_VIEW_SPACETIME};
    w.chain_count = 2;
    w.same_beads = true;
    w.caption_lines = 1;
    w.caption_line = 1.4 * look.title;
    for (int i = 0; i < 3; i++)
        w.views[w.view_count++] = bead_view_find(kinds[i]);
    assert_int_equal(bead_movie_arrange(&w, &layout, NULL), BEAD_OK);
    assert_true(layout.axes && layout.time.width && layout.title.width && layout.facts.width && layout.bar.width);
    assert_true(layout.caption.width > 1500 && layout.caption.height >= w.caption_line);
    assert_true(layout.chains[1].heading.width > 0);
    assert_true(layout.chains[0].labels[2] && layout.chains[1].labels[2]); /* side by side: the images label the beads for all */
    assert_false(layout.chains[1].labels[0]);
    assert_true(layout.chains[0].values[2]); /* the first column labels the times for both */
    assert_false(layout.chains[1].values[2]);
    static const int least[3] = {48, 100, 440};
    for (int v = 0; v < 3; v++)
        assert_true(layout.chains[1].plot[v].height >= least[v]);
    bead_movie_layout_free(&layout);
}

/* A bar explains colours; where there are none the plots have its room. */
static void test_bars_are_for_colours(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout with, without;
    bead_look_film(&look, 1280, 720, true, false);
    struct bead_movie_wants w = wants_of(&look, 1280, 720);
    w.chain_count = 1;
    w.views[w.view_count++] = bead_view_find(BEAD_VIEW_PROFILE);
    assert_int_equal(bead_movie_arrange(&w, &with, NULL), BEAD_OK);
    for (int bare = 0; bare < 2; bare++) {
        w.colourless = !bare;
        w.axes = !bare;
        assert_int_equal(bead_movie_arrange(&w, &without, NULL), BEAD_OK);
        assert_true(with.bar.width > 0 && without.bar.width == 0);
        assert_true(without.chains[0].plot[0].width > with.chains[0].plot[0].width + with.bar.width);
        bead_movie_layout_free(&without);
    }
    bead_movie_layout_free(&with);
}

/* On phones, a bar that does not fit beside the clock has a separate line below the words; one that fits stays in place. */
static void test_bars_on_phones(void **state)
{
    (void)state;
    bool was_below = false, begins_below = false;
    for (int words = 2; words < 16; words++) { /* of the bar's title, letters */
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, 390, 844, true, false);
        struct bead_movie_wants w = wants_of(&look, 390, 844);
        w.chain_count = 1;
        w.headings = false;
        w.badge_width = 12 * look.label;
        w.bar_title = 0.5 * words * look.label;
        w.views[w.view_count++] = bead_view_find(BEAD_VIEW_BEADS);
        w.views[w.view_count++] = bead_view_find(BEAD_VIEW_PROFILE);
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const bool below = found.bar.y > found.title.y;
        assert_true(found.bar.width >= 4 * look.tick && found.bar.height > 0 && found.bar_title.width >= w.bar_title);
        assert_true(below ? found.bar.y >= found.title.y + found.title.height && found.bar_title.x == found.time.x
                          : found.bar_title.x >= found.time.x + found.time.width);
        assert_true(below || !was_below); /* also for longer titles */
        was_below = below;
        begins_below = begins_below || (words == 2 && below);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
    assert_true(was_below && !begins_below);
}

/* Where no image takes the room of a phone, curves and bars do: nothing is left empty below them. In four columns they
 * are as high as the frame is wide. */
static void test_curves_fill_phones(void **state)
{
    (void)state;
    static const enum bead_view_kind kinds[3] = {BEAD_VIEW_BEADS, BEAD_VIEW_PROFILE, BEAD_VIEW_MODES};
    static const int phones[][2] = {{1080, 1920}, {390, 844}};
    for (size_t s = 0; s < 2; s++) {
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, phones[s][0], phones[s][1], true, false);
        struct bead_movie_wants w = wants_of(&look, phones[s][0], phones[s][1]);
        w.chain_count = 1;
        for (int i = 0; i < 3; i++)
            w.views[w.view_count++] = bead_view_find(kinds[i]);
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const struct bead_rect curve = found.chains[0].plot[1], bars = found.chains[0].plot[2];
        const double left = w.height - w.below_beads - bars.y - bars.height;
        if (left > 3 * look.gap || curve.height <= 0.5 * curve.width || curve.height <= bars.height)
            fail_msg("%d x %d: %g px are empty below a curve of %d and bars of %d", w.width, w.height, left, curve.height,
                     bars.height);
        check(&w, &found);
        bead_movie_layout_free(&found);
        w.chain_count = 4;
        w.layout = BEAD_LAYOUT_COLUMNS;
        w.view_count = 2;
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const struct bead_rect *narrow = found.chains[3].plot;
        if (narrow[1].y + narrow[1].height - narrow[0].y < 0.6 * w.height)
            fail_msg("%d x %d: the curves of four columns are %d high", w.width, w.height, narrow[1].height);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
}

/* An overlaid curve takes the room that rows of beads below it do not need, alone all of it, and beside images the rest. */
static void test_overlays_fill_frames(void **state)
{
    (void)state;
    for (size_t views = 1; views < 4; views++) {
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, 1920, 1080, true, false);
        struct bead_movie_wants w = story(&look, (const int[]){1920, 1080}, 2, BEAD_VIEW_STAGE);
        w.layout = BEAD_LAYOUT_OVERLAY;
        w.views[0] = bead_view_find(BEAD_VIEW_PROFILE);
        w.views[1] = bead_view_find(BEAD_VIEW_STAGE);
        w.view_count = views;
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const struct bead_rect *plot = found.chains[1].plot, curve = found.chains[0].plot[0];
        const struct bead_rect lowest = views > 1 ? plot[views - 1] : curve;
        const double empty = w.height - lowest.y - lowest.height;
        if (curve.height < (const double[]){0.4, 0.4, 0.1}[views - 1] * w.height || empty > 0.15 * w.height)
            fail_msg("%zu views: the curve is %d high, %g px are empty", views, curve.height, empty);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
}

/* The title ends where the panels end, and both have air to the frame's edge. */
/* Rows of beads alone are as wide as the frame allows, and their bar has its title beside the first of them. */
static void test_beads_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < 4 * 3; i++) {
        const int *size = shapes[i % 3];
        struct bead_look look;
        bead_look_film(&look, size[0], size[1], true, false);
        struct bead_movie_wants w = wants_of(&look, size[0], size[1]);
        w.chain_count = 1 + i / 3;
        w.views[w.view_count++] = bead_view_find(BEAD_VIEW_BEADS);
        struct bead_movie_layout layout;
        struct bead_message msg = {""};
        assert_int_equal(bead_movie_arrange(&w, &layout, &msg), BEAD_OK);
        check(&w, &layout);
        const struct bead_rect row = layout.chains[0].plot[0], title = layout.bar_title, bar = layout.bar;
        if (row.width < 0.75 * size[0])
            fail_msg("%d x %d, %zu chains: beads on %d px", size[0], size[1], w.chain_count, row.width);
        if (3 * size[1] < 2 * size[0] && (bar.y - (title.y + title.height) > 3 * look.label || title.y + 5 * look.label < row.y))
            fail_msg("%d x %d, %zu chains: the bar begins at %d, its title ends at %d, beads begin at %d", size[0], size[1],
                     w.chain_count, bar.y, title.y + title.height, row.y);
        bead_movie_layout_free(&layout);
    }
}

static void test_titles_end_with_panels(void **state)
{
    (void)state;
    for (size_t chains = 1; chains <= 2; chains++) {
        struct bead_look look;
        struct bead_movie_layout found;
        bead_look_film(&look, 1920, 1080, true, false);
        struct bead_movie_wants w = wants_of(&look, 1920, 1080);
        w.chain_count = chains;
        w.same_beads = w.colourless = true;
        w.along_end = 1.3 * look.tick;
        w.views[w.view_count++] = bead_view_find(BEAD_VIEW_PROFILE);
        assert_int_equal(bead_movie_arrange(&w, &found, NULL), BEAD_OK);
        const struct bead_rect panel = found.chains[chains - 1].plot[0];
        assert_int_equal(found.title.x + found.title.width, panel.x + panel.width + found.beyond[1]);
        assert_true(found.title.width >= w.title_width);
        assert_true(w.width - found.title.x - found.title.width >= 2 * look.gap);
        check(&w, &found);
        bead_movie_layout_free(&found);
    }
}

static void test_too_small(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout layout;
    struct bead_message msg = {""};
    bead_look_film(&look, 5, 5, true, false);
    struct bead_movie_wants w = wants_of(&look, 5, 5);
    w.chain_count = 26;
    w.views[w.view_count++] = bead_view_find(BEAD_VIEW_BEADS);
    assert_int_equal(bead_movie_arrange(&w, &layout, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "too small"));
    assert_null(layout.chains);
}

/* Later levels leave out whatever a level leaves out, and no gap or least height grows again, except that below titles. */
static void test_levels_leave_out_more_and_more(void **state)
{
    (void)state;
    for (size_t i = 1; i < BEAD_LEVELS; i++) {
        const struct bead_level *a = &bead_levels[i - 1], *b = &bead_levels[i];
        assert_true(a->share >= b->share && a->roomy >= b->roomy && a->images >= b->images && a->values >= b->values);
        assert_true(a->facts >= b->facts && a->titles >= b->titles && a->headings >= b->headings);
        assert_true(a->axes >= b->axes && a->words >= b->words && a->rows >= b->rows && a->heading >= b->heading);
        assert_true(a->views >= b->views || (a->titles && !b->titles)); /* labels of neighbours would touch */
        for (size_t k = 0; k < 3; k++)
            assert_true(a->least[k] >= b->least[k]);
        assert_true(a->least_px >= b->least_px);
    }
    const struct bead_level *all = &bead_levels[0], *none = &bead_levels[BEAD_LEVELS - 1];
    assert_true(all->facts && all->titles && all->values && all->headings && all->axes && all->words && !none->words);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangles),
        cmocka_unit_test(test_stage_has_its_share),
        cmocka_unit_test(test_images_have_a_bar),
        cmocka_unit_test(test_one_title_for_all_images),
        cmocka_unit_test(test_automatic_layouts),
        cmocka_unit_test(test_full_size_keeps_everything),
        cmocka_unit_test(test_bars_are_for_colours),
        cmocka_unit_test(test_bars_on_phones),
        cmocka_unit_test(test_curves_fill_phones),
        cmocka_unit_test(test_overlays_fill_frames),
        cmocka_unit_test(test_beads_alone),
        cmocka_unit_test(test_titles_end_with_panels),
        cmocka_unit_test(test_too_small),
        cmocka_unit_test(test_levels_leave_out_more_and_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
