/* Graphs: words that hide nothing and leave no page, axes that are shared, curves that are cut and interrupted, points at their
 * place. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "render/graph_private.h"
#include "render/markup.h"

enum { N = 21, CURVES = 7 };

/* Seven curves with error bars that cross each other. */
struct data {
    double x[N], y[CURVES][N], error[N];
    char labels[CURVES][64];
    struct bead_series series[CURVES];
};

static void make_data(struct data *d)
{
    memset(d, 0, sizeof *d);
    for (int i = 0; i < N; i++) {
        d->x[i] = i / 20.0;
        d->error[i] = 0.4 + 0.3 * sin(i);
        for (int k = 0; k < CURVES; k++)
            d->y[k][i] = 20 - 10 * d->x[i] + 6 * d->x[i] * d->x[i] + 3 * k + 2 * sin(3 * i + k);
    }
    for (size_t k = 0; k < CURVES; k++) {
        snprintf(d->labels[k], sizeof d->labels[k], "*N*_{total} = %d, configuration %d", 16 << k, (int)k);
        d->series[k] = (struct bead_series){.x = d->x,
                                            .y = d->y[k],
                                            .error = k < 3 ? d->error : NULL,
                                            .count = N,
                                            .mark = BEAD_MARK_LINE_POINTS,
                                            .colour = k,
                                            .shape = k,
                                            .label = d->labels[k]};
    }
}

static struct bead_panel make_panel(const struct data *d, size_t curves)
{
    return (struct bead_panel){.x = {"magnetism *M*", "", NAN, NAN, BEAD_SCALE_LINEAR, false},
                               .y = {"peak force *F*_m", "N", NAN, NAN, BEAD_SCALE_LINEAR, true},
                               .series = d->series,
                               .series_count = curves};
}

struct canvas {
    cairo_surface_t *surface;
    cairo_t *cr;
    int width, height;
};

static struct canvas make_canvas(int width, int height)
{
    struct canvas c = {cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), NULL, width, height};
    c.cr = cairo_create(c.surface);
    return c;
}

static void free_canvas(struct canvas *c)
{
    cairo_destroy(c->cr);
    cairo_surface_destroy(c->surface);
}

static uint32_t pixel(const struct canvas *c, int x, int y)
{
    const unsigned char *row =
        cairo_image_surface_get_data(c->surface) + (size_t)y * (size_t)cairo_image_surface_get_stride(c->surface);
    uint32_t value;
    memcpy(&value, row + 4 * (size_t)x, 4);
    return value & 0xFFFFFF;
}

static uint32_t packed(struct bead_rgb colour)
{
    return (uint32_t)lround(255 * colour.r) << 16 | (uint32_t)lround(255 * colour.g) << 8 | (uint32_t)lround(255 * colour.b);
}

static bool near(uint32_t a, uint32_t b)
{
    int apart = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int difference = abs((int)(a >> shift & 255) - (int)(b >> shift & 255));
        apart = difference > apart ? difference : apart;
    }
    return apart <= 2;
}

static void draw(const struct bead_graph *graph, const struct bead_look *look, struct canvas *c)
{
    struct bead_message msg = {""};
    if (bead_graph_draw(graph, look, c->cr, c->width, c->height, &msg))
        fail_msg("%s", msg.text);
    cairo_surface_flush(c->surface);
}

static struct graph_layout lay_out(const struct bead_graph *graph, const struct bead_look *look, double width, double height)
{
    struct bead_message msg = {""};
    struct graph_layout layout;
    if (graph_layout_make(graph, look, width, height, NULL, &layout, &msg))
        fail_msg("%s", msg.text);
    return layout;
}

/* ---- words ---- */

enum { MOST_TEXTS = 400 };

struct texts {
    size_t count;
    struct text {
        char markup[80];
        double x, y, width, height;
    } text[MOST_TEXTS];
};

