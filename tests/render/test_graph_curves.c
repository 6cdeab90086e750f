/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of graphs: points at their place, cut at the frame, interrupted where there is no value. */
#include "graphs.h"
#include "render/draw/looks.h"

/* ---- curves ---- */

static struct bead_panel plain_panel(const struct bead_series *series)
{
    return (struct bead_panel){.x = {"x", "", 0, 10, BEAD_SCALE_LINEAR, false},
                               .y = {"y", "", 0, 5, BEAD_SCALE_LINEAR, false},
                               .series = series,
                               .series_count = 1};
}

static int px_x(const struct graph_cell *cell, double x)
{
    return (int)(cell->plot.x + bead_axis_place(&cell->axis[0], x) * cell->plot.width);
}

static int px_y(const struct graph_cell *cell, double y)
{
    return (int)(cell->plot.y + (1 - bead_axis_place(&cell->axis[1], y)) * cell->plot.height);
}

static void test_points_stand_at_their_place(void **state)
{
    (void)state;
    static const double x[] = {2, 5, 7.5}, y[] = {1, 4, 2.5};
    static const enum bead_scale scales[] = {BEAD_SCALE_LINEAR, BEAD_SCALE_SQRT, BEAD_SCALE_LOG};
    for (size_t s = 0; s < 3; s++) {
        for (size_t shape = 0; shape < 8; shape++) {
            struct bead_series series = {.x = x, .y = y, .count = 3, .mark = BEAD_MARK_POINTS, .colour = shape, .shape = shape};
            struct bead_panel panel = plain_panel(&series);
            struct bead_graph graph = {.panels = &panel, .panel_count = 1};
            struct bead_look look;
            panel.y.scale = scales[s];
            panel.y.low = s == 2 ? 0.5 : 0;
            bead_look_screen(&look, 1600, 1200, shape % 2);
            struct canvas c = make_canvas(1600, 1200);
            draw(&graph, &look, &c);
            struct graph_layout layout = lay_out(&graph, &look, 1600, 1200);
            uint32_t ink = packed(bead_look_curve(&look, shape)), ground = packed(look.dark ? look.panel : look.background);
            for (int i = 0; i < 3; i++) {
                int px = px_x(&layout.cells[0], x[i]), py = px_y(&layout.cells[0], y[i]);
                if (!near(pixel(&c, px, py), shape == 6 ? ground : ink)) /* rings are hollow */
                    fail_msg("shape %zu, scale %zu: point %d is not at its place", shape, s, i);
                int right = px;
                while (shape == 6 && right < px + 20 && !near(pixel(&c, right, py), ink))
                    right++;
                assert_true(right < px + 20);
            }
            graph_layout_free(&layout);
            free_canvas(&c);
        }
    }
}

/* What lies outside the axes leaves no trace outside of the frame, and what crosses it is there inside. */
static void test_curves_are_cut_at_the_frame(void **state)
{
    (void)state;
    static const double x[] = {-1e9, 5, 1e9, 5, 5}, y[] = {-1e12, 2.5, 1e12, 1e300, -1e300};
    static const double none[] = {NAN, NAN, NAN, NAN, NAN}, error[] = {1, 1e9, 1, 1, 1};
    struct bead_series series = {.x = x, .y = y, .error = error, .count = 5, .mark = BEAD_MARK_LINE_POINTS};
    struct bead_panel panel = plain_panel(&series);
    struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    struct bead_look look;
    bead_look_screen(&look, 640, 480, false);
    struct canvas c = make_canvas(640, 480), empty = make_canvas(640, 480);
    draw(&graph, &look, &c);
    series.y = none;
    draw(&graph, &look, &empty);
    struct graph_layout layout = lay_out(&graph, &look, 640, 480);
    const struct bead_rect *plot = &layout.cells[0].plot;
    int inside = 0;
    for (int py = 0; py < 480; py++) {
        for (int px = 0; px < 640; px++) {
            bool in = px >= plot->x && px < plot->x + plot->width && py >= plot->y && py < plot->y + plot->height;
            bool same = pixel(&c, px, py) == pixel(&empty, px, py);
            if (!in && !same)
                fail_msg("pixel %d, %d outside of the frame is drawn on", px, py);
            inside += !same;
        }
    }
    assert_true(inside > plot->height); /* the upright line and the bar at x = 5 */
    assert_false(pixel(&c, px_x(&layout.cells[0], 5), plot->y + 2) == pixel(&empty, px_x(&layout.cells[0], 5), plot->y + 2));
    graph_layout_free(&layout);
    free_canvas(&c);
    free_canvas(&empty);
}

/* Where curves with marks lie on each other, one line is drawn: dashes on dashes look like none of them. Beyond, each has its own.
 */
