/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plots of sensors: normalised forces, one axis for all chains, ranges, horizons; words in bands. */
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
#include "render/draw/looks.h"
#include "render/plot/graph_private.h"
#include "render/plot/plot_data.h"

enum { CHAINS = 2, SENSORS = 2, SAMPLES = 200 };
static const size_t sensor_beads[SENSORS] = {3, 6};
static const double amplitudes[CHAINS][SENSORS] = {{10, 4}, {8, 20}}; /* N */

struct run {
    struct bead_scene *scene;
    struct bead_chain *chains[CHAINS];
    struct bead_run_context context;
    struct bead_plot_data *data;
    const struct bead_panel *panels;
    size_t count;
};

static double only_at = NAN; /* the time of the only sample that is not 0; NaN: none is */

/* A force that begins at the sensors' own times; its comparison run leaves it at 0.5 ms. */
static double force(size_t chain, size_t sensor, double time, bool comparison)
{
    double off = comparison && time > 0.5e-3 ? 0.5 : 0;
    if (!isnan(only_at))
        return time == only_at ? amplitudes[chain][sensor] : 0;
    return amplitudes[chain][sensor] * fabs(sin(2e4 * (time + 1e-5 * (double)sensor))) + off;
}

static struct run plot(const char *settings)
{
    char text[1024];
    struct run run = {.count = 0};
    struct bead_message msg = {""};
    static const char beads[] = "[{bead: large-steel, count: 2}, {bead: large-steel, sensor: a_1}, {bead: large-steel, count: 2}, "
                                "{bead: large-steel, sensor: b}, {bead: large-steel}]";
    snprintf(text, sizeof text,
             "chains:\n- {name: one, beads: %s}\n- {name: two, beads: %s}\nsimulate: {until: 1 ms}\n"
             "outputs: [{plot: p.png, show: sensors%s}]\n",
             beads, beads, settings);
    if (bead_scene_parse("test", text, strlen(text), NULL, &run.scene, &msg))
        fail_msg("%s", msg.text);
    for (size_t c = 0; c < CHAINS; c++)
        assert_int_equal(bead_chain_create(run.scene, c, &run.chains[c], &msg), BEAD_OK);
    run.context = (struct bead_run_context){
        .scene = run.scene, .chain_count = CHAINS, .end = 1e-3, .resolution = 1e-6, .tolerance_factor = 10, .threads = 1};
    run.context.chains = (const struct bead_chain *const *)run.chains;
    assert_int_equal(bead_plot_data_create(&run.scene->outputs[0], &run.context, SIZE_MAX, &run.data, &msg), BEAD_OK);
    for (size_t i = 0; i < SAMPLES * CHAINS; i++) {
        double values[2][8] = {{0}};
        struct bead_sample sample = {.time = 1e-3 * (double)(i / CHAINS) / (SAMPLES - 1), .chain = i % CHAINS, .index = i / CHAINS};
        for (size_t k = 0; k < SENSORS; k++) {
            values[0][sensor_beads[k]] = force(sample.chain, k, sample.time, false);
            values[1][sensor_beads[k]] = force(sample.chain, k, sample.time, true);
        }
        sample.field[BEAD_FIELD_FORCE] = values[0];
        sample.comparison[BEAD_FIELD_FORCE] = values[1];
        assert_int_equal(bead_plot_data_feed(run.data, &sample, &msg), BEAD_OK);
    }
    assert_int_equal(bead_plot_data_finish(run.data, NULL, &msg), BEAD_OK);
    run.panels = bead_plot_data_panels(run.data, &run.count);
    assert_int_equal(run.count, CHAINS << (strstr(settings, "measured") != NULL));
    return run;
}

static void release(struct run *run)
{
    bead_plot_data_destroy(run->data);
    for (size_t c = 0; c < CHAINS; c++)
        bead_chain_destroy(run->chains[c]);
    bead_scene_free(run->scene);
}

static double largest(const struct run *run, size_t panel, size_t sensor)
{
    double found = 0;
    const struct bead_series *series = &run->panels[panel].series[sensor];
    assert_true(series->count >= SAMPLES - 2);
    for (size_t i = 0; i < series->count; i++)
        found = fmax(found, series->y[i]);
    return found;
}