static void note(void *context, const char *markup, double x, double y, double width, double height)
{
    struct texts *texts = context;
    if (width <= 0)
        return;
    assert_true(texts->count < MOST_TEXTS);
    struct text *text = &texts->text[texts->count++];
    snprintf(text->markup, sizeof text->markup, "%s", markup);
    text->x = x;
    text->y = y;
    text->width = width;
    text->height = height;
}

static void assert_apart(const struct texts *texts, const char *what, double width, double height)
{
    for (size_t i = 0; i < texts->count; i++) {
        const struct text *a = &texts->text[i];
        if (a->x < 0 || a->y < 0 || a->x + a->width > width || a->y + a->height > height)
            fail_msg("%s: '%s' leaves the page: %g, %g and %g x %g", what, a->markup, a->x, a->y, a->width, a->height);
        for (size_t j = 0; j < i; j++) {
            const struct text *b = &texts->text[j];
            if (a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height)
                fail_msg("%s: '%s' and '%s' collide", what, a->markup, b->markup);
        }
    }
}

/* Words and legends inside of panels lie on nothing that is drawn there. */
static void assert_nothing_hidden(const struct graph_layout *layout, const char *what)
{
    struct bead_message msg = {""};
    for (size_t p = 0; p < layout->graph->panel_count; p++) {
        const struct graph_cell *cell = &layout->cells[p];
        struct graph_mask mask;
        assert_int_equal(graph_mask_make(cell, layout->look, &mask, &msg), BEAD_OK);
        for (size_t r = 0; r < cell->panel->ruler_count; r++) {
            if (cell->words[r].state == GRAPH_WORD_PLACED && graph_mask_covered(&mask, cell->words[r].box) > 0)
                fail_msg("%s: the word '%s' hides something", what, cell->words[r].markup);
        }
        if (cell->legend.count > 0 && !cell->legend_outside && graph_mask_covered(&mask, cell->legend.box) > 0)
            fail_msg("%s: the legend of panel %zu hides something", what, p);
        graph_mask_free(&mask);
    }
}

static void assert_readable(const struct bead_graph *graph, const struct bead_look *look, int width, int height, const char *what)
{
    static struct texts texts;
    const struct bead_text_watch watch = {note, &texts};
    struct canvas c = make_canvas(width, height);
    texts.count = 0;
    assert_true(bead_text_watch(c.surface, &watch));
    draw(graph, look, &c);
    assert_true(texts.count > 4);
    assert_apart(&texts, what, width, height);
    free_canvas(&c);
    struct graph_layout layout = lay_out(graph, look, width, height);
    assert_nothing_hidden(&layout, what);
    graph_layout_free(&layout);
}

static const char long_caption[] = "Peak force *F*_m of the first passage, normalised, against the magnetism *M*, and everything "
                                   "that has to be said about α, β and Δ until nobody reads on.";

/* Some panels of everything. */
static void fill_panels(const struct data *d, const struct bead_ruler *rulers, struct bead_panel *panels, size_t count)
{
    for (size_t p = 0; p < count; p++) {
        panels[p] = make_panel(d, 1 + (3 * p) % CURVES);
        panels[p].title = p % 2 ? "a title with quite a lot of words in it, more than one line" : "short";
        panels[p].rulers = rulers;
        panels[p].ruler_count = p % 3;
        if (p % 2)
            panels[p].y.scale = BEAD_SCALE_LOG;
    }
}

