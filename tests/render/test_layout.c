/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of boxes in grids: lengths add up, and requests are met in their order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>

#include <cmocka.h>

#include "render/draw/layout.h"

enum { MOST = 6 };

static struct bead_lanes lanes_of(struct bead_lane *lane, size_t count, double length)
{
    return (struct bead_lanes){.lane = lane, .count = count, .length = length};
}

/* px that lanes take, from the first gap to the last label. */
static double taken(const struct bead_lanes *l)
{
    double px = bead_lanes_fixed(l);
    for (size_t i = 0; i < l->count; i++)
        px += l->lane[i].share > 0 ? l->lane[i].size : 0;
    return px;
}

static void test_shares_divide_the_length(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1}, {.share = 3}};
    struct bead_lanes two = lanes_of(lane, 2, 400);
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].size == 100 && lane[1].size == 300 && lane[0].at == 0 && lane[1].at == 100);
}

/* Rounding takes less than a pixel for each lane; lanes with equal wants are equally wide, whatever the length. */
static void test_lengths_add_up(void **state)
{
    (void)state;
    for (int length = 100; length < 1000; length++) {
        struct bead_lane lane[MOST];
        bead_lanes_want(lane, 3, (struct bead_lane){.gap = 4, .share = 0.34, .least = 5});
        bead_lanes_want(lane + 3, 2, (struct bead_lane){.gap = 2, .share = 0.22, .most = 50});
        lane[5] = (struct bead_lane){.gap = 3, .least = 16};
        struct bead_lanes all = lanes_of(lane, MOST, length);
        assert_true(bead_lanes_divide(&all));
        assert_true(taken(&all) <= length && taken(&all) > length - 5);
        assert_true(lane[0].size == lane[1].size && lane[1].size == lane[2].size && lane[3].size == lane[4].size);
        assert_true(lane[5].size == 16 && lane[5].at + 16 == taken(&all));
        for (size_t i = 1; i < MOST; i++)
            assert_true(lane[i].at == lane[i - 1].at + lane[i - 1].size + lane[i].gap);
    }
}

/* Room that a lane cannot use goes to the others; a second one reaches its limit only when the first has given up its part. */
static void test_limits_follow_each_other(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1, .most = 10}, {.share = 1, .most = 110}, {.share = 1}};
    struct bead_lanes three = lanes_of(lane, 3, 300), two = lanes_of(lane, 2, 300);
    assert_true(bead_lanes_divide(&three));
    assert_true(lane[0].size == 10 && lane[1].size == 110 && lane[2].size == 180);
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].size == 10 && lane[1].size == 110); /* and 180 px are left */
}

/* `least` goes before `most`, and that before shares; a lack of room is reported to the caller. */
static void test_wants_have_an_order(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1}, {.share = 1, .most = 60}, {.share = 2, .least = 250.2}};
    struct bead_lanes three = lanes_of(lane, 3, 400);
    assert_true(bead_lanes_divide(&three));
    assert_true(lane[0].size == 89 && lane[1].size == 60 && lane[2].size == 251);
    three.length = 800;
    assert_true(bead_lanes_divide(&three));
    assert_true(lane[2].size > 251); /* its share is more */
    lane[0].least = 200;
    three.length = 400;
    assert_false(bead_lanes_divide(&three));
    assert_true(lane[0].size == 200 && lane[2].size == 251);
    three.length = 451;
    assert_true(bead_lanes_divide(&three)); /* not a pixel more is needed */
    assert_true(lane[1].size == 0);
    lane[0] = (struct bead_lane){.share = 1, .most = 10};
    lane[1] = (struct bead_lane){.share = 1, .least = 60};
    struct bead_lanes two = lanes_of(lane, 2, 100);
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].size == 10 && lane[1].size == 90); /* the rest of the first; nothing is empty */
}

/* Labels and gaps are not plots. */
static void test_gaps_have_no_room(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1, .least = 1, .reach = {20, 20}}, {.gap = 8, .share = 1, .least = 1}};
    struct bead_lanes two = lanes_of(lane, 2, 49);
    assert_false(bead_lanes_divide(&two));
    two.length = 50;
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].at == 20 && lane[0].size == 1 && lane[1].at == 49 && lane[1].size == 1);
}

/* Springs take what no lane can use, and nothing else. */
static void test_springs_spread_the_rest(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1, .most = 30, .spring = 0.5}, {.share = 1, .most = 30, .spring = 1}};
    struct bead_lanes two = lanes_of(lane, 2, 101);
    two.from = 7;
    two.spring = 0.5;
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].at == 7 + 10 && lane[1].at == 7 + 10 + 30 + 20);
    two.length = 60;
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].at == 7 && lane[1].at == 37);
    two.length = 50;
    assert_true(bead_lanes_divide(&two));
    assert_true(lane[0].at == 7 && lane[1].at == 32);
}

/* Rows with their own columns begin anew, and each has the whole length. */
static void test_lines_have_columns_of_their_own(void **state)
{
    (void)state;
    struct bead_lane lane[MOST] = {{.share = 1}, {.share = 1}, {.line = 1, .share = 1, .least = 90}};
    struct bead_lanes three = lanes_of(lane, 3, 100);
    three.from = 3;
    assert_true(bead_lanes_divide(&three));
    assert_true(lane[0].at == 3 && lane[1].at == 53 && lane[2].at == 3 && lane[2].size == 100);
    three.length = 80;
    assert_false(bead_lanes_divide(&three));
}

