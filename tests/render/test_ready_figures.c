/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plots of all ready scenes, made once and examined in two ways, and made-up ones. In grey: any two curves in a panel differ by
 * dashes or marks, without their colours. Legends: none takes more room than its plots, inside or outside them, on pages of several
 * widths. The layouts of all figures pass through here (the Makefile wraps graph_layout_make). */
#include "graphs.h"

#include "beadreel/session.h"
#include "render/draw/looks.h"
#include "render/plot/graph_private.h"
#include "render/plot/plot_private.h"
#include "sessions.h"
#include "sim/measure/spreading.h"

/* The plots of the ready scenes, with fewer points and configurations if there are many: the names of curves and their differences
 * do not depend on these. */
static const struct ready_figure {
    const char *scene, *only[3], *settings[6];
    size_t least_pairs; /* of curves that differ */
} ready_figures[] = {
    {"sensors", {"sensors.png"}, {NULL}, 4},
    {"panels", {"panels.pdf"}, {NULL}, 1},
    {"fput", {"modes.png", "profiles.png"}, {NULL}, 12},
    {"fput-kdv", {"profiles.png"}, {"chains.1.points=256"}, 12},
    {"kdv", {"profiles.png"}, {"chain.points=200"}, 10},
    {"shock", {"profiles.png"}, {NULL}, 10},
    {"zabusky-kruskal", {"profiles.png", "modes.png"}, {"chain.points=160", "simulate.until=1.2"}, 9},
    {"thesis/fig1", {"fig1.png"}, {NULL}, 10},
    {"thesis/fig5", {"fig5.png"}, {NULL}, 3},
    {"thesis/fig6", {"fig6.png"}, {NULL}, 4},
    {"thesis/fig8", {"fig8.png"}, {"chain.points=600"}, 10},
    {"thesis/defect", {"defect.png"}, {NULL}, 15},
    {"sweep", {"force.png"}, {"sweep.cells=8"}, 2},
    {"thesis/fig7",
     {"fig7.png"},
     {"sweeps.0.cells=8", "sweeps.1.cells=8", "sweeps.2.cells=8", "sweeps.3.cells=50", "sweeps.3.configurations=6"},
     4},
    {"thesis/decay", {"decay.png"}, {"sweep.cells=64", "sweep.configurations=4"}, 30},
};
enum { READY_FIGURES = sizeof ready_figures / sizeof *ready_figures };

static void play_figure(const struct ready_figure *figure, const char *directory)
{
    struct bead_job job = {.input = figure->scene, .output = directory, .only = figure->only, .settings = figure->settings};
    while (figure->only[job.only_count])
        job.only_count++;
    while (figure->settings[job.setting_count])
        job.setting_count++;
    play_counts(job);
}

enum bead_error __real_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg);
enum bead_error __wrap_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg);

/* ---- in grey ---- */

enum { LONG = 480, HIGH = 48, SAMPLES = 400 };

/* What has been seen of the figure being made. */
static struct {
    size_t pairs, alike;
    char why[256];
} grey;

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
            grey.pairs++;
            if (difference(picture[i], picture[k]) >= least)
                continue;
            grey.alike++;
            snprintf(grey.why, sizeof grey.why, "\"%.100s\" and \"%.100s\"", label_of(series[k]), label_of(series[i]));
        }
    }
    for (size_t i = 0; i < count; i++)
        cairo_surface_destroy(picture[i]);
}

/* Any number of lines and of marks, up to the product of the tables of dashes and shapes. */
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
        memset(&grey, 0, sizeof grey);
        for (size_t k = 0; k < MANY; k++) {
            snprintf(labels[k], sizeof labels[k], "%zu", k);
            series[k] = (struct bead_series){.y = zeros, .count = SAMPLES, .mark = marks[m], .label = labels[k]};
            plot_tell_apart(&series[k], k);
        }
        look_at(&panel);
        assert_int_equal(grey.pairs, MANY * (MANY - 1) / 2);
        if (grey.alike > 0)
            fail_msg("marks %zu: %zu pairs look alike, such as %s", m, grey.alike, grey.why);
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
    memset(&grey, 0, sizeof grey);
    look_at(&panel);
    assert_int_equal(grey.alike, 1);
}

