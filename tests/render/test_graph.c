/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Graphs: words that hide nothing and leave no page, axes that are shared, ranges. */
#include "graphs.h"
#include "render/draw/looks.h"

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

/* Headings are just above the plots that they name. */
static void assert_headings_above(const struct texts *texts, const struct graph_layout *layout, const char *what)
{
    for (size_t p = 0; p < layout->graph->panel_count; p++) {
        const struct graph_cell *cell = &layout->cells[p];
        bool found = !cell->head;
        for (size_t i = 0; i < texts->count && !found; i++) {
            const struct text *t = &texts->text[i];
            found = strncmp(t->markup, cell->head, sizeof t->markup - 1) == 0 && fabs(t->x - cell->plot.x) < t->height &&
                    t->y + t->height <= cell->plot.y && t->y + 2 * t->height > cell->plot.y;
        }
        if (!found)
            fail_msg("%s: the heading of panel %zu is not just above its plot", what, p);
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
        if (cell->legend.count > 0 && graph_mask_covered(&mask, cell->legend.box) > 0)
            fail_msg("%s: the legend of panel %zu hides something", what, p);
        graph_mask_free(&mask);
        double width, height = 0;
        struct bead_text_style style = graph_text(layout->look);
        if (cell->head)
            bead_text_size_lines(NULL, &style, -cell->plot.width, cell->head, &width, &height);
        if (height > 1.8 * style.size || height > layout->grid.rows.lane[1 + cell->row].reach[0])
            fail_msg("%s: the heading of panel %zu has more than its line", what, p);
    }
}

/* The words of all rulers are beside their lines, or all in legends. */
static void assert_words_in_one_place(const struct graph_layout *layout, const char *what)
{
    size_t words[3] = {0};
    for (size_t p = 0; p < layout->graph->panel_count; p++) {
        for (size_t r = 0; r < layout->cells[p].panel->ruler_count; r++)
            words[layout->cells[p].words[r].state]++;
    }
    if (words[GRAPH_WORD_PLACED] > 0 && words[GRAPH_WORD_IN_LEGEND] > 0)
        fail_msg("%s: %zu words beside their lines, %zu in legends", what, words[GRAPH_WORD_PLACED], words[GRAPH_WORD_IN_LEGEND]);
}

