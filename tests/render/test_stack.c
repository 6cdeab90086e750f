/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stacks of plots, which stills and movies lay out alike: heights fill the room, rows keep out of each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>

#include <cmocka.h>

#include "render/view/stack.h"

static const struct bead_stack_reach none[64];

static struct bead_stack stack_of(size_t rows, size_t views, const double *shares, const double *most)
{
    struct bead_stack stack = {.rows = rows, .views = views, .reach = none};
    for (size_t v = 0; v < views; v++) {
        stack.share[v] = shares[v];
        stack.most[v] = most[v];
    }
    return stack;
}

static void test_shares_divide_the_room(void **state)
{
    (void)state;
    struct bead_stack stack = stack_of(1, 2, (const double[]){1, 3}, (const double[]){INFINITY, INFINITY});
    assert_int_equal(bead_stack_divide(&stack, 400), 400);
    assert_int_equal(stack.height[0], 100);
    assert_int_equal(stack.height[1], 300);
}

/* What a view cannot use goes to the others; rounding takes a pixel at most. */
static void test_limits_leave_the_rest(void **state)
{
    (void)state;
    for (int room = 100; room < 1000; room++) {
        struct bead_stack stack = stack_of(1, 2, (const double[]){0.34, 0.22}, (const double[]){50, INFINITY});
        int used = bead_stack_divide(&stack, room);
        assert_true(used == room || used == room - 1);
        assert_int_equal(stack.height[0], 50);
        assert_int_equal(stack.height[0] + stack.height[1], used);
    }
}

/* A second view reaches its limit only when the first has given up its part. */
static void test_limits_follow_each_other(void **state)
{
    (void)state;
    struct bead_stack stack = stack_of(1, 3, (const double[]){1, 1, 1}, (const double[]){10, 110, INFINITY});
    assert_int_equal(bead_stack_divide(&stack, 300), 300);
    assert_int_equal(stack.height[0], 10);
    assert_int_equal(stack.height[1], 110);
    assert_int_equal(stack.height[2], 180);
    stack = stack_of(1, 2, (const double[]){1, 1}, (const double[]){10, 20});
    assert_int_equal(bead_stack_divide(&stack, 300), 30);
}

/* What is promised is given, though the others get less than their shares; without room the caller is told. */
static void test_promises_come_first(void **state)
{
    (void)state;
    struct bead_stack stack = stack_of(1, 3, (const double[]){1, 1, 2}, (const double[]){INFINITY, 60, INFINITY});
    stack.least[2] = 250.2;
    assert_int_equal(bead_stack_divide(&stack, 400), 400);
    assert_int_equal(stack.height[2], 251);
    assert_int_equal(stack.height[1], 60);
    assert_int_equal(stack.height[0], 89);
    assert_true(bead_stack_divide(&stack, 800) >= 799);
    assert_true(stack.height[2] > 251); /* its share is more */
    stack.least[0] = 200;
    assert_true(bead_stack_divide(&stack, 400) > 400);
}

/* Rows follow each other without overlap, and all of them take what was foreseen. */
static void test_rows_add_up(void **state)
{
    (void)state;
    static const struct bead_stack_reach reach[] = {{30.5, 2}, {3, 11.2}, {0, 0}, {7, 20}};
    struct bead_stack stack = stack_of(2, 2, (const double[]){1, 2}, (const double[]){INFINITY, INFINITY});
    stack.reach = reach;
    stack.heading = 25;
    stack.between_rows = 8;
    stack.between_views = 5;
    double y = 10;
    int used = bead_stack_divide(&stack, 200), bottom = (int)y;
    for (size_t r = 0; r < 2; r++) {
        struct bead_stack_places places;
        y += r > 0 ? stack.between_rows : 0;
        y = bead_stack_row(&stack, r, y, &places);
        assert_true(places.heading >= bottom);
        assert_true(places.plot[0] >= places.heading + 25 && places.plot[0] >= places.heading + reach[2 * r].above);
        assert_true(places.plot[1] >= places.plot[0] + stack.height[0] + reach[2 * r].below + reach[2 * r + 1].above);
        bottom = places.plot[1] + stack.height[1] + (int)reach[2 * r + 1].below;
        assert_true(y >= bottom);
    }
    assert_true(y - 10 == bead_stack_fixed(&stack) + 2 * used);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shares_divide_the_room),
        cmocka_unit_test(test_limits_leave_the_rest),
        cmocka_unit_test(test_limits_follow_each_other),
        cmocka_unit_test(test_promises_come_first),
        cmocka_unit_test(test_rows_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
