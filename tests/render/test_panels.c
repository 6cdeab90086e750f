/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of several panels: places of plots, what they share, and the same picture from a trajectory. */
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
#include "render/figure/figure.h"
#include "render/figure/panels_private.h"
#include "sessions.h"

static struct bead_still *make_panels(struct built *built, const char *settings)
{
    char output[900];
    struct bead_message msg = {""};
    struct bead_still *still = calloc(1, bead_panels.size);
    snprintf(output, sizeof output, "image: a.png, %s", settings);
    *built = build_chain(output);
    struct bead_run_context context = make_stage(built);
    if (!still || bead_panels.create(&built->scene->outputs[0], &context, still, &msg))
        fail_msg("%s", msg.text);
    return still;
}

static void release(struct built *built, struct bead_still *still)
{
    bead_panels.destroy(still);
    free(still);
    release_chain(built);
}

static struct bead_rect plot_of(const struct still_panel *panel)
{
    const struct bead_insets *in = &panel->insets;
    const struct bead_rect *area = &panel->area;
    struct bead_rect from_insets = {(int)(area->x + in->left), (int)(area->y + in->top), (int)(area->width - in->left - in->right),
                                    (int)(area->height - in->top - in->bottom)};
    if (panel->figure) { /* the figure keeps to it */
        struct bead_rect real = panel->figure->cells[0].panel[0].plot;
        assert_true(real.x == from_insets.x && real.y == from_insets.y && real.width == from_insets.width);
        assert_true(real.height == from_insets.height);
    }
    return from_insets;
}

static void test_plots_stand_in_rows_and_columns(void **state)
{
    (void)state;
    static const char *const styles[] = {"size: [1280, 720]", "style: paper, dpi: 300", "style: slide", "style: movie",
                                         "size: [700, 500]"};
    for (size_t s = 0; s < sizeof styles / sizeof styles[0]; s++) {
        char settings[400];
        struct built built;
        snprintf(
            settings, sizeof settings,
            "%s, panels: [[{field: force}, {field: force}], [{field: velocity}, {field: energy}], [{show: peaks}, {field: force}]]",
            styles[s]);
        struct bead_still *still = make_panels(&built, settings);
        struct bead_rect page = {0, 0, still->page.width, still->page.height};
        for (size_t p = 0; p < still->count; p++) {
            const struct still_panel *panel = &still->panels[p];
            struct bead_rect plot = plot_of(panel), left = plot_of(panels_at(still, panel->row, 0));
            struct bead_rect top = plot_of(panels_at(still, 0, panel->column));
            const struct bead_rect *area = &panel->area;
            assert_true(plot.y == left.y && plot.height == left.height); /* one row */
            assert_true(plot.x == top.x && plot.width == top.width);     /* one column */
            assert_true(area->x >= 0 && area->y >= 0 && area->x + area->width <= page.width &&
                        area->y + area->height <= page.height);
            for (size_t q = 0; q < p; q++) {
                const struct bead_rect *other = &still->panels[q].area;
                assert_false(area->x < other->x + other->width && other->x < area->x + area->width &&
                             area->y < other->y + other->height && other->y < area->y + area->height);
            }
        }
        release(&built, still);
    }
}

static bool labelled_across(const struct bead_still *still, size_t panel)
{
    return !still->panels[panel].set.no_across;
}

static void test_labels_and_bars_are_shared(void **state)
{
    (void)state;
    struct built built;
    struct bead_still *still =
        make_panels(&built, "size: [1280, 900], panels: [[{field: force}, {field: force}], [{field: velocity}, "
                            "{field: velocity, time: [0, 0.5 ms]}], [{field: velocity}, {show: peaks}]]");
    for (size_t p = 0; p < still->count; p++)
        assert_true(labelled_across(still, p)); /* in each row one has another axis below, or none */
    assert_true(still->panels[1].set.no_upwards && !still->panels[0].set.no_upwards); /* the same beads at the left */
    assert_true(still->panels[0].set.no_bar && !still->panels[1].set.no_bar);
    assert_true(still->panels[2].set.no_bar && !still->panels[3].set.no_bar && !still->panels[4].set.no_bar);
    release(&built, still);
    still =
        make_panels(&built, "size: [1280, 900], panels: [[{field: force}, {field: force}], [{field: velocity}, {field: velocity}], "
                            "[{show: peaks}, {show: peaks}]]");
    for (size_t p = 0; p < still->count; p++)
        assert_int_equal(labelled_across(still, p), p >= 2); /* the same time below both of the first row */
    release(&built, still);
    still = make_panels(&built, "size: [700, 900], panels: [[{field: force}], [{field: force}], [{field: force, range: [0, 9]}]]");
    const struct bead_rect *bar = &still->panels[0].figure->bar;
    assert_true(still->panels[1].set.no_bar && !still->panels[2].set.no_bar); /* its own range */
    assert_int_equal(bar->y, plot_of(&still->panels[0]).y);
    assert_int_equal(bar->y + bar->height, plot_of(&still->panels[1]).y + plot_of(&still->panels[1]).height);
    release(&built, still);
}