static void test_words_never_collide(void **state)
{
    (void)state;
    static struct data d;
    static const struct bead_ruler rulers[] = {{false, 22, 20, 24, "*F*_0"}, {true, 0.5, NAN, NAN, "thesis, Eq. 3.14"}};
    static const struct size {
        int width, height;
        double dpi; /* 0: screen */
        size_t panels;
    } sizes[] = {{1016, 756, 300, 1}, {508, 378, 150, 1},   {2102, 1500, 300, 4}, {640, 360, 0, 1},
                 {1920, 1080, 0, 6},  {3840, 2160, 0, 9},   {1080, 1920, 0, 5},   {1280, 720, 0, 3},
                 {800, 800, 0, 2},    {4205, 2000, 600, 4}, {2031, 1512, 600, 2}, {4205, 4000, 600, 12}};
    make_data(&d);
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        for (int shared = 0; shared < 2; shared++) {
            char what[96];
            struct bead_panel panels[12];
            struct bead_look look;
            fill_panels(&d, rulers, panels, sizes[s].panels);
            for (size_t p = 0; shared && p < sizes[s].panels; p++)
                panels[p].y.scale = BEAD_SCALE_LINEAR;
            if (sizes[s].dpi > 0)
                bead_look_paper(&look, sizes[s].dpi);
            else
                bead_look_screen(&look, sizes[s].width, sizes[s].height, s % 2);
            struct bead_graph graph = {.title = sizes[s].panels > 2 ? "Everything about *M*" : NULL,
                                       .caption = sizes[s].height > 400 ? long_caption : NULL,
                                       .panels = panels,
                                       .panel_count = sizes[s].panels,
                                       .letters = true,
                                       .share_x = shared,
                                       .share_y = shared};
            snprintf(what, sizeof what, "%d x %d, %zu panels%s", sizes[s].width, sizes[s].height, sizes[s].panels,
                     shared ? ", shared" : "");
            assert_readable(&graph, &look, sizes[s].width, sizes[s].height, what);
        }
    }
}

/* Numbers of any size, long names, large type. */
static void test_words_of_odd_axes_never_collide(void **state)
{
    (void)state;
    static const double ranges[][2] = {{0, 1e-9},      {-1e6, 1e6}, {1e6, 1.00001e6}, {0, 1e300},  {-1e-300, 1e-300},
                                       {0.0099, 0.01}, {3, 3},      {0, 0},           {-5, -4.99}, {0, 12345}};
    static const char *const units[] = {"N", "s", "", "1", "m/s"};
    for (size_t r = 0; r < sizeof ranges / sizeof ranges[0]; r++) {
        for (size_t u = 0; u < sizeof units / sizeof units[0]; u++) {
            char what[64];
            double values[] = {ranges[r][0], ranges[r][1]};
            struct bead_look look;
            struct bead_series series = {
                .x = values, .y = values, .count = 2, .mark = BEAD_MARK_LINE_POINTS, .label = "a name that is longer than is good"};
            struct bead_panel panel = {
                .x = {"a title along the level axis that is long", units[u], NAN, NAN, BEAD_SCALE_LINEAR, false},
                .y = {"a title that is longer than the axis is high", units[u], NAN, NAN, BEAD_SCALE_LINEAR, false},
                .series = &series,
                .series_count = 1};
            struct bead_graph graph = {.panels = &panel, .panel_count = 1};
            snprintf(what, sizeof what, "%g to %g %s", values[0], values[1], units[u]);
            bead_look_paper(&look, 150);
            assert_readable(&graph, &look, 508, 378, what);
            bead_look_slide(&look, 1280, 720, true);
            assert_readable(&graph, &look, 1280, 720, what);
        }
    }
}

static void test_legends_without_room_go_outside(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    for (size_t k = 0; k < CURVES; k++) { /* all over the panel */
        for (int i = 0; i < N; i++)
            d.y[k][i] = (i + (int)k) % 2 ? 1 : 0;
    }
    struct bead_look look;
    bead_look_screen(&look, 800, 600, false);
    struct bead_panel panel = make_panel(&d, CURVES);
    panel.y.zero = false;
    struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    struct graph_layout layout = lay_out(&graph, &look, 800, 600);
    assert_true(layout.cells[0].legend_outside && layout.legend.count == CURVES);
    assert_true(layout.legend.box.y > layout.cells[0].plot.y + layout.cells[0].plot.height);
    graph_layout_free(&layout);
    bead_look_screen(&look, 1200, 600, false);
    layout = lay_out(&graph, &look, 1200, 600);
    assert_true(layout.legend_right && layout.legend.box.x > layout.cells[0].plot.x + layout.cells[0].plot.width);
    graph_layout_free(&layout);
    graph.panels = (struct bead_panel[]){make_panel(&d, 1), make_panel(&d, 1)};
    graph.panel_count = 2;
    layout = lay_out(&graph, &look, 1200, 600); /* the same entry is shown once */
    assert_int_equal(layout.cells[0].legend.count + layout.cells[1].legend.count, 1);
    graph_layout_free(&layout);
}