static void test_forces_are_divided_as_asked(void **state)
{
    (void)state;
    struct run plain = plot(""), first = plot(", normalise: first"), own = plot(", normalise: max");
    for (size_t c = 0; c < CHAINS; c++) {
        for (size_t k = 0; k < SENSORS; k++) {
            double force_of = largest(&plain, c, k), first_of = largest(&plain, c, 0);
            assert_true(fabs(force_of / amplitudes[c][k] - 1) < 0.01);
            assert_true(fabs(largest(&first, c, k) - force_of / first_of) < 1e-12);
            assert_true(fabs(largest(&own, c, k) - 1) < 1e-12);
        }
        assert_string_equal(plain.panels[c].y.unit, "N");
        assert_string_equal(first.panels[c].y.unit, "");
        assert_non_null(strstr(first.panels[c].y.title, "*F*/\u2060*F*_{max}(a\\_1)"));
        assert_non_null(strstr(own.panels[c].y.title, "*F*/\u2060*F*_{max}"));
    }
    release(&plain);
    release(&first);
    release(&own);
}

/* The first sample counts, and the last. */
static void test_peaks_are_found_at_either_end(void **)
{
    for (int k = 0; k < 2; k++) {
        only_at = 1e-3 * k;
        struct run run = plot(", normalise: max");
        for (size_t c = 0; c < CHAINS; c++) {
            for (size_t s = 0; s < SENSORS; s++)
                assert_true(fabs(largest(&run, c, s) - 1) < 1e-12);
        }
        release(&run);
    }
    only_at = NAN;
}

static void test_chains_share_one_axis(void **state)
{
    (void)state;
    static const char *const settings[] = {"", ", range: [0, 50 N]", ", range: [0, 2], normalise: max"};
    static const double high[] = {20, 50, 2};
    for (size_t s = 0; s < 3; s++) {
        struct run run = plot(settings[s]);
        struct bead_graph graph = {.panels = run.panels, .panel_count = run.count, .share_x = true, .share_y = true};
        struct bead_look look;
        struct graph_layout layout;
        struct bead_message msg = {""};
        bead_look_screen(&look, 800, 600, false);
        assert_int_equal(graph_layout_make(&graph, &look, 800, 600, NULL, &layout, &msg), BEAD_OK);
        for (size_t c = 0; c < CHAINS; c++) {
            assert_true(layout.cells[c].low[1] == 0 && layout.cells[c].high[1] == layout.cells[0].high[1]);
            assert_true(layout.cells[c].low[0] == 0 && layout.cells[c].high[0] == 1e-3);
        }
        assert_true(s > 0 ? layout.cells[0].high[1] == high[s]
                          : layout.cells[0].high[1] > high[s] && layout.cells[0].high[1] < 1.2 * high[s]);
        graph_layout_free(&layout);
        release(&run);
    }
}

/* 0.5 N is more than a hundredth of 21 N, and less than one of 100 N. */
static void test_horizons_are_marked(void **state)
{
    (void)state;
    struct run run = plot(", trust: true");
    for (size_t c = 0; c < CHAINS; c++) {
        assert_int_equal(run.panels[c].ruler_count, 1);
        assert_true(fabs(run.panels[c].rulers[0].value - 0.5e-3) < 1e-5);
        assert_non_null(strstr(run.panels[c].title, "predictable until"));
    }
    release(&run);
    run = plot(", trust: true, range: [0, 100 N]");
    assert_int_equal(run.panels[0].ruler_count, 0);
    assert_non_null(strstr(run.panels[0].title, "predictable throughout"));
    release(&run);
}

/* At the first sensor, a straight line was measured, 1 N at 0.2 ms and 4 N at 0.8 ms, in volts, microseconds and with a late
 * trigger: it is drawn at its place, and its difference from the computed curve is below. */