/* Panels of one field have one range; one that asks for another, or for other colours, has its own. */
static void test_ranges_are_those_of_the_field(void **state)
{
    (void)state;
    struct built built;
    struct bead_message msg = {""};
    char path[512];
    struct bead_still *still =
        make_panels(&built, "size: [900, 600], panels: [[{field: force}, {field: force, beads: [0, 4], time: [0, 0.3 "
                            "ms]}, {field: force, time: [0, 0.3 ms], colormap: inferno}]]");
    for (size_t i = 0; i <= 200; i++) {
        double values[16] = {0}, time = 1e-3 * (double)i / 200;
        struct bead_sample sample = {.time = time, .index = i, .active = 10};
        for (size_t b = 0; b < 10; b++)
            values[b] = 100 * time * 1e3 * (double)(b + 1); /* largest at the end */
        sample.field[BEAD_FIELD_FORCE] = values;
        assert_int_equal(bead_panels.feed(still, &sample, &msg), BEAD_OK);
    }
    in_directory("a.png", path, sizeof path);
    assert_int_equal(panels_write(still, NULL, path, NULL, &msg), BEAD_OK);
    double all = still->panels[0].figure->range.high, part = still->panels[1].figure->range.high,
           own = still->panels[2].figure->range.high;
    assert_true(all > 980 && part == all && own > 280 && own < 310);
    release(&built, still);
}

/* The moment of the other views is a light line in the space-time image; rows of beads take no more height than they use. */
static void test_stills_mark_their_moment(void **state)
{
    (void)state;
    struct built built;
    struct bead_message msg = {""};
    char path[512];
    struct bead_still *still =
        make_panels(&built, "size: [700, 900], caption: c, views: [beads, profile, spacetime], at: 0.5 ms, time: [0, 1 ms]");
    for (size_t i = 0; i <= 1000; i++) {
        struct bead_sample *sample = make_sample(&built, 1e-6 * (double)i);
        sample->index = i;
        assert_int_equal(bead_panels.feed(still, sample, &msg), BEAD_OK);
        free_sample(sample);
    }
    in_directory("a.png", path, sizeof path);
    assert_int_equal(panels_write(still, NULL, path, NULL, &msg), BEAD_OK);
    const struct bead_tile *tiles = still->panels[0].figure->cells[0].panel;
    struct png_file png = read_png(path);
    const struct bead_rect *plot = &tiles[2].plot;
    int white = 0, first = 0;
    for (int y = plot->y; y < plot->y + plot->height; y++) {
        int row = 0;
        for (int x = plot->x; x < plot->x + plot->width; x++) {
            const uint8_t *rgb = png.rgb + 3 * ((size_t)y * (size_t)png.width + (size_t)x);
            row += rgb[0] > 250 && rgb[1] > 250 && rgb[2] > 250;
        }
        first = row == plot->width && white == 0 ? y : first;
        white += row == plot->width;
    }
    assert_int_equal(white, (int)still->look.line);
    assert_true(abs(first - plot->y - plot->height / 2) <= 2);
    assert_true(tiles[0].plot.height <= tiles[0].type->most_height(&tiles[0].setup, tiles[0].plot.width));
    assert_true(tiles[0].plot.height < plot->height / 2);
    /* The profile is that of the moment: a line in each column, highest at the bead with the largest force. */
    const struct bead_rgb ink = still->look.accent, page = still->look.panel; /* the area below the line is less than half ink */
    const double whole = pow(ink.r - page.r, 2) + pow(ink.g - page.g, 2) + pow(ink.b - page.b, 2);
    struct bead_sample *then = make_sample(&built, 0.5e-3);
    size_t most = 0;
    int columns = 0, top = png.height, top_at = 0;
    for (size_t b = 0; b < bead_chain_beads(built.chain); b++)
        most = then->field[BEAD_FIELD_FORCE][b] > then->field[BEAD_FIELD_FORCE][most] ? b : most;
    plot = &tiles[1].plot;
    for (int x = plot->x; x < plot->x + plot->width; x++) {
        int y = plot->y;
        const uint8_t *rgb = png.rgb + 3 * ((size_t)y * (size_t)png.width + (size_t)x);
        for (; y < plot->y + plot->height; y++, rgb += 3 * png.width)
            if (((rgb[0] / 255.0 - page.r) * (ink.r - page.r) + (rgb[1] / 255.0 - page.g) * (ink.g - page.g) +
                 (rgb[2] / 255.0 - page.b) * (ink.b - page.b)) > 0.6 * whole)
                break;
        columns += y < plot->y + plot->height;
        top_at = y < top ? x : top_at;
        top = y < top ? y : top;
    }
    const double pitch = (double)plot->width / (double)bead_chain_beads(built.chain);
    assert_true(columns > plot->width - 1.2 * pitch);
    assert_true(fabs(top_at + 0.5 - plot->x - ((double)most + 0.5) * pitch) < 0.5 * pitch);
    free_sample(then);
    free(png.rgb);
    release(&built, still);
}