/* ---- legends ---- */

/* mm: columns of journals and less, and a page */
static const double pages[][2] = {{60, 45}, {86, 64}, {86, 40}, {86, 120}, {120, 60}, {178, 60}, {178, 120}};
enum { PAGES = sizeof pages / sizeof *pages, DPI = 300 };

/* What has been seen of the figure being made. */
static struct {
    size_t count, pages, astray; /* astray: words of a ruler outside of its panel, without the letter of it */
    double largest;              /* legend, in units of its plot or plots */
} legends;

static void compare(const struct graph_box *legend, double plots)
{
    double part = legend->width * legend->height / plots;
    legends.count++;
    legends.largest = fmax(legends.largest, part);
}

static void measure(const struct graph_layout *layout)
{
    double all = 0;
    for (size_t p = 0; p < layout->graph->panel_count; p++) {
        const struct graph_cell *cell = &layout->cells[p];
        double plot = (double)cell->plot.width * (double)cell->plot.height;
        all += plot;
        if (cell->legend.count > 0)
            compare(&cell->legend.box, plot);
    }
    if (layout->legend.count > 0)
        compare(&layout->legend.box, all);
    for (size_t i = 0; i < layout->legend.count; i++)
        legends.astray += layout->legend.entries[i].ruler && layout->graph->panel_count > 1 &&
                          strncmp(layout->legend.entries[i].markup, "<b>(", 4) != 0;
    legends.pages++;
}

/* On every page that has room for its panels at all. */
static void measure_on_pages(const struct bead_graph *graph)
{
    struct bead_look look;
    struct graph_layout layout;
    bead_look_paper(&look, DPI);
    for (size_t i = 0; i < PAGES; i++) {
        double width = round(pages[i][0] * DPI / 25.4), height = round(pages[i][1] * DPI / 25.4);
        if (__real_graph_layout_make(graph, &look, width, height, NULL, &layout, NULL) == BEAD_OK) {
            measure(&layout);
            graph_layout_free(&layout);
        }
    }
}

/* Curves all over the panel, so that nothing is free, with names of `length` characters. */
static void make_crowd(struct data *d, char labels[CURVES][256], size_t length)
{
    static const char *const name = "an arrangement of steel and aluminium beads with every second dimer turned round, as it was "
                                    "delivered by the workshop in spring, ";
    make_data(d);
    for (size_t k = 0; k < CURVES; k++) {
        for (int i = 0; i < N; i++)
            d->y[k][i] = (i + (int)k) % 2 ? 1 : 0;
        snprintf(labels[k], sizeof labels[k], "%.*s, *M* = 0.%zu", (int)length, name, k);
        d->series[k].label = labels[k];
    }
}

static void test_legends_of_many_curves_with_long_names(void **state)
{
    (void)state;
    static struct data d[4];
    static char labels[4][CURVES][256];
    for (size_t length = 5; length < 120; length += 40) {
        for (size_t panels = 1; panels <= 4; panels++) {
            for (size_t curves = 3; curves <= CURVES; curves += 2) {
                struct bead_panel panel[4];
                for (size_t p = 0; p < panels; p++) {
                    make_crowd(&d[p], labels[p], length);
                    panel[p] = make_panel(&d[p], curves);
                }
                const struct bead_graph graph = {.panels = panel, .panel_count = panels, .share_x = true, .share_y = panels % 2};
                memset(&legends, 0, sizeof legends);
                measure_on_pages(&graph);
                assert_true(legends.pages >= 3 && legends.count >= legends.pages);
                if (legends.largest > 1)
                    fail_msg("%zu panels, %zu curves with names of %zu characters: a legend takes the room of %.2f plots", panels,
                             curves, length, legends.largest);
            }
        }
    }
}

/* ---- words ---- */

/* Titles of panels and labels of curves, each in brackets, of the figures made. */
static struct {
    size_t used;
    char text[2000];
} words;