/* ---- axes ---- */

static void test_shared_axes_are_shared(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    struct bead_panel panels[5];
    struct bead_look look;
    for (size_t p = 0; p < 5; p++) {
        panels[p] = make_panel(&d, 1);
        panels[p].series = &d.series[p];
    }
    struct bead_graph graph = {.panels = panels, .panel_count = 5, .columns = 2, .share_x = true, .share_y = true};
    bead_look_screen(&look, 1200, 900, false);
    struct graph_layout layout = lay_out(&graph, &look, 1200, 900);
    for (size_t p = 0; p < 5; p++) {
        const struct graph_cell *cell = &layout.cells[p], *first = &layout.cells[0];
        for (int axis = 0; axis < 2; axis++)
            assert_true(cell->low[axis] == first->low[axis] && cell->high[axis] == first->high[axis]);
        assert_int_equal(cell->labelled[0], p >= 3); /* the lowest of each column */
        assert_int_equal(cell->labelled[1], p % 2 == 0);
        assert_int_equal(cell->plot.width, first->plot.width);
        assert_int_equal(cell->plot.height, first->plot.height);
        assert_true(cell->low[1] <= 0 && cell->high[1] > 34);
    }
    graph_layout_free(&layout);
    graph.share_y = false;
    layout = lay_out(&graph, &look, 1200, 900);
    assert_true(layout.cells[0].high[1] < layout.cells[4].high[1] && layout.cells[1].labelled[1]);
    graph_layout_free(&layout);
}

static void test_ranges_that_make_no_sense(void **state)
{
    (void)state;
    static const double x[] = {1, 2, 3};
    static const struct {
        double y[3];
        enum bead_scale scale;
    } cases[] = {{{5, 5, 5}, BEAD_SCALE_LINEAR},
                 {{0, 0, 0}, BEAD_SCALE_LINEAR},
                 {{NAN, NAN, NAN}, BEAD_SCALE_LINEAR},
                 {{0, -1, -5}, BEAD_SCALE_LOG},
                 {{1, 1, 1}, BEAD_SCALE_LOG},
                 {{NAN, INFINITY, 1}, BEAD_SCALE_LINEAR},
                 {{0, 4, 9}, BEAD_SCALE_SQRT},
                 {{1e-140, 1, 1e140}, BEAD_SCALE_LOG},
                 {{-1e308, 0, 1e308}, BEAD_SCALE_LINEAR},
                 {{1e9, 1e9 + 1e-3, 1e9}, BEAD_SCALE_LINEAR}};
    struct bead_look look;
    bead_look_screen(&look, 640, 480, false);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct bead_series series = {.x = x, .y = cases[i].y, .count = 3, .mark = BEAD_MARK_LINE_POINTS};
        struct bead_panel panel = {.x = {"x", "", NAN, NAN, BEAD_SCALE_LINEAR, false},
                                   .y = {"y", "N", NAN, NAN, cases[i].scale, false},
                                   .series = &series,
                                   .series_count = 1};
        struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        struct graph_layout layout = lay_out(&graph, &look, 640, 480);
        const struct graph_cell *cell = &layout.cells[0];
        assert_true(isfinite(cell->low[1]) && isfinite(cell->high[1]) && cell->high[1] > cell->low[1]);
        if (cell->axis[1].count < 1)
            fail_msg("case %zu: no ticks from %g to %g", i, cell->low[1], cell->high[1]);
        graph_layout_free(&layout);
        struct canvas c = make_canvas(640, 480);
        draw(&graph, &look, &c);
        free_canvas(&c);
    }
}