/* Of all samples a still keeps the first one that is not before its moment, and the one before that, with all their values. */
static void test_stills_keep_their_moment(void **state)
{
    (void)state;
    static const double moments[] = {0.3, 0.3004, 0}; /* ms */
    for (size_t m = 0; m < 3; m++) {
        struct built built;
        struct bead_message msg = {""};
        char settings[200];
        snprintf(settings, sizeof settings, "size: [700, 900], caption: c, views: [beads, profile], at: %g ms", moments[m]);
        struct bead_still *still = make_panels(&built, settings);
        const double every = still->panels[0].figure->grid.every;
        for (size_t i = 0; i <= 400; i++) {
            struct bead_sample *sample = make_sample(&built, every * (double)i);
            sample->index = i;
            assert_int_equal(bead_panels.feed(still, sample, &msg), BEAD_OK);
            free_sample(sample);
        }
        const struct bead_cell *cell = &still->panels[0].figure->cells[0];
        const double last = ceil(1e-3 * moments[m] / every - 1e-6) * every;
        assert_int_equal(cell->moments, last > 0 ? 2 : 1);
        for (size_t k = last > 0 ? 0 : 1; k < 2; k++) {
            const double time = last - (k ? 0 : every);
            struct bead_sample *sample = make_sample(&built, time);
            if (!(fabs(cell->moment[k].time - time) < 1e-12))
                fail_msg("at %g ms: sample %zu is of %.9g ms, not %.9g", moments[m], k, 1e3 * cell->moment[k].time, 1e3 * time);
            for (size_t b = 0; b < bead_chain_beads(built.chain); b++)
                assert_true(fabs(cell->moment[k].field[BEAD_FIELD_FORCE][b] - sample->field[BEAD_FIELD_FORCE][b]) < 1e-6);
            free_sample(sample);
        }
        release(&built, still);
    }
}

static void run_job(const char *input, const char *output)
{
    play_counts((struct bead_job){.input = input, .output = output});
}