static void assert_readable(const struct bead_graph *graph, const struct bead_look *look, int width, int height, const char *what)
{
    static struct texts texts;
    const struct bead_text_watch watch = {note, &texts};
    struct canvas c = make_canvas(1, 1); /* texts are reported wherever they are */
    struct graph_layout layout = lay_out(graph, look, width, height);
    struct bead_message msg = {""};
    texts.count = 0;
    assert_true(bead_text_watch(c.surface, &watch));
    if (graph_draw_all(c.cr, &layout, &msg))
        fail_msg("%s", msg.text);
    assert_true(texts.count > 4);
    assert_apart(&texts, what, width, height);
    assert_headings_above(&texts, &layout, what);
    free_canvas(&c);
    assert_nothing_hidden(&layout, what);
    assert_words_in_one_place(&layout, what);
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

/* In addition to the points, axes include rulers with their bands, error bars, and the upper edges of bands; each kind of ruler is
 * in the range of its own axis. */
static void test_axes_hold_all(void **state)
{
    (void)state;
    static const double x[] = {1, 2, 3}, y[] = {4, 5, 6}, error[] = {3, 0.1, 5}, upper[] = {5, 17, NAN};
    static const struct bead_ruler across[] = {{false, 22, 20, 24, "across"}}, along[] = {{true, 9, NAN, NAN, "along"}};
    const struct bead_series series = {.x = x, .y = y, .error = error, .count = 3, .mark = BEAD_MARK_POINTS};
    const struct bead_graph_axis axis = {.title = "x", .unit = "", .low = NAN, .high = NAN};
    struct bead_look look;
    bead_look_screen(&look, 1280, 720, false);
    const struct bead_series band = {.x = x, .y = y, .upper = upper, .count = 3, .mark = BEAD_MARK_BAND};
    for (int kind = 0; kind < 4; kind++) {
        const struct bead_panel panel = {.x = axis,
                                         .y = axis,
                                         .series = kind == 3 ? &band : &series,
                                         .series_count = 1,
                                         .rulers = kind == 1 ? across : along,
                                         .ruler_count = kind == 1 || kind == 2};
        const struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        struct graph_layout layout = lay_out(&graph, &look, 1280, 720);
        const struct graph_cell *cell = &layout.cells[0];
        const double right = kind == 2 ? 9 : 3, top = kind == 1 ? 24 : kind == 3 ? 17 : 11;
        assert_true(cell->low[0] <= 1 && cell->high[0] >= right && cell->high[0] < 1.3 * right);
        assert_true(cell->low[1] <= (kind == 3 ? 4 : 1) && cell->high[1] >= top && cell->high[1] < 1.5 * top);
        graph_layout_free(&layout);
    }
}

/* Clouds of few and of many points: equal marks in all panels, as large as the largest cloud bears. */
static void test_clouds_have_equal_points(void **state)
{
    (void)state;
    enum { MANY = 900, FEW = 40 };
    static double x[MANY], y[MANY];
    struct bead_series series[2];
    struct bead_panel panels[2] = {0};
    struct bead_look look;
    for (int i = 0; i < MANY; i++) {
        x[i] = i / 20;
        y[i] = (i * 7 + i / 20) % 31;
    }
    for (int p = 0; p < 2; p++) {
        series[p] = (struct bead_series){.x = x, .y = y, .count = p ? MANY : FEW, .mark = BEAD_MARK_POINTS};
        const struct bead_graph_axis axis = {.title = "x", .unit = "", .low = NAN, .high = NAN};
        panels[p] = (struct bead_panel){.x = axis, .y = axis, .series = &series[p], .series_count = 1};
    }
    bead_look_screen(&look, 1280, 720, false);
    const struct bead_graph both = {.panels = panels, .panel_count = 2}, alone = {.panels = panels, .panel_count = 1};
    struct graph_layout layout = lay_out(&both, &look, 1280, 720), one = lay_out(&alone, &look, 1280, 720);
    const double few = graph_point_size(&series[0], &layout.cells[0], &look),
                 many = graph_point_size(&series[1], &layout.cells[1], &look);
    assert_true(few == many);
    assert_true(few < 0.8 * graph_point_size(&series[0], &one.cells[0], &look));
    graph_layout_free(&layout);
    graph_layout_free(&one);
}

/* Numbers of any size, long names, large type. */
static void test_words_of_odd_axes_never_collide(void **state)
{
    (void)state;
    static const double ranges[][2] = {{0, 1e-9},      {-1e6, 1e6}, {1e6, 1.00001e6}, {0, 1e300},  {-1e-300, 1e-300},
                                       {0.0099, 0.01}, {3, 3},      {0, 0},           {-5, -4.99}, {0, 12345}};
    static const char *const units[] = {"N", "s", "", "1", "m/s"};
    for (size_t r = 0; r < sizeof ranges / sizeof ranges[0]; r++) {
        for (size_t u = r % 3; u < sizeof units / sizeof units[0]; u += 3) {
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

/* Titles of axes that are broken or not, headings of two lines or three: each depends on the other. */
static void test_headings_have_room(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    for (int width = 500; width < 900; width += 23) {
        for (int height = 500; height < 1100; height += 53) {
            struct bead_panel panels[7];
            struct bead_look look;
            char what[64];
            bead_look_paper(&look, 200);
            for (size_t p = 0; p < 7; p++) {
                panels[p] = make_panel(&d, 1);
                panels[p].title = "chain number 3 with a rather long name, *M*\u00a0=\u00a00.333";
                panels[p].y.title = "bead force";
            }
            struct bead_graph graph = {.panels = panels, .panel_count = 7, .letters = true, .share_x = true, .share_y = true};
            struct graph_layout layout;
            struct bead_message msg = {""};
            snprintf(what, sizeof what, "%d x %d", width, height);
            if (graph_layout_make(&graph, &look, width, height, NULL, &layout, &msg))
                continue; /* too small */
            assert_nothing_hidden(&layout, what);
            graph_layout_free(&layout);
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

/* Words cannot use the gaps of dashes: the covered part does not depend on them. */
static void test_gaps_of_dashes_are_covered(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    struct bead_look look;
    struct bead_message msg = {""};
    bead_look_paper(&look, 300);
    unsigned covered[BEAD_DASHES + 1];
    for (size_t dash = 0; dash <= BEAD_DASHES; dash++) {
        struct bead_panel panel = make_panel(&d, 1);
        struct graph_mask mask;
        d.series[0].mark = BEAD_MARK_LINE;
        d.series[0].error = NULL;
        d.series[0].dash = dash;
        d.series[0].label = NULL;
        struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        struct graph_layout layout = lay_out(&graph, &look, 800, 600);
        assert_int_equal(graph_mask_make(&layout.cells[0], &look, &mask, &msg), BEAD_OK);
        covered[dash] =
            graph_mask_covered(&mask, (struct graph_box){mask.x, mask.y, mask.width * mask.cell, mask.height * mask.cell});
        assert_true(covered[dash] > 0 && covered[dash] == covered[0]);
        graph_mask_free(&mask);
        graph_layout_free(&layout);
    }
}

/* Panels of figures stay in place: axes end higher for a legend that does not fit, unless the scene gives their ends. */
static void test_legends_of_parts_stay_inside(void **state)
{
    (void)state;
    static struct data d;
    make_data(&d);
    for (size_t k = 0; k < 3; k++) {
        for (int i = 0; i < N; i++)
            d.y[k][i] = (i + (int)k) % 2 ? 1 : 0.1;
        d.series[k].error = NULL;
    }
    for (int i = 0; i < N; i++)
        d.x[i] += 2; /* the axes begin at unlike numbers */
    struct bead_look look;
    struct bead_message msg = {""};
    struct graph_layout layout;
    bead_look_screen(&look, 800, 600, false);
    for (int variant = 0; variant < 4; variant++) {
        struct bead_panel panel = make_panel(&d, 3);
        struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        const struct graph_frame frame = {.letter = ""};
        const bool given = variant & 1;
        panel.y.scale = variant & 2 ? BEAD_SCALE_LOG : BEAD_SCALE_LINEAR;
        panel.y.zero = false;
        panel.y.low = 0.09;
        if (given)
            panel.y.high = 1.01;
        assert_int_equal(graph_layout_make(&graph, &look, 800, 600, &frame, &layout, &msg), BEAD_OK);
        assert_int_equal(layout.cells[0].legend_outside, given);
        assert_true(layout.cells[0].low[1] == 0.09);
        if (given)
            assert_true(layout.cells[0].high[1] == 1.01);
        else { /* what is above the largest value is the legend's */
            const struct graph_cell *cell = &layout.cells[0];
            const double above = (1 - bead_axis_place(&cell->axis[1], 1)) * cell->plot.height;
            if (!(above > cell->legend.box.height && above < cell->legend.box.height + 0.15 * cell->plot.height))
                fail_msg("%g px of %d above the largest value for a legend of %g", above, cell->plot.height,
                         cell->legend.box.height);
        }
        assert_nothing_hidden(&layout, "a part");
        graph_layout_free(&layout);
    }
}

/* Names of any length on small pages: smaller, cut in the end, and plots keep half of the page. */
static void test_long_names_leave_room_for_plots(void **state)
{
    (void)state;
    static const char *const name = "an arrangement of steel and aluminium beads with every second dimer turned round, as it was "
                                    "delivered by the workshop in spring, ";
    static const double sizes[][2] = {{86, 85}, {86, 60}, {86, 40}, {60, 45}, {178, 60}};
    static struct data d;
    static char labels[CURVES][256];
    char what[64];
    make_data(&d);
    for (size_t length = 20; length <= strlen(name); length += 18) {
        for (size_t k = 0; k < CURVES; k++) {
            for (int i = 0; i < N; i++)
                d.y[k][i] = (i + (int)k) % 2 ? 1 : 0;
            snprintf(labels[k], sizeof labels[k], "%.*s, *M* = 0.%zu", (int)length, name, k);
            d.series[k].label = labels[k];
        }
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            struct bead_look look;
            int width = (int)round(sizes[s][0] * 300 / 25.4), height = (int)round(sizes[s][1] * 300 / 25.4);
            bead_look_paper(&look, 300);
            struct bead_panel panel = make_panel(&d, CURVES);
            struct bead_graph graph = {.panels = &panel, .panel_count = 1};
            snprintf(what, sizeof what, "names of %d characters on %g x %g mm", (int)length, sizes[s][0], sizes[s][1]);
            assert_readable(&graph, &look, width, height, what);
            struct graph_layout layout = lay_out(&graph, &look, width, height);
            if (layout.cells[0].plot.height < 0.2 * height || layout.cells[0].plot.width < 0.3 * width)
                fail_msg("%s: the plot has only %d x %d of %d x %d pixels", what, layout.cells[0].plot.width,
                         layout.cells[0].plot.height, width, height);
            graph_layout_free(&layout);
        }
    }
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
    struct bead_graph graph = {.panels = panels, .panel_count = 5, .share_x = true, .share_y = true};
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
    panel.y.scale = BEAD_SCALE_LOG;
    for (int below = 0; below < 2; below++) {
        panel.y.low = -below;
        assert_refused(panel, 640, 480, "above 0");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared_axes_are_shared),          cmocka_unit_test(test_ranges_that_make_no_sense),
        cmocka_unit_test(test_bad_ranges_and_sizes_are_errors), cmocka_unit_test(test_axes_hold_all),
        cmocka_unit_test(test_clouds_have_equal_points),        cmocka_unit_test(test_words_never_collide),
        cmocka_unit_test(test_words_of_odd_axes_never_collide), cmocka_unit_test(test_headings_have_room),
        cmocka_unit_test(test_legends_without_room_go_outside), cmocka_unit_test(test_long_names_leave_room_for_plots),
        cmocka_unit_test(test_gaps_of_dashes_are_covered),      cmocka_unit_test(test_legends_of_parts_stay_inside),
    };
    return cmocka_run_group_tests_name("graphs", tests, NULL, NULL);
}