static void test_lines_on_each_other_are_one(void **state)
{
    (void)state;
    enum { POINTS = 401 };
    static double x[POINTS], y[2][POINTS];
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = 10.0 * (double)i / (POINTS - 1);
        y[0][i] = 2.5;
        y[1][i] = x[i] < 5 ? 2.5 : 1.5;
    }
    struct bead_series series[2];
    for (size_t s = 0; s < 2; s++)
        series[s] = (struct bead_series){
            .x = x, .y = y[s], .count = POINTS, .mark = BEAD_MARK_LINE_POINTS, .colour = s, .shape = s, .dash = s};
    struct bead_panel panel = plain_panel(series);
    panel.series_count = 2;
    struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    struct bead_look look;
    bead_look_screen(&look, 1200, 900, false);
    struct canvas c = make_canvas(1200, 900);
    draw(&graph, &look, &c);
    struct graph_layout layout = lay_out(&graph, &look, 1200, 900);
    int inked[2] = {0, 0}, marked = 0; /* of the second curve, left and right, in the rows of the lines */
    for (int px = px_x(&layout.cells[0], 0.1); px < px_x(&layout.cells[0], 9.9); px++) {
        const bool right = px > px_x(&layout.cells[0], 5);
        const int py = px_y(&layout.cells[0], right ? 1.5 : 2.5), above = py - (int)(0.7 * graph_full_point(&look));
        const uint32_t ink = packed(bead_look_curve(&look, 1));
        marked += !right && near(pixel(&c, px, above), ink);
        inked[right] += near(pixel(&c, px, py), ink) && !near(pixel(&c, px, above), ink);
    }
    assert_true(marked > 10); /* its marks are on the first one's line */
    if (!(inked[0] < 0.1 * inked[1]))
        fail_msg("%d pixels of the second line on the first, %d beside it", inked[0], inked[1]);
    graph_layout_free(&layout);
    free_canvas(&c);
}

static void test_no_value_is_a_gap(void **state)
{
    (void)state;
    enum { MANY = 20000 }; /* also where several values share a pixel */
    static double x[MANY], y[MANY];
    for (int few = 0; few < 2; few++) {
        size_t count = few ? 101 : MANY;
        for (size_t i = 0; i < count; i++) {
            x[i] = 10.0 * (double)i / (double)(count - 1);
            y[i] = x[i] > 4 && x[i] < 6 ? NAN : 2.5;
        }
        struct bead_series series = {.x = x, .y = y, .count = count, .mark = BEAD_MARK_LINE};
        struct bead_panel panel = plain_panel(&series);
        struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        struct bead_look look;
        bead_look_screen(&look, 1200, 900, false);
        struct canvas c = make_canvas(1200, 900);
        draw(&graph, &look, &c);
        struct graph_layout layout = lay_out(&graph, &look, 1200, 900);
        const struct graph_cell *cell = &layout.cells[0];
        uint32_t ink = packed(bead_look_curve(&look, 0)), white = packed(look.background);
        for (double at = 0.1; at < 9.9; at += 0.1) {
            bool gap = at > 4.05 && at < 5.95, line = at < 3.95 || at > 6.05;
            uint32_t found = pixel(&c, px_x(cell, at), px_y(cell, 2.5));
            if ((gap && found != white) || (line && !near(found, ink)))
                fail_msg("%zu values: at %g the picture has %06x", count, at, found);
        }
        graph_layout_free(&layout);
        free_canvas(&c);
    }
}

/* A spike of one among many thousand values reaches its height. */
static void test_spikes_of_dense_curves_show(void **state)
{
    (void)state;
    enum { MANY = 100000 };
    static double x[MANY], y[MANY];
    for (size_t i = 0; i < MANY; i++) {
        x[i] = 10.0 * (double)i / (MANY - 1);
        y[i] = i == 70007 ? 4.5 : 1;
    }
    struct bead_series series = {.x = x, .y = y, .count = MANY, .mark = BEAD_MARK_LINE};
    struct bead_panel panel = plain_panel(&series);
    struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    struct bead_look look;
    bead_look_screen(&look, 640, 480, false);
    struct canvas c = make_canvas(640, 480);
    draw(&graph, &look, &c);
    struct graph_layout layout = lay_out(&graph, &look, 640, 480);
    int px = px_x(&layout.cells[0], x[70007]), py = px_y(&layout.cells[0], 4);
    assert_true(pixel(&c, px, py) != packed(look.background) || pixel(&c, px - 1, py) != packed(look.background));
    graph_layout_free(&layout);
    free_canvas(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_stand_at_their_place), cmocka_unit_test(test_curves_are_cut_at_the_frame),
        cmocka_unit_test(test_lines_on_each_other_are_one), cmocka_unit_test(test_no_value_is_a_gap),
        cmocka_unit_test(test_spikes_of_dense_curves_show),
    };
    return cmocka_run_group_tests_name("curves", tests, NULL, NULL);
}