/* Lines between two points with a label, such as power laws. */
static struct {
    size_t count;
    struct {
        double x[2], y[2], longest; /* of the other curves, along x */
        char label[100];
    } line[8];
} laws;

/* Whether axes of values of the last figure begin at zero. */
static bool from_zero;

static void note_laws(const struct bead_graph *graph)
{
    from_zero = graph->panels[0].y.zero;
    for (size_t s = 0; s < graph->panels[0].series_count && laws.count < 8; s++) {
        const struct bead_series *series = &graph->panels[0].series[s];
        if (series->count != 2 || !series->label || s == 0)
            continue;
        const struct bead_series *curve = series - 1;
        laws.line[laws.count].longest = curve->x[curve->count - 1];
        memcpy(laws.line[laws.count].x, series->x, sizeof laws.line->x);
        memcpy(laws.line[laws.count].y, series->y, sizeof laws.line->y);
        snprintf(laws.line[laws.count++].label, sizeof laws.line->label, "%s", series->label);
    }
}

static void note_words(const struct bead_graph *graph)
{
    note_laws(graph);
    for (size_t p = 0; p < graph->panel_count && words.used < sizeof words.text - 300; p++) {
        const struct bead_panel *panel = &graph->panels[p];
        words.used += (size_t)snprintf(words.text + words.used, 300, "<%.100s>", panel->title ? panel->title : "");
        for (size_t s = 0; s < panel->series_count && words.used < sizeof words.text - 300; s++)
            words.used += (size_t)snprintf(words.text + words.used, 300, "[%.100s]", label_of(&panel->series[s]));
    }
}

/* Panels have the names of their sensors, curves their keys' values and, where they are means, of how many chains. */
static void test_sweeps_name_what_they_show(void **state)
{
    (void)state;
    static const char *const chain =
        "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, sensor: one}, "
        "{bead: large-steel, count: 2}, {bead: large-steel, sensor: two}, {bead: large-steel}]}\n"
        "simulate: {until: 0.1 ms}\n";
    static const struct {
        const char *sweep, *output, *words;
    } cases[] = {
        {"over: {chain.striker.velocity: [0.5 m/s, 2 m/s]}, measure: {sensor: [one, two]}", "", "<one>[]<two>[]"},
        {"over: {chain.striker.velocity: [0.5 m/s, 2 m/s]}", "show: sensors, beads: [0, 3]",
         "<bead 0>[velocity 0.5 m/s][velocity 2 m/s]<bead 3>[velocity 0.5 m/s][velocity 2 m/s]"},
        {"over: {chain.striker.velocity: [0.5 m/s]}", "show: sensors", "<one>[velocity 0.5 m/s]<two>[velocity 0.5 m/s]"},
    };
    char directory[256], scene[512], text[1500];
    in_directory("", directory, sizeof directory);
    in_directory("scene.yaml", scene, sizeof scene);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        words.used = 0;
        snprintf(text, sizeof text, "%ssweep: {%s}\noutputs: [{plot: a.png, %s}]\n", chain, cases[i].sweep, cases[i].output);
        write_text(scene, text);
        play_counts((struct bead_job){.input = scene, .output = directory});
        assert_string_equal(words.text, cases[i].words);
    }
}

/* The lines of exponents are as steep as these say, over the last part of their curves that they are found in. */
static void test_power_laws_have_their_exponents(void **state)
{
    (void)state;
    char directory[256], scene[512];
    in_directory("", directory, sizeof directory);
    in_directory("scene.yaml", scene, sizeof scene);
    write_text(scene, "chain: {striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 30}]}\n"
                      "simulate: {until: 0.3 ms}\noutputs: [{plot: a.png, show: spreading, every: 1 us}]\n");
    laws.count = 0;
    play_counts((struct bead_job){.input = scene, .output = directory});
    assert_true(laws.count > 0);
    for (size_t i = 0; i < laws.count; i++) {
        const double *x = laws.line[i].x, *y = laws.line[i].y;
        char number[32] = "", *put = number;
        for (const char *c = laws.line[i].label + strlen("exponent "); *c && *c != ' '; c++) { /* a minus of three bytes */
            if ((*c >= '0' && *c <= '9') || *c == '.')
                *put++ = *c;
            else if ((unsigned char)*c == 0xe2)
                *put++ = '-';
        }
        assert_true(x[1] == laws.line[i].longest && fabs(x[0] / x[1] - BEAD_SPREADING_WINDOW) < 1e-9);
        assert_true(fabs(log(y[1] / y[0]) / log(x[1] / x[0]) - strtod(number, NULL)) < 0.00051);
    }
}