static void test_trajectories_draw_the_same(void **state)
{
    (void)state;
    static const char scene[] =
        "chains:\n- {name: one, striker: {bead: large-steel, velocity: 1 m/s}, beads: [{bead: large-steel, count: 8}, {bead: "
        "large-steel, sensor: s}], wall: brass}\n- {name: two, striker: {bead: large-steel, velocity: 0.5 m/s}, beads: [{bead: "
        "large-steel, count: 9}], wall: none}\nsimulate: {until: 0.3 ms}\noutputs:\n"
        "- {trajectory: run.h5, every: 1 us, fields: [displacement, velocity, force]}\n"
        "- {image: p.png, size: [900, 600], caption: \"*F*_m\", panels: [[{field: force, chain: one}, {field: velocity, chain: "
        "two}], "
        "[{show: sensors}, {views: [profile], at: 0.2 ms, chain: two, title: a profile}]]}\n";
    char path[512], from[512], again[512], directory[512];
    in_directory("", directory, sizeof directory);
    in_directory("scene.yaml", path, sizeof path);
    write_text(path, scene);
    run_job(path, directory);
    in_directory("p.png", path, sizeof path);
    struct png_file first = read_png(path);
    in_directory("run.h5", from, sizeof from);
    in_directory("again.png", again, sizeof again);
    run_job(from, again);
    struct png_file second = read_png(again);
    assert_int_equal(first.width, second.width);
    assert_int_equal(first.height, second.height);
    assert_memory_equal(first.rgb, second.rgb, 3 * (size_t)first.width * (size_t)first.height);
    free(first.rgb);
    free(second.rgb);
}

/* The room that plots keep before the run, when the numbers on their axes are unknown, is enough for the numbers of the run. */
static void assert_room(const struct bead_still *still, const struct still_panel *panel)
{
    struct bead_panel plots[PANEL_PLOTS];
    const struct bead_graph graph = panel_graph(panel, plots);
    const struct graph_frame frame = {.letter = panel->set.letter, .no_across = panel->set.no_across};
    struct graph_layout layout;
    struct bead_message msg = {""};
    const struct bead_rect area = {0, 0, panel->area.width, panel->area.height};
    assert_int_equal(graph_layout_make(&graph, &still->look, area.width, area.height, &frame, &layout, &msg), BEAD_OK);
    const struct bead_insets in = bead_layout_insets(&layout.grid, area);
    assert_true(in.left > 0 && in.left <= panel->insets.left && in.top <= panel->insets.top);
    assert_true(in.bottom > 0 && in.right <= panel->insets.right && in.bottom <= panel->insets.bottom);
    graph_layout_free(&layout);
}

/* Profiles beside an image: the values of their times, whatever the times of the image are. */
static void test_profiles_are_panels(void **state)
{
    (void)state;
    struct built built;
    struct bead_message msg = {""};
    char path[512];
    struct bead_still *still =
        make_panels(&built, "size: [900, 500], panels: [[{field: velocity, time: [0, 1 ms]}, {show: profiles, field: "
                            "velocity, at: [0.25 ms, 0.7003 ms]}]]");
    struct bead_needs needs;
    bead_panels.needs(still, &needs);
    assert_true(needs.grid.every > 0 && needs.grid.start == 0 && needs.grid.end >= 1e-3);
    const size_t count = bead_grid_count(&needs.grid);
    for (size_t i = 0; i < count; i++) {
        double values[16] = {0}, time = needs.grid.start + (double)i * needs.grid.every;
        struct bead_sample sample = {.time = time, .index = i, .active = 10};
        for (size_t b = 0; b < 10; b++)
            values[b] = 1e3 * time * (double)(b + 1);
        sample.field[BEAD_FIELD_VELOCITY] = values;
        assert_int_equal(bead_panels.feed(still, &sample, &msg), BEAD_OK);
    }
    in_directory("a.png", path, sizeof path);
    assert_int_equal(panels_write(still, NULL, path, NULL, &msg), BEAD_OK);
    size_t panels;
    const struct bead_panel *panel = bead_plot_data_panels(still->panels[1].plot, &panels);
    assert_room(still, &still->panels[1]);
    assert_true(panels == 1 && panel->series_count == 2 && panel->series[0].count == 10);
    for (size_t b = 0; b < 10; b++) {
        assert_true(fabs(panel->series[0].y[b] - 0.25 * (double)(b + 1)) < 1e-9);
        assert_true(fabs(panel->series[1].y[b] - 0.7003 * (double)(b + 1)) < 1e-9);
    }
    release(&built, still);
}

