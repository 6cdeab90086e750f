/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A legend never takes more room than its plots, inside or outside of them: areas are measured over all ready figures and over
 * made-up ones with many curves and long names, on pages of several widths (the Makefile wraps graph_layout_make). */
#include "graphs.h"

#include "beadreel/session.h"
#include "ready_figures.h"
#include "render/plot/plot_private.h"

/* mm: columns of journals and less, and a page */
static const double pages[][2] = {{60, 45}, {86, 64}, {86, 40}, {86, 120}, {120, 60}, {178, 60}, {178, 120}};
enum { PAGES = sizeof pages / sizeof *pages, DPI = 300 };

/* What has been seen of the figure being made. */
static struct {
    size_t legends, pages, astray; /* astray: words of a ruler outside of its panel, without the letter of it */
    double largest;                /* legend, in units of its plot or plots */
} seen;

static void compare(const struct graph_box *legend, double plots)
{
    double part = legend->width * legend->height / plots;
    seen.legends++;
    seen.largest = fmax(seen.largest, part);
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
        seen.astray += layout->legend.entries[i].ruler && layout->graph->panel_count > 1 &&
                       strncmp(layout->legend.entries[i].markup, "<b>(", 4) != 0;
    seen.pages++;
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

enum bead_error __wrap_graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                         const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg)
{
    enum bead_error err = __real_graph_layout_make(graph, look, width, height, frame, layout, msg);
    if (!err)
        measure(layout);
    measure_on_pages(graph);
    return err;
}

static void test_legends_of_ready_figures(void **state)
{
    (void)state;
    char directory[256];
    in_directory("", directory, sizeof directory);
    for (size_t i = 0; i < READY_FIGURES; i++) {
        const struct ready_figure *figure = &ready_figures[i];
        memset(&seen, 0, sizeof seen);
        play_figure(figure, directory);
        print_message("# %s: %zu legends on %zu pages, the largest of %.2f plots\n", figure->scene, seen.legends, seen.pages,
                      seen.largest);
        if (seen.legends < 3 || seen.pages < 4)
            fail_msg("%s: only %zu legends on %zu pages", figure->scene, seen.legends, seen.pages);
        if (seen.largest > 1)
            fail_msg("%s: a legend takes the room of %.2f plots", figure->scene, seen.largest);
        if (seen.astray > 0)
            fail_msg("%s: %zu words about one panel stand outside of it without its letter", figure->scene, seen.astray);
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
                memset(&seen, 0, sizeof seen);
                measure_on_pages(&graph);
                assert_true(seen.pages >= 3 && seen.legends >= seen.pages);
                if (seen.largest > 1)
                    fail_msg("%zu panels, %zu curves with names of %zu characters: a legend takes the room of %.2f plots", panels,
                             curves, length, seen.largest);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_legends_of_ready_figures),
        cmocka_unit_test(test_legends_of_many_curves_with_long_names),
    };
    return cmocka_run_group_tests_name("legend_room", tests, make_directory, remove_directory);
}
