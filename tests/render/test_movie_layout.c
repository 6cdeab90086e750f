/* Layouts of movie frames: whatever is asked for, rectangles stay within the frame and apart from each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <string.h>
#include <cmocka.h>

#include "render/movie/movie_layout.h"

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
    count = add(all, count, layout->title, "title");
    count = add(all, count, layout->facts, "facts");
    count = add(all, count, layout->bar, "bar");
    count = add(all, count, layout->caption, "caption");
    for (size_t c = 0; c < layout->chain_count; c++) {
        count = add(all, count, layout->chains[c].heading, "heading");
        for (size_t v = 0; v < w->view_count; v++) {
            assert_true(layout->chains[c].plot[v].height > 0);
            assert_int_equal(layout->chains[c].plot[v].x, layout->chains[0].plot[0].x);
            assert_int_equal(layout->chains[c].plot[v].width, layout->chains[0].plot[0].width);
            count = add(all, count, layout->chains[c].plot[v], "plot");
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
                                     .axes = true,
                                     .title = true,
                                     .headings = true,
                                     .time_width = 5 * look->title,
                                     .left = 3.4 * look->tick,
                                     .below_beads = 2.9 * look->tick,
                                     .below_time = 2.9 * look->tick,
                                     .bar = 3.6 * look->tick};
}

static void test_rectangles(void **state)
{
    (void)state;
    static const int sizes[][2] = {{320, 180},   {640, 360},  {854, 480}, {1280, 720}, {1920, 1080}, {3840, 2160},
                                   {1080, 1920}, {720, 1280}, {600, 600}, {400, 1200}, {1600, 300},  {2560, 1080}};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (unsigned variant = 0; variant < 6 * 15 * 8 * 3; variant++) {
            struct bead_look look;
            struct bead_movie_layout layout;
            struct bead_message msg = {""};
            bead_look_screen(&look, sizes[s][0], sizes[s][1], true);
            struct bead_movie_wants w = wants_of(&look, sizes[s][0], sizes[s][1]);
            w.chain_count = 1 + variant % 6;
            unsigned views = 1 + variant / 6 % 15, flags = variant / 90;
            for (int kind = 0; kind < BEAD_VIEW_KINDS; kind++) {
                if (views & (1u << kind))
                    w.views[w.view_count++] = bead_view_find((enum bead_view_kind)kind);
            }
            w.axes = flags & 1;
            w.title = w.headings = flags & 2;
            w.same_beads = flags & 4;
            w.caption_lines = (int)(flags / 8);
            w.caption_line = 1.4 * look.title;
            if (bead_movie_arrange(&w, &layout, &msg))
                fail_msg("%d x %d, %zu chains, %zu views: %s", w.width, w.height, w.chain_count, w.view_count, msg.text);
            check(&w, &layout);
            if (w.axes && w.caption_lines > 0 && !(layout.caption.height >= w.caption_lines * w.caption_line))
                fail_msg("%d x %d, %zu chains, %zu views: captions are dropped", w.width, w.height, w.chain_count, w.view_count);
            bead_movie_layout_free(&layout);
        }
    }
}

static void test_full_size_keeps_everything(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout layout;
    bead_look_screen(&look, 1920, 1080, true);
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
    assert_false(layout.chains[0].labels[2]); /* the lowest space-time view labels the beads for all */
    assert_true(layout.chains[1].labels[2]);
    assert_false(layout.chains[1].labels[0]);
    for (int v = 0; v < 3; v++)
        assert_true(layout.chains[1].plot[v].height >= 70);
    bead_movie_layout_free(&layout);
}

/* A bar explains colours; where there are none the plots have its room. */
static void test_bars_are_for_colours(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout with, without;
    bead_look_screen(&look, 1280, 720, true);
    struct bead_movie_wants w = wants_of(&look, 1280, 720);
    w.chain_count = 1;
    w.views[w.view_count++] = bead_view_find(BEAD_VIEW_PROFILE);
    assert_int_equal(bead_movie_arrange(&w, &with, NULL), BEAD_OK);
    w.colourless = true;
    assert_int_equal(bead_movie_arrange(&w, &without, NULL), BEAD_OK);
    assert_true(with.bar.width > 0 && without.bar.width == 0);
    assert_true(without.chains[0].plot[0].width > with.chains[0].plot[0].width + with.bar.width);
    bead_movie_layout_free(&with);
    bead_movie_layout_free(&without);
}

static void test_too_small(void **state)
{
    (void)state;
    struct bead_look look;
    struct bead_movie_layout layout;
    struct bead_message msg = {""};
    bead_look_screen(&look, 40, 5, true);
    struct bead_movie_wants w = wants_of(&look, 40, 5);
    w.chain_count = 6;
    w.views[w.view_count++] = bead_view_find(BEAD_VIEW_BEADS);
    assert_int_equal(bead_movie_arrange(&w, &layout, &msg), BEAD_ERROR_SCENE);
    assert_non_null(strstr(msg.text, "too small"));
    assert_null(layout.chains);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangles),
        cmocka_unit_test(test_full_size_keeps_everything),
        cmocka_unit_test(test_bars_are_for_colours),
        cmocka_unit_test(test_too_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
