/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values as colours in a graph: each has its colour, at its place on the axes. */
#include "beadreel/render.h"
#include "graphs.h"
#include "render/draw/looks.h"

enum { COLUMNS = 4, ROWS = 3 };

static uint32_t colour_of(const struct bead_colormap *map, double part)
{
    const uint8_t *rgb = map->rgb[(int)fmin(255, 256 * part)];
    return (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
}

/* Columns at 0.5 to 3.5 of an axis from 0 to 4, rows at 10 to 30 of one from 5 to 35: equal boxes. */
static void check(bool dark)
{
    struct bead_message msg = {""};
    struct bead_colormap map;
    struct bead_look look;
    double values[COLUMNS * ROWS];
    for (int i = 0; i < COLUMNS * ROWS; i++)
        values[i] = -60 + 5.0 * i;
    const struct bead_graph_image image = {{0.5, 3.5}, {10, 30}, COLUMNS, ROWS, values, -60, 0, "amplitude", "dB"};
    const struct bead_panel panel = {.x = {"time", "s", 0, 4, BEAD_SCALE_LINEAR, false},
                                     .y = {"frequency", "Hz", 5, 35, BEAD_SCALE_LINEAR, false},
                                     .image = &image};
    const struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    bead_look_screen(&look, 800, 600, dark);
    assert_int_equal(bead_colormap_load(dark ? "inferno" : "ember", &map, &msg), BEAD_OK);
    struct canvas c = make_canvas(800, 600);
    struct graph_layout layout = lay_out(&graph, &look, c.width, c.height);
    draw(&graph, &look, &c);
    const struct bead_rect plot = layout.cells[0].plot;
    assert_true(plot.x + plot.width < c.width - 40); /* the bar's room */
    for (int i = 0; i < COLUMNS; i++) {
        for (int j = 0; j < ROWS; j++) {
            const int x = plot.x + (int)((i + 0.5) / COLUMNS * plot.width),
                      y = plot.y + (int)((ROWS - j - 0.5) / ROWS * plot.height);
            const double part = (values[i * ROWS + j] + 60) / 60;
            assert_true(near(pixel(&c, x, y), colour_of(&map, part)));
            assert_true(near(pixel(&c, x - plot.width / 10, y - plot.height / 8), colour_of(&map, part))); /* still its box */
            /* Up to the very edges. */
            assert_true(near(pixel(&c,
                                   i == 0             ? plot.x
                                   : i + 1 == COLUMNS ? plot.x + plot.width - 1
                                                      : x,
                                   y),
                             colour_of(&map, part)));
            assert_true(near(pixel(&c, x, j == 0 ? plot.y + plot.height - 1 : j + 1 == ROWS ? plot.y : y), colour_of(&map, part)));
        }
    }
    /* Beside it the bar, from its lowest colour to its highest, whose ends are as wide as its middle: no value is beyond them. */
    const uint32_t ends[2] = {colour_of(&map, 1), colour_of(&map, 0)}, half = colour_of(&map, 0.5);
    int wide = 0, widths[2] = {0, 0}, low = -1, high = -1;
    for (int x = plot.x + plot.width + 2; x < c.width; x++) {
        wide += near(pixel(&c, x, plot.y + plot.height / 2), half);
        for (int y = 0; y < c.height; y++) {
            high = near(pixel(&c, x, y), ends[0]) && (high < 0 || y < high) ? y : high;
            low = near(pixel(&c, x, y), ends[1]) && y > low ? y : low;
        }
    }
    for (int x = plot.x + plot.width + 2; x < c.width; x++) {
        widths[0] += near(pixel(&c, x, high), ends[0]);
        widths[1] += near(pixel(&c, x, low), ends[1]);
    }
    assert_true(wide > 5 && widths[0] == wide && high == plot.y);
    if (dark) /* else the lowest has the colour of the page */
        assert_true(widths[1] == wide && low == plot.y + plot.height - 1);
    graph_layout_free(&layout);
    free_canvas(&c);
}

static void values_have_their_colours_at_their_places(void **)
{
    check(false);
    check(true);
}

/* Of many values in a pixel, along either axis, the largest is seen. */
static void lines_thinner_than_pixels_are_seen(void **)
{
    enum { MANY = 5000, LINE = 2500 };
    static double values[2 * MANY];
    for (int across = 0; across < 2; across++) {
        struct bead_message msg = {""};
        struct bead_colormap map;
        struct bead_look look;
        for (int i = 0; i < 2 * MANY; i++)
            values[i] = (across ? i / 2 : i % MANY) == LINE ? 0 : -60;
        const struct bead_graph_image along = {{0.5, 1.5}, {0, MANY - 1}, 2, MANY, values, -60, 0, "amplitude", "dB"},
                                      level = {{0, MANY - 1}, {0.5, 1.5}, MANY, 2, values, -60, 0, "amplitude", "dB"};
        const struct bead_graph_axis few = {"time", "s", 0, 2, BEAD_SCALE_LINEAR, false},
                                     many = {"frequency", "Hz", 0, MANY - 1, BEAD_SCALE_LINEAR, false};
        const struct bead_panel panel = {.x = across ? many : few, .y = across ? few : many, .image = across ? &level : &along};
        const struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        bead_look_screen(&look, 600, 400, false);
        assert_int_equal(bead_colormap_load("ember", &map, &msg), BEAD_OK);
        struct canvas c = make_canvas(600, 400);
        struct graph_layout layout = lay_out(&graph, &look, c.width, c.height);
        draw(&graph, &look, &c);
        const struct bead_rect plot = layout.cells[0].plot;
        const int length = across ? plot.width : plot.height;
        int dark = 0, place = 0;
        for (int i = 0; i < length; i++) {
            const int x = across ? plot.x + i : plot.x + plot.width / 4,
                      y = across ? plot.y + plot.height / 4 : plot.y + plot.height - 1 - i;
            if (near(pixel(&c, x, y), colour_of(&map, 1))) {
                dark++;
                place = i;
            }
        }
        assert_true(dark == 1 && place == (int)((double)LINE / (MANY - 1) * length));
        graph_layout_free(&layout);
        free_canvas(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(values_have_their_colours_at_their_places),
                                       cmocka_unit_test(lines_thinner_than_pixels_are_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
