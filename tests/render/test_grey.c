/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures in grey: every pair of curves in a panel of a ready figure is told apart by dashes or marks, without its colours. The
 * layouts of all figures pass through here (the Makefile wraps graph_layout_make). */
#include "graphs.h"

#include "ready_figures.h"
#include "render/plot/plot_private.h"

enum { LONG = 480, HIGH = 48, SAMPLES = 400 };

/* What has been seen of the figure being made. */
static struct {
    size_t pairs, alike;
    char why[256];
} seen;

/* A flat curve that looks like `series`, black on white; counted are pixels. */
static cairo_surface_t *flat(const struct bead_panel *panel, const struct bead_series *series)
{
    static double x[SAMPLES], y[SAMPLES], upper[SAMPLES];
    struct bead_look look;
    bead_look_paper(&look, 200);
    for (size_t i = 0; i < SAMPLES; i++) {
        x[i] = (double)i;
        y[i] = 0.5;
        upper[i] = 0.9;
    }
    struct bead_series alone = *series;
    alone.x = x;
    alone.y = y;
    alone.upper = upper;
    alone.error = NULL;
    alone.count = series->count < SAMPLES ? series->count : SAMPLES;
    alone.jitter = false;
    struct bead_panel single = {.series = &alone, .series_count = 1};
    struct graph_cell cell = {.panel = &single, .plot = {0, 0, LONG, HIGH}, .most_points = panel->series_count};
    bead_axis_make(&cell.axis[0], 0, (double)alone.count, "", BEAD_SCALE_LINEAR, LONG, look.tick, true);
    bead_axis_make(&cell.axis[1], 0, 1, "", BEAD_SCALE_LINEAR, HIGH, look.tick, false);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, LONG, HIGH); /* ink, whatever its colour */
    cairo_t *cr = cairo_create(surface);
    graph_draw_series(cr, &look, &cell, &alone);
    cairo_destroy(cr);
    cairo_surface_flush(surface);
    return surface;
}

/* Part of the pixels that carry ink in one picture only. */
static double difference(cairo_surface_t *a, cairo_surface_t *b)
{
    size_t ink = 0, one = 0;
    int stride = cairo_image_surface_get_stride(a);
    for (int py = 0; py < HIGH; py++) {
        for (int px = 0; px < LONG; px++) {
            bool in_a = cairo_image_surface_get_data(a)[py * stride + px] > 127;
            bool in_b = cairo_image_surface_get_data(b)[py * stride + px] > 127;
            ink += in_a || in_b;
            one += in_a != in_b;
        }
    }
    return ink > 0 ? (double)one / (double)ink : 0;
}

static const char *label_of(const struct bead_series *series)
{
    return series->label ? series->label : "";
}

/* Curves of one entry of the legend are of one kind, such as the marks of several configurations. */
static bool one_kind(const struct bead_series *a, const struct bead_series *b)
{
    return graph_look_alike(a, b) && (!a->label || !b->label || strcmp(a->label, b->label) == 0);
}

static bool is_drawn(const struct bead_series *series)
{
    for (size_t i = 0; i < series->count; i++) {
        if (isfinite(series->y[i]))
            return true;
    }
    return false;
}

static void look_at(const struct bead_panel *panel)
{
    enum { MOST = 32 };
    static const double least = 0.05; /* a disc instead of a diamond now and then on a line is .06 */
    const struct bead_series *series[MOST];
    cairo_surface_t *picture[MOST];
    size_t count = 0;
    for (size_t s = 0; s < panel->series_count && count < MOST; s++) {
        if (is_drawn(&panel->series[s])) {
            series[count] = &panel->series[s];
            picture[count++] = flat(panel, &panel->series[s]);
        }
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < i; k++) {
            if (one_kind(series[i], series[k]))
                continue;
            seen.pairs++;
            if (difference(picture[i], picture[k]) >= least)
                continue;
            seen.alike++;
            snprintf(seen.why, sizeof seen.why, "\"%.100s\" and \"%.100s\"", label_of(series[k]), label_of(series[i]));
        }
    }
    for (size_t i = 0; i < count; i++)
        cairo_surface_destroy(picture[i]);
}

enum bead_error __wrap_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg)
{
    for (size_t p = 0; p < graph->panel_count; p++)
        look_at(&graph->panels[p]);
    return __real_graph_layout_make(graph, look, width, height, frame, layout, msg);
}

static void test_ready_figures_are_told_apart_in_grey(void **state)
{
    (void)state;
    char directory[256];
    in_directory("", directory, sizeof directory);
    for (size_t i = 0; i < READY_FIGURES; i++) {
        const struct ready_figure *figure = &ready_figures[i];
        memset(&seen, 0, sizeof seen);
        play_figure(figure, directory);
        if (seen.alike > 0)
            fail_msg("%s: %zu of %zu pairs of curves look alike in grey, such as %s", figure->scene, seen.alike, seen.pairs,
                     seen.why);
        if (seen.pairs < figure->least_pairs)
            fail_msg("%s: %zu pairs of curves seen, not %zu", figure->scene, seen.pairs, figure->least_pairs);
    }
}

/* Any number of lines and of marks, up to what the table of dashes and that of shapes give together. */
static void test_many_curves_are_told_apart(void **state)
{
    (void)state;
    enum { MANY = 30 };
    static const enum bead_mark marks[] = {BEAD_MARK_LINE, BEAD_MARK_LINE_POINTS};
    static char labels[MANY][8];
    for (size_t m = 0; m < 2; m++) {
        static const double zeros[SAMPLES];
        struct bead_series series[MANY];
        struct bead_panel panel = {.series = series, .series_count = MANY};
        memset(&seen, 0, sizeof seen);
        for (size_t k = 0; k < MANY; k++) {
            snprintf(labels[k], sizeof labels[k], "%zu", k);
            series[k] = (struct bead_series){.y = zeros, .count = SAMPLES, .mark = marks[m], .label = labels[k]};
            plot_tell_apart(&series[k], k);
        }
        look_at(&panel);
        assert_int_equal(seen.pairs, MANY * (MANY - 1) / 2);
        if (seen.alike > 0)
            fail_msg("marks %zu: %zu pairs look alike, such as %s", m, seen.alike, seen.why);
    }
}

/* The test can fail: colours alone do not count. */
static void test_colours_do_not_count(void **state)
{
    (void)state;
    static const double zeros[SAMPLES];
    struct bead_series series[2] = {{.y = zeros, .count = SAMPLES, .mark = BEAD_MARK_LINE, .label = "a"},
                                    {.y = zeros, .count = SAMPLES, .mark = BEAD_MARK_LINE, .colour = 1, .label = "b"}};
    struct bead_panel panel = {.series = series, .series_count = 2};
    memset(&seen, 0, sizeof seen);
    look_at(&panel);
    assert_int_equal(seen.alike, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_colours_do_not_count),
        cmocka_unit_test(test_many_curves_are_told_apart),
        cmocka_unit_test(test_ready_figures_are_told_apart_in_grey),
    };
    return cmocka_run_group_tests_name("grey", tests, make_directory, remove_directory);
}