/* The participation of modes begins at none. */
static void test_participation_begins_at_zero(void **state)
{
    (void)state;
    char directory[256], scene[512];
    in_directory("", directory, sizeof directory);
    in_directory("scene.yaml", scene, sizeof scene);
    write_text(scene,
               "chain: {striker: {bead: large-steel, velocity: 1 m/s}, precompression: 2 N, wall: brass, beads: [{cell: "
               "[large-steel, aluminium], count: 8}]}\nsimulate: {until: 10 us}\noutputs: [{plot: a.png, show: eigenmodes}]\n");
    play_counts((struct bead_job){.input = scene, .output = directory});
    assert_true(from_zero);
}

/* ---- the ready figures ---- */

/* Before a run a graph without curves is laid out, to see whether it has room. */
static bool has_curves(const struct bead_graph *graph)
{
    bool drawn = false;
    for (size_t p = 0; p < graph->panel_count; p++)
        drawn = drawn || graph->panels[p].series_count > 0 || graph->panels[p].image;
    return drawn;
}

enum bead_error __wrap_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg)
{
    if (!has_curves(graph))
        return __real_graph_layout_make(graph, look, width, height, frame, layout, msg);
    for (size_t p = 0; p < graph->panel_count; p++)
        look_at(&graph->panels[p]);
    note_words(graph);
    enum bead_error err = __real_graph_layout_make(graph, look, width, height, frame, layout, msg);
    if (!err)
        measure(layout);
    measure_on_pages(graph);
    return err;
}

static void judge_curves(const struct ready_figure *figure)
{
    if (grey.alike > 0)
        fail_msg("%s: %zu of %zu pairs of curves look alike in grey, such as %s", figure->scene, grey.alike, grey.pairs, grey.why);
    if (grey.pairs < figure->least_pairs)
        fail_msg("%s: %zu pairs of curves seen, not %zu", figure->scene, grey.pairs, figure->least_pairs);
}

static void judge_legends(const struct ready_figure *figure)
{
    print_message("# %s: %zu legends on %zu pages, the largest of %.2f plots\n", figure->scene, legends.count, legends.pages,
                  legends.largest);
    if (legends.count < 3 || legends.pages < 4)
        fail_msg("%s: only %zu legends on %zu pages", figure->scene, legends.count, legends.pages);
    if (legends.largest > 1)
        fail_msg("%s: a legend takes the room of %.2f plots", figure->scene, legends.largest);
    if (legends.astray > 0)
        fail_msg("%s: %zu words about one panel stand outside of it without its letter", figure->scene, legends.astray);
}

static void test_ready_figures(void **state)
{
    (void)state;
    char directory[256];
    in_directory("", directory, sizeof directory);
    for (size_t i = 0; i < READY_FIGURES; i++) {
        memset(&grey, 0, sizeof grey);
        memset(&legends, 0, sizeof legends);
        play_figure(&ready_figures[i], directory);
        judge_curves(&ready_figures[i]);
        judge_legends(&ready_figures[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_colours_do_not_count),
        cmocka_unit_test(test_many_curves_are_told_apart),
        cmocka_unit_test(test_legends_of_many_curves_with_long_names),
        cmocka_unit_test(test_sweeps_name_what_they_show),
        cmocka_unit_test(test_power_laws_have_their_exponents),
        cmocka_unit_test(test_participation_begins_at_zero),
        cmocka_unit_test(test_ready_figures),
    };
    return cmocka_run_group_tests_name("ready figures", tests, make_directory, remove_directory);
}