/* Energies of modes at the requested times, from samples that other panels need closer. */
static void test_modes_are_panels(void **state)
{
    (void)state;
    static const char scene[] = "chain: {equation: fput, points: 7, start: {mode: 1}}\nsimulate: {until: 10}\n"
                                "outputs: [{image: a.png, panels: [[{show: modes, modes: 2, every: 1}, {field: displacement}]]}]\n";
    struct bead_message msg = {""};
    struct bead_scene *parsed;
    struct bead_chain *chain;
    struct bead_plot_data *data;
    assert_int_equal(bead_scene_parse("test", scene, sizeof scene - 1, NULL, &parsed, &msg), BEAD_OK);
    assert_int_equal(bead_chain_create(parsed, 0, &chain, &msg), BEAD_OK);
    const struct bead_chain *const chains[] = {chain};
    struct bead_run_context context = {
        .scene = parsed, .chains = chains, .chain_count = 1, .end = 10, .resolution = 0.25, .directory = "."};
    assert_int_equal(bead_plot_data_create(&parsed->outputs[0].still.panels[0], &context, SIZE_MAX, &data, &msg), BEAD_OK);
    for (size_t i = 0; i <= 40; i++) {
        double u[9], v[9] = {0}, time = 0.25 * (double)i;
        struct bead_sample sample = {.time = time, .index = i, .active = 7};
        for (size_t b = 0; b < 9; b++)
            u[b] = time;
        for (unsigned f = 0; f < BEAD_FIELD_COUNT; f++)
            sample.field[f] = v;
        sample.field[BEAD_FIELD_DISPLACEMENT] = u;
        assert_int_equal(bead_plot_data_feed(data, &sample, &msg), BEAD_OK);
    }
    assert_int_equal(bead_plot_data_finish(data, NULL, &msg), BEAD_OK);
    size_t panels;
    const struct bead_panel *panel = bead_plot_data_panels(data, &panels);
    const struct bead_series *first = &panel->series[0];
    assert_true(panels == 1 && panel->series_count == 2 && first->count == 11);
    for (size_t i = 0; i < 11; i++) {
        assert_true(first->x[i] == (double)i);
        assert_true(fabs(first->y[i] - first->y[1] * (double)(i * i)) < 1e-9 * first->y[10]); /* energy as the square */
    }
    assert_true(first->y[10] > 0);
    bead_plot_data_destroy(data);
    bead_chain_destroy(chain);
    bead_scene_free(parsed);
}

/* Bars whose labels become wider once their range is known; long titles beside moments. */
static void test_panels_are_not_cut(void **state)
{
    (void)state;
    static const char *const panels[] = {
        "[[{field: force}, {field: velocity, views: [beads, spacetime], at: 0.2 ms}], [{show: peaks}, {show: peaks}]]",
        "[[{field: velocity, views: [beads, profile, spacetime]}, {field: displacement, views: [profile, spacetime]}]]",
        ("[[{show: peaks}, {field: velocity, views: [profile], at: 0.2 ms, title: \"A title that has no room at all *F*_{max} in "
         "whatever is left of the width of this, and goes on for quite a while until it ends at *M* = 1\"}]]")};
    static const char *const styles[] = {"style: paper, dpi: 110", "style: paper, dpi: 200", "size: [900, 600]"};
    char path[512], directory[512], text[1400];
    in_directory("", directory, sizeof directory);
    in_directory("cut.yaml", path, sizeof path);
    for (size_t i = 0; i < 9; i++) {
        char picture[512];
        snprintf(
            text, sizeof text,
            "chain: {striker: {bead: large-steel, velocity: 0.443 m/s}, beads: [{cell: [large-steel, aluminium], count: 20}]}\n"
            "outputs: [{image: cut.png, %s, panels: %s}]\n",
            styles[i % 3], panels[i / 3]);
        write_text(path, text);
        run_job(path, directory);
        in_directory("cut.png", picture, sizeof picture);
        struct png_file png = read_png(picture);
        assert_border_white(&png, panels[i / 3]);
        free(png.rgb);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plots_stand_in_rows_and_columns),
        cmocka_unit_test(test_labels_and_bars_are_shared),
        cmocka_unit_test(test_ranges_are_those_of_the_field),
        cmocka_unit_test(test_stills_mark_their_moment),
        cmocka_unit_test(test_stills_keep_their_moment),
        cmocka_unit_test(test_trajectories_draw_the_same),
        cmocka_unit_test(test_panels_are_not_cut),
        cmocka_unit_test(test_profiles_are_panels),
        cmocka_unit_test(test_modes_are_panels),
    };
    return cmocka_run_group_tests_name("sheets", tests, make_directory, remove_directory);
}
