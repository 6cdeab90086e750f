/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of labels in schematic drawings: near their anchors, in order, never over each other. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "render/schematic/schematic_sketch.h"

static void labels_keep_their_places(void **state)
{
    (void)state;
    struct bead_label labels[] = {{20, 10, 0}, {60, 20, 0}, {100, 10, 0}};
    assert_true(bead_labels_spread(labels, 3, 5, 0, 200));
    assert_true(labels[0].x == 15 && labels[1].x == 50 && labels[2].x == 95);
    struct bead_label crowd[] = {{50, 20, 0}, {50, 20, 0}, {50, 20, 0}}; /* around their anchors */
    assert_true(bead_labels_spread(crowd, 3, 4, 0, 200));
    assert_true(crowd[0].x == 16 && crowd[1].x == 40 && crowd[2].x == 64);
    struct bead_label corner[] = {{0, 20, 0}, {2, 20, 0}, {90, 20, 0}};
    assert_true(bead_labels_spread(corner, 3, 4, 0, 100));
    assert_true(corner[0].x == 0 && corner[1].x == 24 && corner[2].x == 80);
    assert_false(bead_labels_spread(corner, 3, 30, 0, 100));
    assert_true(bead_labels_spread(corner, 0, 30, 0, 100));
}

static void labels_never_overlap(void **state)
{
    (void)state;
    unsigned seed = 12345;
    for (int round = 0; round < 500; round++) {
        struct bead_label labels[30];
        size_t count = 1 + (size_t)round % 30;
        double total = 0, anchor = 0;
        for (size_t i = 0; i < count; i++) {
            seed = seed * 1103515245u + 12345u;
            labels[i].width = 5 + (seed >> 16) % 40;
            anchor += (seed >> 8) % (round % 3 == 0 ? 10 : 60);
            labels[i].anchor = anchor;
            total += labels[i].width + 3;
        }
        double high = total + round % 50;
        assert_true(bead_labels_spread(labels, count, 3, 0, high));
        for (size_t i = 0; i < count; i++) {
            assert_true(labels[i].x >= -1e-9 && labels[i].x + labels[i].width <= high + 1e-9);
            assert_true(i == 0 || labels[i].x >= labels[i - 1].x + labels[i - 1].width + 3 - 1e-9);
        }
    }
}

static void crowded_texts_are_noticed(void **state)
{
    (void)state;
    struct bead_box boxes[3] = {{10, 10, 20, 10}, {30, 10, 20, 10}, {10, 20, 20, 10}};
    struct bead_sketch sketch = {.boxes = boxes, .count = 3};
    assert_false(bead_sketch_crowded(&sketch, 50, 30)); /* they touch each other and the border */
    assert_true(bead_sketch_crowded(&sketch, 49, 30));
    assert_true(bead_sketch_crowded(&sketch, 50, 29));
    boxes[2].y = 19;
    assert_true(bead_sketch_crowded(&sketch, 50, 30));
    boxes[2].y = 20;
    boxes[1].x = 29;
    assert_true(bead_sketch_crowded(&sketch, 50, 30));
    boxes[1].x = 30;
}

static void cells_are_named_by_their_beads(void **state)
{
    (void)state;
    static const char *const one[] = {"bead", "dimer", "trimer", "tetramer", "pentamer", "cell", "cell"};
    for (size_t beads = 1; beads <= sizeof one / sizeof *one; beads++) {
        char several[16];
        snprintf(several, sizeof several, "%ss", one[beads - 1]);
        assert_string_equal(bead_cell_word(beads, false), one[beads - 1]);
        assert_string_equal(bead_cell_word(beads, true), several);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_keep_their_places),
        cmocka_unit_test(labels_never_overlap),
        cmocka_unit_test(crowded_texts_are_noticed),
        cmocka_unit_test(cells_are_named_by_their_beads),
    };
    return cmocka_run_group_tests_name("schematic labels", tests, NULL, NULL);
}
