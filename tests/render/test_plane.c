/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values at points of a plane: each has the box that ends half-way to its neighbours, on linear and logarithmic axes, also if
 * columns have different rows; and a graph shows it there. */
#include "graphs.h"
#include "render/draw/looks.h"
#include "render/plot/sweep_plot.h"

static void assert_near(double value, double expected, double error)
{
    if (!(fabs(value - expected) <= error))
        fail_msg("%.17g is not %.17g", value, expected);
}

/* Given in no order. Three rows at x = 8, two at 32 and one at 64, whose boxes end at 16 and 45.25 on a logarithmic axis, at 20 and
 * 48 on a linear one. */
static const struct bead_plane_point given[] = {{32, 0, 4}, {8, 0.25, 2}, {64, 0.5, 6}, {8, 0, 1}, {32, 1, 5}, {8, 1, 3}};
enum { COUNT = sizeof given / sizeof *given };

/* The value whose box holds a place: each bound is half way. */
static double value_at(double x, double y, bool logarithmic)
{
    if (x < (logarithmic ? 16 : 20))
        return y < 0.125 ? 1 : y < 0.625 ? 2 : 3;
    if (x < (logarithmic ? sqrt(32 * 64) : 48))
        return y < 0.5 ? 4 : 5;
    return 6;
}

static double shown(const struct bead_graph_image *image, const double ends[2][2], double x, double y, bool logarithmic)
{
    const double part = logarithmic ? (log10(x) - log10(ends[0][0])) / (log10(ends[0][1]) - log10(ends[0][0]))
                                    : (x - ends[0][0]) / (ends[0][1] - ends[0][0]);
    const double above = (y - ends[1][0]) / (ends[1][1] - ends[1][0]);
    assert_true(part > 0 && part < 1 && above > 0 && above < 1);
    return image->values[(size_t)(part * (double)image->columns) * image->rows + (size_t)(above * (double)image->rows)];
}

static void check(bool logarithmic)
{
    struct bead_message msg = {""};
    struct bead_plane_point points[COUNT];
    struct bead_graph_image image;
    double ends[2][2];
    memcpy(points, given, sizeof given);
    const enum bead_scale scales[2] = {logarithmic ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR, BEAD_SCALE_LINEAR};
    assert_int_equal(bead_plane_make(points, COUNT, scales, &image, ends, &msg), BEAD_OK);
    assert_near(ends[0][0], logarithmic ? 4 : -4, 1e-12);
    assert_near(ends[0][1], logarithmic ? 64 * sqrt(2) : 80, 1e-12);
    assert_near(ends[1][0], -0.5, 1e-12); /* of the column at 32 */
    assert_near(ends[1][1], 1.5, 1e-12);
    assert_true(image.low == 1);
    assert_true(image.high == 6);
    static const double xs[] = {5, 9, 15.8, 16.2, 19.7, 20.3, 44.9, 45.6, 47.5, 48.5, 79},
                        ys[] = {-0.4, 0.12, 0.13, 0.49, 0.51, 0.62, 0.63, 1.4};
    for (size_t i = 0; i < sizeof xs / sizeof *xs; i++) {
        for (size_t k = 0; k < sizeof ys / sizeof *ys; k++)
            assert_true(shown(&image, ends, xs[i], ys[k], logarithmic) == value_at(xs[i], ys[k], logarithmic));
    }
    free((double *)image.values);
}

static void boxes_end_half_way(void **)
{
    check(false);
    check(true);
}

/* Two values side by side on a logarithmic axis from 1/2 to 50: the border is at 5, half of the way. */
static void graphs_have_them_at_their_places(void **)
{
    struct bead_message msg = {""};
    struct bead_plane_point points[] = {{sqrt(2.5), 0, 0}, {sqrt(250), 0, 1}};
    const enum bead_scale scales[2] = {BEAD_SCALE_LOG, BEAD_SCALE_LINEAR};
    struct bead_graph_image image;
    struct bead_look look;
    double ends[2][2];
    assert_int_equal(bead_plane_make(points, 2, scales, &image, ends, &msg), BEAD_OK);
    image.title = "values";
    image.unit = "";
    assert_near(ends[0][0], 0.5, 1e-12);
    assert_near(ends[0][1], 50, 1e-12);
    const struct bead_panel panel = {.x = {"x", "", ends[0][0], ends[0][1], BEAD_SCALE_LOG, false},
                                     .y = {"y", "", ends[1][0], ends[1][1], BEAD_SCALE_LINEAR, false},
                                     .image = &image};
    const struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    bead_look_screen(&look, 800, 600, false);
    struct canvas c = make_canvas(800, 600);
    struct graph_layout layout = lay_out(&graph, &look, c.width, c.height);
    draw(&graph, &look, &c);
    const struct bead_rect plot = layout.cells[0].plot;
    const int y = plot.y + plot.height / 2, middle = plot.x + plot.width / 2;
    const uint32_t left = pixel(&c, plot.x + 5, y), right = pixel(&c, plot.x + plot.width - 5, y);
    assert_false(near(left, right));
    for (int x = plot.x + 5; x < plot.x + plot.width - 5; x++) {
        if (x < middle - 2 || x > middle + 2)
            assert_true(near(pixel(&c, x, y), x < middle ? left : right));
    }
    graph_layout_free(&layout);
    free_canvas(&c);
    free((double *)image.values);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_end_half_way),
        cmocka_unit_test(graphs_have_them_at_their_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