static void assert_refused(struct bead_panel panel, int width, int height, const char *says)
{
    struct bead_message msg = {""};
    struct bead_look look;
    struct bead_graph graph = {.panels = &panel, .panel_count = 1};
    struct canvas c = make_canvas(width, height);
    bead_look_screen(&look, width, height, false);
    assert_int_equal(bead_graph_draw(&graph, &look, c.cr, width, height, &msg), BEAD_ERROR_SCENE);
    if (!strstr(msg.text, says))
        fail_msg("'%s' does not say '%s'", msg.text, says);
    free_canvas(&c);
}

static void test_bad_ranges_and_sizes_are_errors(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    struct bead_panel panel = make_panel(&d, 1);
    assert_refused(panel, 60, 40, "no room");
    panel.y.low = 3;
    panel.y.high = 2;
    assert_refused(panel, 640, 480, "must be less");
    panel.y.low = -1;
    panel.y.scale = BEAD_SCALE_LOG;
    assert_refused(panel, 640, 480, "above 0");
}

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
        for (size_t shape = 0; shape < 6; shape++) {
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
                if (!near(pixel(&c, px, py), shape == 4 ? ground : ink)) /* rings are hollow */
                    fail_msg("shape %zu, scale %zu: point %d is not at its place", shape, s, i);
                int right = px;
                while (shape == 4 && right < px + 20 && !near(pixel(&c, right, py), ink))
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

/* ---- markup ---- */

static void test_markup(void **state)
{
    (void)state;
    static const struct {
        const char *text, *has, *lacks;
    } cases[] = {{"F_0", ">0<", "F_"},
                 {"10^{-3}", ">-3<", "{"},
                 {"*x*", "<i>x</i>", "*"},
                 {"2 * 3 * 4", "2 * 3 * 4", "<i>"},
                 {"a<b & c", "a&lt;b &amp; c", NULL},
                 {"chain\\_1", "chain_1", "<"},
                 {"α_β^γ", ">β<", "α_"},
                 {"open {", "open {", NULL},
                 {"end_", "end_", NULL},
                 {"*F*_{max, *N*}", "<i>N</i>", "{"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char out[512];
        assert_true(bead_markup_size(cases[i].text) <= sizeof out);
        bead_markup(cases[i].text, out, bead_markup_size(cases[i].text));
        if (!strstr(out, cases[i].has) || (cases[i].lacks && strstr(out, cases[i].lacks)))
            fail_msg("'%s' becomes '%s'", cases[i].text, out);
    }
    char quoted[64], out[512], small[4];
    bead_markup_quote("a_b^c*d*\\{e}", quoted, sizeof quoted);
    bead_markup(quoted, out, sizeof out);
    assert_string_equal(out, "a_b^c*d*\\{e}");
    bead_markup("*long*", small, sizeof small); /* no room: as it stands, cut */
    assert_string_equal(small, "*lo");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_stand_at_their_place),
        cmocka_unit_test(test_curves_are_cut_at_the_frame),
        cmocka_unit_test(test_no_value_is_a_gap),
        cmocka_unit_test(test_spikes_of_dense_curves_show),
        cmocka_unit_test(test_shared_axes_are_shared),
        cmocka_unit_test(test_ranges_that_make_no_sense),
        cmocka_unit_test(test_bad_ranges_and_sizes_are_errors),
        cmocka_unit_test(test_words_never_collide),
        cmocka_unit_test(test_words_of_odd_axes_never_collide),
        cmocka_unit_test(test_legends_without_room_go_outside),
        cmocka_unit_test(test_markup),
    };
    return cmocka_run_group_tests_name("graphs", tests, NULL, NULL);
}