/* A lane leaves room for the longest label; a box over several lanes reaches out of the first and of the last. */
static void test_boxes_make_room_for_labels(void **state)
{
    (void)state;
    struct bead_message msg;
    struct bead_layout_grid grid;
    assert_int_equal(bead_layout_make(2, 2, 3, &grid, &msg), BEAD_OK);
    bead_lanes_want(grid.columns.lane, 2, (struct bead_lane){.gap = 5, .share = 1, .keep = {3, 3}});
    bead_lanes_want(grid.rows.lane, 2, (struct bead_lane){.gap = 5, .share = 1});
    grid.columns.length = grid.rows.length = 200;
    grid.columns.from = 1000;
    grid.boxes[0] = (struct bead_layout_box){.column = 0, .row = 0, .reach = {10.5, 1, 0, 0}};
    grid.boxes[1] = (struct bead_layout_box){.column = 1, .row = 0, .reach = {2, 4, 6, 0}};
    grid.boxes[2] = (struct bead_layout_box){.column = 0, .row = 1, .columns = 2, .reach = {12, 0, 8, 9}};
    bead_layout_reach(&grid, false);
    assert_true(bead_layout_divide(&grid, NULL));
    const struct bead_rect *a = &grid.boxes[0].at, *b = &grid.boxes[1].at, *both = &grid.boxes[2].at;
    assert_int_equal(a->width, (200 - 12 - 3 - 5 - 3 - 8) / 2);
    assert_int_equal(a->height, (200 - 4 - 5 - 9) / 2);
    assert_true(a->x == 1012 && a->y == 4 && b->y == 4 && b->x == a->x + a->width + 3 + 5 + 3);
    assert_true(both->x == a->x && both->width == b->x + b->width - a->x && both->y == a->y + a->height + 5);
    struct bead_insets in = bead_layout_insets(&grid, (struct bead_rect){1000, 0, 200, 200});
    assert_true(in.left == 12 && in.top == 4 && in.bottom == 9 && in.right >= 8 && in.right < 10);
    bead_layout_free(&grid);
}

/* An owner whose labels take a tenth of the width of their box, but are shorter in one of its measurements. */
struct owner {
    struct bead_layout_grid grid;
    int measured, shorter;
};

static enum bead_error measure(void *user, struct bead_message *msg)
{
    struct owner *o = user;
    (void)msg;
    o->grid.boxes[0].reach.left = 0.1 * o->grid.boxes[0].at.width - (o->measured == o->shorter ? 5 : 0);
    o->measured++;
    return BEAD_OK;
}

static enum bead_error no_room(void *user, struct bead_message *msg)
{
    (void)user;
    return bead_fail(msg, BEAD_ERROR_SCENE, "no room");
}

static enum bead_error settle(struct owner *o, double least, bool grow, struct bead_message *msg)
{
    assert_int_equal(bead_layout_make(1, 1, 1, &o->grid, msg), BEAD_OK);
    o->grid.columns.lane[0] = (struct bead_lane){.share = 1, .least = least};
    o->grid.rows.lane[0] = (struct bead_lane){.share = 1};
    o->grid.columns.length = o->grid.rows.length = 110;
    return bead_layout_settle(&o->grid, 2, grow, &(struct bead_layout_owner){.user = o, .measure = measure, .no_room = no_room},
                              msg);
}

/* After the passes that may make room for labels smaller it only grows, until nothing does. */
static void test_room_for_labels_settles(void **state)
{
    (void)state;
    struct bead_message msg;
    struct owner twice = {.shorter = 1}, grown = {.shorter = 2}, none = {.shorter = -1};
    assert_int_equal(settle(&twice, 0, false, &msg), BEAD_OK);
    assert_int_equal(twice.measured, 2);
    assert_int_equal(twice.grid.boxes[0].at.width, 110 - 5); /* the last measurement counts: 9.9 - 5 */
    assert_int_equal(settle(&grown, 0, true, &msg), BEAD_OK);
    assert_int_equal(grown.measured, 3);
    assert_int_equal(grown.grid.boxes[0].at.width, 110 - 10); /* not less than before */
    assert_int_equal(settle(&none, 105, true, &msg), BEAD_ERROR_SCENE);
    assert_string_equal(msg.text, "no room");
    bead_layout_free(&twice.grid);
    bead_layout_free(&grown.grid);
    bead_layout_free(&none.grid);
}

static void test_columns_have_the_best_shape(void **state)
{
    (void)state;
    struct bead_layout_area wide = {.width = 1600, .height = 400, .shape = 1, .empty = 1}, high = wide, full = wide, tiny = wide;
    assert_int_equal(bead_layout_columns(4, &wide), 4);
    high.height = 6400;
    assert_int_equal(bead_layout_columns(4, &high), 1);
    full.height = 1500;
    assert_int_equal(bead_layout_columns(3, &full), 2); /* a cell is empty, but the shapes are right */
    full.empty = 5;
    assert_int_equal(bead_layout_columns(3, &full), 3);
    tiny.around[0] = 2000;
    assert_int_equal(bead_layout_columns(4, &tiny), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares_divide_the_length),
        cmocka_unit_test(test_lengths_add_up),
        cmocka_unit_test(test_limits_follow_each_other),
        cmocka_unit_test(test_wants_have_an_order),
        cmocka_unit_test(test_gaps_have_no_room),
        cmocka_unit_test(test_springs_spread_the_rest),
        cmocka_unit_test(test_lines_have_columns_of_their_own),
        cmocka_unit_test(test_boxes_make_room_for_labels),
        cmocka_unit_test(test_room_for_labels_settles),
        cmocka_unit_test(test_columns_have_the_best_shape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