static void test_differences_are_below(void **state)
{
    (void)state;
    static const char *const trusts[] = {"", ", trust: true"}; /* the difference from a comparison run is not a residual */
    for (int trust = 0; trust < 2; trust++) {
        char settings[200];
        snprintf(settings, sizeof settings,
                 ", measured: {points: '0 2, 1e-4 1.8, 3e-4 1.4, 6e-4 0.8', gain: -2.5 N, offset: 6 N, start: 0.2 ms}%s",
                 trusts[trust]);
        struct run run = plot(settings);
        for (size_t c = 0; c < CHAINS; c++) {
            const struct bead_series *measured = &run.panels[c].series[SENSORS], *rest = &run.panels[CHAINS + c].series[0];
            assert_int_equal(run.panels[c].series_count, SENSORS + 1);
            assert_int_equal(run.panels[CHAINS + c].series_count, 1);
            assert_true(measured->count == 4 && rest->count == 4);
            for (size_t i = 0; i < 4; i++) {
                const double t = measured->x[i];
                assert_true(fabs(measured->y[i] - (1 + 5e3 * (t - 0.2e-3))) < 1e-12);
                assert_true(rest->x[i] == t && fabs(rest->y[i] - (measured->y[i] - force(c, 0, t, false))) < 1e-3);
            }
            assert_true(measured->x[0] == 0.2e-3 && fabs(measured->x[3] - 0.8e-3) < 1e-18);
        }
        release(&run);
    }
    struct run run = plot(", measured: {points: '0 2, 1e-4 1.8'}, time: [0.05 ms, 1 ms]");
    assert_int_equal(run.panels[0].series[SENSORS].count, 1);
    release(&run);
}

/* The word of a band is in it; beside one that is thinner than letters; nowhere if curves leave no room. */
static void test_words_stand_in_bands(void **state)
{
    (void)state;
    enum { POINTS = 400 };
    static double x[POINTS], line[POINTS], dense[POINTS];
    for (int i = 0; i < POINTS; i++) {
        x[i] = i / (POINTS - 1.);
        line[i] = 100 * x[i];
        dense[i] = 100 * (i % 2);
    }
    static const struct bead_ruler rulers[] = {
        {false, NAN, 60, 90, "wide"}, {false, NAN, 20, 20.5, "thin"}, {true, NAN, 0.6, 0.9, "along"}};
    for (int full = 0; full < 2; full++) {
        const struct bead_series series = {.x = x, .y = full ? dense : line, .count = POINTS, .mark = BEAD_MARK_LINE};
        const struct bead_panel panel = {.x = {"x", "", 0, 1, BEAD_SCALE_LINEAR, false},
                                         .y = {"y", "", 0, 100, BEAD_SCALE_LINEAR, false},
                                         .series = &series,
                                         .series_count = 1,
                                         .rulers = rulers,
                                         .ruler_count = 3};
        const struct bead_graph graph = {.panels = &panel, .panel_count = 1};
        struct bead_look look;
        struct graph_layout layout;
        struct bead_message msg = {""};
        bead_look_screen(&look, 800, 600, false);
        assert_int_equal(graph_layout_make(&graph, &look, 800, 600, NULL, &layout, &msg), BEAD_OK);
        const struct graph_cell *cell = &layout.cells[0];
        const struct bead_rect plot = cell->plot;
        for (int r = 0; r < 3; r++)
            assert_int_equal(cell->words[r].state, full ? GRAPH_WORD_NONE : GRAPH_WORD_PLACED);
        const struct graph_box wide = cell->words[0].box, thin = cell->words[1].box, along = cell->words[2].box;
        if (!full) {
            assert_true(wide.y > plot.y + 0.1 * plot.height && wide.y + wide.height < plot.y + 0.4 * plot.height);
            const double above = plot.y + 0.795 * plot.height - (thin.y + thin.height),
                         below = thin.y - (plot.y + 0.8 * plot.height);
            assert_true(fmax(above, below) > 0 && fmax(above, below) < 2 * graph_air(&look));
            assert_true(along.x > plot.x + 0.6 * plot.width && along.x + along.width < plot.x + 0.9 * plot.width);
        }
        graph_layout_free(&layout);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forces_are_divided_as_asked), cmocka_unit_test(test_peaks_are_found_at_either_end),
        cmocka_unit_test(test_chains_share_one_axis),       cmocka_unit_test(test_horizons_are_marked),
        cmocka_unit_test(test_differences_are_below),       cmocka_unit_test(test_words_stand_in_bands),
    };
    return cmocka_run_group_tests_name("plots", tests, NULL, NULL);
}
