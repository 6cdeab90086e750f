/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges, words, legends and names of curves in graphs: each is where its rule puts it, in numbers. */
#include "graphs.h"
#include "render/draw/looks.h"
#include "render/draw/markup.h"
#include "strokes.h"
#include "tests/texts.h"

enum { LEFT = 100, TOP = 50, WIDTH = 400, HEIGHT = 200, RIGHT = LEFT + WIDTH, BOTTOM = TOP + HEIGHT };

static const double em = 20, air = 0.28 * 20;
static struct bead_look look;
static struct bead_panel panel;
static struct graph_cell cell;

static int set_up(void **)
{
    strokes.on = false;
    bead_look_screen(&look, 1000, 800, false);
    look.label = em;
    look.tick = 18;
    look.line = 2;
    look.margin = 30;
    panel = (struct bead_panel){.series_count = 0};
    cell = (struct graph_cell){.panel = &panel, .plot = {LEFT, TOP, WIDTH, HEIGHT}, .high = {10, 10}};
    bead_axis_make(&cell.axis[0], 0, 10, "", BEAD_SCALE_LINEAR, WIDTH, look.tick, true);
    bead_axis_make(&cell.axis[1], 0, 10, "", BEAD_SCALE_LINEAR, HEIGHT, look.tick, false);
    return 0;
}

static double width_of(const char *markup, double size)
{
    struct bead_text_style style = graph_text(&look);
    double width, height;
    style.size = size;
    bead_text_size(NULL, &style, markup, &width, &height);
    return width;
}

static double height_of(const char *markup)
{
    struct bead_text_style style = graph_text(&look);
    double width, height;
    bead_text_size(NULL, &style, markup, &width, &height);
    return height;
}

/* ---- ranges ---- */

static void assert_range(struct bead_graph_axis axis, bool of_y, const double *values, size_t count, enum bead_mark mark,
                         double low, double high)
{
    static const double others[] = {3, 3, 3, 3, 3, 3};
    struct bead_message msg = {""};
    const struct bead_series series = {.x = of_y ? others : values, .y = of_y ? values : others, .count = count, .mark = mark};
    const struct bead_graph_axis other = {.unit = "", .low = 0, .high = 9};
    axis.unit = axis.unit ? axis.unit : "";
    struct bead_panel p = {.x = of_y ? other : axis, .y = of_y ? axis : other, .series = &series, .series_count = 1};
    const struct bead_graph graph = {.panels = &p, .panel_count = 1};
    struct graph_cell found = {.panel = &p};
    struct graph_layout layout = {.graph = &graph, .cells = &found};
    assert_int_equal(graph_find_ranges(&layout, &msg), BEAD_OK);
    if (!(fabs(found.low[of_y] - low) <= 1e-9 * fmax(1e-4, fabs(low)) && fabs(found.high[of_y] - high) <= 1e-9 * fabs(high)))
        fail_msg("%s from %g: %.12g to %.12g, not %.12g to %.12g", of_y ? "y" : "x", values[0], found.low[of_y], found.high[of_y],
                 low, high);
    assert_true(found.low[!of_y] == 0 && found.high[!of_y] == 9);
}

static void ranges_leave_room_around_the_data(void **)
{
    const struct bead_graph_axis plain = {.low = NAN, .high = NAN}, zero = {.low = NAN, .high = NAN, .zero = true},
                                 counts = {.unit = "1", .low = NAN, .high = NAN},
                                 logs = {.low = NAN, .high = NAN, .scale = BEAD_SCALE_LOG};
    const enum bead_mark line = BEAD_MARK_LINE, points = BEAD_MARK_POINTS;
    const double data[] = {2, 12, 7, NAN, INFINITY}, around[] = {-4, 6}, one[] = {5, 5}, none[] = {0, 0}, empty[] = {NAN},
                 near[] = {1, 1 + 1e-12}, decades[] = {1, 100, -3, 0}, many[] = {1, 1e12}, few[] = {0, 4}, lots[] = {0, 100};
    /* y: 6 % at both ends, but not below a zero that the axis begins with; x: 3 % around points, and lines from end to end. */
    assert_range(plain, true, data, 5, line, 2 - 0.6, 12 + 0.6);
    assert_range(zero, true, data, 5, line, 0, 12 + 0.72);
    assert_range(zero, true, around, 2, line, -4 - 0.6, 6 + 0.6);
    assert_range(plain, false, data, 5, line, 2, 12);
    assert_range(plain, false, data, 5, points, 2 - 0.3, 12 + 0.3);
    /* Counts have half of one at least; one value a tenth of it, nothing a range of one. */
    assert_range(counts, false, few, 2, points, -0.5, 4.5);
    assert_range(counts, false, lots, 2, points, -3, 103);
    assert_range(counts, false, lots, 2, line, 0, 100);
    assert_range(counts, false, one, 2, points, 4.5, 5.5);
    assert_range(plain, true, one, 2, line, 4.5, 5.5);
    assert_range(zero, true, one, 2, line, 0, 5.3);
    assert_range(plain, true, none, 2, line, -1, 1);
    assert_range(plain, true, near, 2, line, 0.9, 1.1);
    assert_range(plain, true, empty, 1, line, -0.06, 1.06);
    /* Logarithmic: a factor of 1.3, or 4 % of the decades; values not above 0 do not count. */
    assert_range(logs, true, decades, 4, line, 1 / 1.3, 130);
    assert_range(logs, true, many, 2, line, pow(10, -0.48), pow(10, 12.48));
    assert_range(logs, false, decades, 4, line, 1, 100);
    assert_range(logs, false, decades, 4, points, 1 / 1.3, 130);
    assert_range(logs, false, one, 2, line, 5 / 1.3, 5 * 1.3);
    assert_range(logs, true, empty, 1, line, 1 / 1.3, 13);
    /* Ends as requested; a single one beyond the data gets a sensible other one. */
    static const struct {
        double low, high, found[2];
        enum bead_scale scale;
    } asked[] = {{3, 8, {3, 8}, BEAD_SCALE_LINEAR},        {3, NAN, {3, 12.6}, BEAD_SCALE_LINEAR},
                 {NAN, 8, {1.4, 8}, BEAD_SCALE_LINEAR},    {20, NAN, {20, 40}, BEAD_SCALE_LINEAR},
                 {NAN, -5, {-10, -5}, BEAD_SCALE_LINEAR},  {50, NAN, {50, 500}, BEAD_SCALE_LOG},
                 {NAN, 0.01, {1e-6, 0.01}, BEAD_SCALE_LOG}};
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        const struct bead_graph_axis axis = {.low = asked[i].low, .high = asked[i].high, .scale = asked[i].scale};
        assert_range(axis, true, data, 5, line, asked[i].found[0], asked[i].found[1]);
    }
}

/* Points of which one number is missing take no room along the other axis. */
static void half_points_take_no_room(void **)
{
    static const double whole[] = {4, 6, 8}, part[] = {NAN, 6, 8}, wide[] = {-100, 6, 8};
    struct bead_message msg = {""};
    for (int k = 0; k < 2; k++) {
        const struct bead_graph_axis axis = {.unit = "", .low = NAN, .high = NAN};
        const struct bead_series series[2] = {{.x = k ? part : wide, .y = k ? wide : part, .count = 3},
                                              {.x = whole, .y = whole, .count = 3}};
        const struct bead_panel p = {.x = axis, .y = axis, .series = series, .series_count = 2};
        const struct bead_graph graph = {.panels = &p, .panel_count = 1};
        struct graph_cell found = {.panel = &p};
        struct graph_layout layout = {.graph = &graph, .cells = &found};
        assert_int_equal(graph_find_ranges(&layout, &msg), BEAD_OK);
        assert_true(found.low[0] == 4 && found.high[0] == 8 && found.low[1] > 3 && found.high[1] < 9);
    }
}

/* ---- the mask of what is covered, and words beside rulers ---- */

static struct graph_mask mask_of(const struct bead_series *series, size_t count)
{
    struct bead_message msg = {""};
    struct graph_mask mask;
    panel.series = series;
    panel.series_count = count;
    assert_int_equal(graph_mask_make(&cell, &look, &mask, &msg), BEAD_OK);
    return mask;
}

static unsigned covered(const struct graph_mask *mask, double x, double y, double width, double height)
{
    return graph_mask_covered(mask, (struct graph_box){x, y, width, height});
}

/* Cells of 0.18 em; a level line through the middle of one row of them covers that row and no other. */
static void masks_count_covered_cells(void **)
{
    static const double x[] = {-1, 11};
    const double size = 0.18 * em;
    const double level = 10 - (30.5 * size) / HEIGHT * 10, y[] = {level, level};
    look.line = 1; /* 1.8 px with its width of letters: within its cell */
    const struct bead_series series = {.x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE};
    struct graph_mask mask = mask_of(&series, 1);
    const int across = (int)floor(WIDTH / size), down = (int)floor(HEIGHT / size);
    assert_true(mask.cell == size && mask.x == LEFT && mask.y == TOP && mask.width == across && mask.height == down);
    assert_int_equal(covered(&mask, LEFT, TOP, across * size - 0.1, down * size - 0.1), across);
    assert_int_equal(covered(&mask, LEFT, TOP, across * size, 30 * size - 0.1), 0);
    assert_int_equal(covered(&mask, LEFT, TOP, across * size, 30 * size + 0.1), across);
    assert_int_equal(covered(&mask, LEFT, TOP + 31 * size + 0.1, across * size, 10 * size), 0);
    assert_int_equal(covered(&mask, LEFT + 10.5 * size, TOP + 28 * size, 3 * size, 6 * size), 4); /* everything it touches */
    for (int side = 0; side < 4; side++) { /* out of the plot: as if all were covered */
        const double out[4][2] = {{-0.1, 0}, {0, -0.1}, {0.1, 0}, {0, 0.1}}, *o = out[side];
        const double x0 = o[0] > 0 ? LEFT + (across - 5) * size : LEFT, y0 = o[1] > 0 ? TOP + (down - 5) * size : TOP;
        assert_int_equal(covered(&mask, x0, y0, 5 * size, 5 * size), 0);
        assert_true(covered(&mask, x0 + o[0], y0 + o[1], 5 * size, 5 * size) > 1000000);
    }
    graph_mask_cover(&mask, (struct graph_box){LEFT + 20.1 * size, TOP + 10.1 * size, 3.8 * size, 2.8 * size});
    assert_true(covered(&mask, LEFT + 23.5 * size, TOP + 12.5 * size, size, size) > 0);
    assert_true(covered(&mask, LEFT + 19.5 * size, TOP + 9.5 * size, size, size) > 0);
    for (int side = 0; side < 4; side++) {
        const double beside[4][2] = {{14, 10}, {24.01, 10}, {20, 4}, {20, 13.01}};
        assert_int_equal(covered(&mask, LEFT + beside[side][0] * size, TOP + beside[side][1] * size, 5.9 * size, 5.9 * size), 0);
    }
    graph_mask_free(&mask);
}

/* A word beside a line: right of an upright one at the top, above a level one at the right; on the other side, or further along,
 * where that hides something; only within the plot. */
static void words_stand_beside_their_lines(void **)
{
    static const double far[] = {-1, 11}, high[] = {9.5, 9.5}, low[] = {6, 6};
    const double gap = air + 0.6 * look.line, inset = 0.6 * air, width = width_of("word", em), height = height_of("word");
    static const struct {
        bool vertical;
        double value;
        int side; /* 1: left or below */
    } cases[] = {{true, 5, 0}, {true, 9.85, 1}, {true, 1.05, 0}, {false, 5, 0}, {false, 9.8, 1}, {false, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct bead_ruler ruler = {cases[i].vertical, cases[i].value, NAN, NAN, "word"};
        struct graph_word word = {.markup = (char[]){"word"}};
        panel.rulers = &ruler;
        panel.ruler_count = 1;
        cell.words = &word;
        struct graph_mask mask = mask_of(NULL, 0);
        if (graph_words_place(&cell, &look, &mask))
            fail_msg("case %zu: %g %g", i, word.box.x, word.box.y);
        assert_int_equal(word.state, GRAPH_WORD_PLACED);
        const double at = cases[i].vertical ? LEFT + 40 * cases[i].value : BOTTOM - 20 * cases[i].value;
        if (cases[i].vertical) {
            assert_at(word.box.x, cases[i].side ? at - gap - width : at + gap);
            assert_at(word.box.y, TOP + inset);
        } else {
            assert_at(word.box.x,
                      RIGHT - inset - width - (WIDTH - width - 2 * inset) / 23); /* the first with its air in the plot */
            assert_at(word.box.y, cases[i].side ? at + gap : at - gap - height);
        }
        assert_true(word.box.width == width && word.box.height == height);
        /* Its place is taken, with part of the clear distance: the next word is further along. */
        struct graph_word second = {.markup = word.markup};
        cell.words = &second;
        if (graph_words_place(&cell, &look, &mask))
            fail_msg("case %zu", i);
        if (cases[i].vertical)
            assert_true(fabs(second.box.x - word.box.x) > 1 || second.box.y >= word.box.y + height + 0.3 * air);
        else
            assert_true(fabs(second.box.y - word.box.y) > 1 || second.box.x <= word.box.x - width - 0.8 * air);
        graph_mask_free(&mask);
    }
    /* Further down an upright line, below a curve that crosses it; in the legend where there is no room; nowhere beyond the axis.
     */
    const struct bead_ruler ruler = {true, 5, NAN, NAN, "word"}, beyond = {true, 11, NAN, NAN, "word"};
    struct graph_word word = {.markup = (char[]){"word"}};
    cell.words = &word;
    panel.rulers = &ruler;
    const struct bead_series curves[] = {{.x = far, .y = high, .count = 2, .mark = BEAD_MARK_LINE},
                                         {.x = far, .y = low, .count = 2, .mark = BEAD_MARK_LINE}};
    struct graph_mask mask = mask_of(curves, 2);
    assert_false(graph_words_place(&cell, &look, &mask));
    const double step = (HEIGHT - height - 2 * inset) / 23;
    assert_true(word.box.y > TOP + 10 + 0.3 * air && word.box.y < TOP + 10 + 0.3 * air + 3 + step + 4);
    assert_at(remainder(word.box.y - TOP - inset, step), 0);
    graph_mask_cover(&mask, (struct graph_box){LEFT, TOP, WIDTH - 8, HEIGHT - 8});
    assert_true(graph_words_place(&cell, &look, &mask));
    assert_int_equal(word.state, GRAPH_WORD_IN_LEGEND);
    assert_false(graph_words_place(&cell, &look, &mask)); /* it moves once */
    word.state = GRAPH_WORD_NONE;
    panel.rulers = &beyond;
    assert_false(graph_words_place(&cell, &look, &mask));
    assert_int_equal(word.state, GRAPH_WORD_NONE);
    graph_mask_free(&mask);
}

/* ---- legends ---- */

enum { ENTRIES = 5 };
static char names[ENTRIES][16] = {"one", "two curves", "three", "4", "a fifth"};

static struct graph_legend legend_of(struct graph_entry entries[ENTRIES], size_t count)
{
    for (size_t i = 0; i < count; i++)
        entries[i] = (struct graph_entry){.markup = names[i], .cell = &cell};
    return (struct graph_legend){.entries = entries, .count = count};
}

/* Columns as wide as their samples and words, 1.3 em apart; rows as high as letters need. */
static void legends_are_columns_of_entries(void **)
{
    struct graph_entry entries[ENTRIES];
    struct graph_legend legend = legend_of(entries, ENTRIES);
    for (size_t columns = 1; columns <= ENTRIES; columns++) {
        const size_t rows = (ENTRIES + columns - 1) / columns;
        double x = 0, widest = 0, high = 1.32 * em;
        graph_legend_measure(&legend, &look, 10000, columns);
        for (size_t i = 0; i < ENTRIES; i++)
            high = fmax(high, height_of(names[i]));
        high = ceil(high);
        for (size_t i = 0; i < ENTRIES; i++) {
            if (i > 0 && i % rows == 0) {
                x += ceil(widest) + 1.3 * em;
                widest = 0;
            }
            widest = fmax(widest, 3.1 * em + width_of(names[i], em));
            assert_at(entries[i].x, x);
            assert_at(entries[i].y, ((double)(i % rows) + 0.5) * high);
        }
        assert_at(legend.box.width, x + ceil(widest));
        assert_at(legend.box.height, (double)rows * high);
        assert_true(legend.wrap == 0 && legend.columns == (ENTRIES + rows - 1) / rows);
        /* As many as fit: exactly this width has these columns, a little less has not. */
        const double width = legend.box.width, found = (double)legend.columns;
        graph_legend_measure(&legend, &look, width, 0);
        assert_true(legend.box.width <= width && (double)legend.columns >= found);
        graph_legend_measure(&legend, &look, width - 1, 0);
        assert_true(legend.columns == 1 || legend.box.width < width);
    }
    /* Words longer than the width are broken, or cut, to the room beside the sample, three letters at least. */
    graph_legend_measure(&legend, &look, 3.1 * em + 70, 1);
    assert_at(legend.wrap, 70);
    assert_true(entries[1].width <= 70 && entries[1].height > 1.8 * height_of("one") &&
                legend.box.height >= ENTRIES * entries[1].height);
    legend.cut = true;
    graph_legend_measure(&legend, &look, 3.1 * em + 70, 1);
    assert_true(legend.wrap == -70 && entries[1].height < 1.5 * height_of("one"));
    graph_legend_measure(&legend, &look, 10, 1);
    assert_at(legend.wrap, -3 * em);
}

/* Entries of a row have one baseline, whether or not they have letters of mathematics, which make lines higher. */
static void entries_are_on_one_line(void **)
{
    char *markup[2] = {bead_markup_new("44"), bead_markup_new("*M* = 4")};
    const struct bead_series line = {.mark = BEAD_MARK_LINE, .count = 2};
    struct graph_entry entries[2] = {{.markup = markup[0], .cell = &cell, .series = &line},
                                     {.markup = markup[1], .cell = &cell, .series = &line}};
    struct graph_legend legend = {.entries = entries, .count = 2};
    struct texts texts = {.count = 0};
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1000, 800);
    cairo_t *cr = cairo_create(surface);
    look.label = 40;
    assert_true(bead_text_watch(surface, &(struct bead_text_watch){texts_note, &texts}));
    graph_legend_measure(&legend, &look, 1000, 2);
    assert_true(entries[1].height > entries[0].height + 1);
    graph_legend_draw(&legend, &look, cr);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    free(markup[0]);
    free(markup[1]);
    assert_true(texts.count == 2 && legend.columns == 2);
    assert_float_equal(texts.text[0].y + texts.text[0].height, texts.text[1].y + texts.text[1].height, 0.6);
}

/* Smaller type before words are cut: 0.87, 0.75; then one column, cut, in full size, where that is enough. */
static void legends_shrink_before_they_are_cut(void **)
{
    struct graph_entry entries[ENTRIES];
    struct graph_legend legend = legend_of(entries, ENTRIES);
    double heights[3];
    static const double sizes[] = {1, 0.87, 0.75};
    for (int i = 0; i < 3; i++) {
        legend.shrunk = sizes[i];
        graph_legend_measure(&legend, &look, 180, 0);
        heights[i] = legend.box.height;
        assert_at(entries[0].width, width_of(names[0], sizes[i] * em));
    }
    assert_true(heights[0] > heights[1] && heights[1] > heights[2]);
    for (int i = 0; i < 3; i++) {
        graph_legend_fit(&legend, &look, 180, heights[i]);
        assert_true(legend.shrunk == sizes[i] && !legend.cut && legend.box.height == heights[i]);
    }
    graph_legend_fit(&legend, &look, 180, heights[2] - 1);
    assert_true(legend.cut && legend.box.width <= 180);
    for (double height = 2 * em; height < 9 * em; height += em) {
        graph_legend_fit(&legend, &look, 400, height);
        assert_true(legend.box.width <= 400);
        assert_true(!legend.cut || legend.shrunk == 0.75 || legend.columns == 1);
    }
}

/* In an empty panel at the top right; where that hides something, at the top left, the bottom right, the bottom left; else at a
 * border. */
static void legends_prefer_corners(void **)
{
    struct graph_entry entries[ENTRIES];
    const double inset = 1.6 * air, size = 0.18 * em, right = LEFT + floor(WIDTH / size) * size,
                 bottom = TOP + floor(HEIGHT / size) * size;
    struct graph_mask mask = mask_of(NULL, 0);
    for (int corner = 0; corner < 5; corner++) {
        struct graph_legend legend = legend_of(entries, 2);
        struct graph_mask before = mask;
        const size_t cells = ((size_t)mask.width + 1) * ((size_t)mask.height + 1);
        before.sums = malloc(cells * sizeof *mask.sums);
        assert_non_null(before.sums);
        memcpy(before.sums, mask.sums, cells * sizeof *mask.sums);
        assert_true(graph_legend_place(&legend, &look, &mask));
        const struct graph_box b = legend.box;
        assert_int_equal(
            graph_mask_covered(&before, (struct graph_box){b.x - air, b.y - air, b.width + 2 * air, b.height + 2 * air}), 0);
        assert_true(covered(&mask, b.x + b.width / 2, b.y + b.height / 2, 1, 1) > 0);
        if (corner < 4) {
            assert_at(b.x, corner % 2 ? LEFT + inset : right - inset - b.width);
            assert_at(b.y, corner < 2 ? TOP + inset : bottom - inset - b.height);
            assert_int_equal(legend.columns, 1);
        } else {
            const bool at_border = fabs(b.x - LEFT - inset) < 1 || fabs(b.x + b.width + inset - right) < 1 ||
                                   fabs(b.y - TOP - inset) < 1 || fabs(b.y + b.height + inset - bottom) < 1;
            assert_true(at_border);
        }
        free(before.sums);
    }
    graph_mask_cover(&mask, (struct graph_box){LEFT, TOP, WIDTH - 5, HEIGHT - 5});
    struct graph_legend legend = legend_of(entries, 2);
    assert_true(!graph_legend_place(&legend, &look, &mask) && legend.box.width == 0);
    graph_mask_free(&mask);
    /* Two columns where one is too high. */
    cell.plot.height = 80;
    mask = mask_of(NULL, 0);
    legend = legend_of(entries, 4);
    assert_true(graph_legend_place(&legend, &look, &mask) && legend.columns == 2);
    graph_mask_free(&mask);
}

/* Samples of 2.6 em in the middle of their rows: lines, marks half way, bands between edges, rulers; the page behind them on
 * images. */
static void samples_look_like_their_curves(void **)
{
    static const double x[] = {1, 2}, y[] = {1, 2};
    const struct bead_series series[] = {{.x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE, .dash = 1},
                                         {.x = x, .y = y, .count = 2, .mark = BEAD_MARK_POINTS, .shape = 1, .colour = 1},
                                         {.x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE_POINTS, .shape = 1, .colour = 2},
                                         {.x = x, .y = y, .count = 2, .mark = BEAD_MARK_BAND, .colour = 3, .dash = 2}};
    static const struct bead_ruler ruler = {true, 3, NAN, NAN, NULL};
    struct graph_entry entries[ENTRIES];
    struct graph_legend legend = legend_of(entries, ENTRIES);
    panel.series = series;
    panel.series_count = 4;
    for (size_t i = 0; i < 4; i++)
        entries[i].series = &series[i];
    entries[4].ruler = &ruler;
    graph_legend_measure(&legend, &look, 1000, 2);
    legend.box.x = 200;
    legend.box.y = 30;
    struct canvas c = make_canvas(1000, 400);
    strokes_begin();
    graph_legend_draw(&legend, &look, c.cr);
    double from[ENTRIES], to[ENTRIES], level[ENTRIES];
    for (size_t i = 0; i < ENTRIES; i++) {
        from[i] = 200 + entries[i].x;
        to[i] = from[i] + 2.6 * em;
        level[i] = 30 + entries[i].y;
    }
    const struct stroke *s = strokes.list;
    assert_int_equal(strokes.count, 1 + 2 + 3 + 3 + 1);
    assert_bounds(&s[0], from[0], level[0], to[0], level[0]);
    assert_true(s[0].dashes == 2 && stroke_has(&s[0], false, bead_look_curve(&look, 0)));
    for (int mark = 1; mark <= 2; mark++) {
        const struct stroke *point = &s[mark == 1 ? 1 : 4];
        const double half = 1.2 * graph_full_point(&look) / sqrt(2);
        assert_bounds(point, (from[mark] + to[mark]) / 2 - half, level[mark] - half, (from[mark] + to[mark]) / 2 + half,
                      level[mark] + half);
        assert_true(point->filled && !point[1].filled && point[1].dashes == 0);
    }
    assert_bounds(&s[3], from[2], level[2], to[2], level[2]);
    assert_bounds(&s[6], from[3], level[3] - 0.35 * em, to[3], level[3] + 0.35 * em);
    assert_true(stroke_has(&s[6], true, graph_band_colour(&look, &series[3])));
    assert_bounds(&s[7], from[3], level[3] - 0.35 * em, to[3], level[3] - 0.35 * em);
    assert_bounds(&s[8], from[3], level[3] + 0.35 * em, to[3], level[3] + 0.35 * em);
    assert_true(s[7].dashes == 4 && s[8].dashes == 4);
    assert_bounds(&s[9], from[4], level[4], to[4], level[4]);
    assert_true(stroke_has(&s[9], false, look.faint) && s[9].dash[0] == 5 * look.line);
    strokes_begin();
    graph_legend_back(&legend, &look, c.cr);
    assert_bounds(&strokes.list[0], 200 - 5, 30 - 5, 200 + legend.box.width + 5, 30 + legend.box.height + 5);
    legend.box.width = 0; /* not placed */
    strokes_begin();
    graph_legend_back(&legend, &look, c.cr);
    graph_legend_draw(&legend, &look, c.cr);
    assert_int_equal(strokes.count, 0);
    free_canvas(&c);
}

/* ---- names at the ends of lines ---- */

/* 0.45 em beyond the frame, as high as the end of their line but within the frame; not where two are closer than 0.85 of a line, or
 * one ends 2.5 em before the frame. */
static void names_stand_where_lines_end(void **)
{
    char *labels[] = {(char[]){"nnn"}, (char[]){"ooooo"}};
    const double x[] = {0, 10}, line = height_of("nnn");
    for (int i = 0; i < 4; i++) {
        const double apart = (i == 1   ? 0.84
                              : i == 3 ? 2.5
                                       : 0.86) *
                             line / HEIGHT * 10,
                     first[] = {3, i == 2   ? 9.9
                                   : i == 3 ? 0.1
                                            : 5},
                     second[] = {3, first[1] + (i == 2 ? -2 : apart)},
                     shorter[] = {0, 10 - (2.5 * em + (i == 3 ? 0.1 : -0.1)) / 40};
        const struct bead_series series[] = {{.x = x, .y = first, .count = 2, .mark = BEAD_MARK_LINE},
                                             {.x = shorter, .y = second, .count = 2, .mark = BEAD_MARK_LINE, .colour = 1}};
        panel.series = series;
        panel.series_count = 2;
        cell.labels = labels;
        cell.ends = true;
        assert_true(graph_ends_fit(&cell, &look) == (i == 0 || i == 2));
        const double widest = fmax(width_of("nnn", em), width_of("ooooo", em));
        assert_true(graph_ends_reach(&cell, &look) == ceil(widest + 0.45 * em));
        struct texts texts = {.count = 0};
        const struct bead_text_watch watch = {texts_note, &texts};
        struct canvas c = make_canvas(800, 400);
        assert_true(bead_text_watch(c.surface, &watch));
        graph_ends_draw(&cell, &look, c.cr);
        assert_int_equal(texts.count, 2);
        for (size_t s = 0; s < 2; s++) {
            const double end = BOTTOM - 20 * series[s].y[1], wanted = fmin(fmax(end, TOP + line / 2), BOTTOM - line / 2);
            assert_true(fabs(texts.text[s].x - (RIGHT + 0.45 * em)) < 3); /* ink begins a little further right */
            assert_true(fabs(texts.text[s].y + texts.text[s].height / 2 - wanted) < 0.2 * em);
        }
        cell.ends = false;
        assert_true(graph_ends_reach(&cell, &look) == 0);
        texts.count = 0;
        graph_ends_draw(&cell, &look, c.cr);
        assert_int_equal(texts.count, 0);
        free_canvas(&c);
    }
}

/* Names at ends require lines with different names, and at most a fifth of the panel's share of the page. */
static void names_are_wanted_at_ends_of_lines(void **)
{
    static const double x[] = {0, 10}, y[] = {1, 2};
    static char first[] = "first", second[] = "second", third[] = "third";
    char *labels[2][2] = {{first, second}, {third, NULL}};
    for (int variant = 0; variant < 10; variant++) {
        struct bead_series series[2][2];
        struct bead_panel panels[2];
        struct graph_cell cells[2];
        static const struct bead_graph_image image = {.columns = 2, .rows = 2};
        for (int p = 0; p < 2; p++) {
            for (int s = 0; s < 2; s++)
                series[p][s] = (struct bead_series){
                    .x = x, .y = y, .count = 2, .mark = s ? BEAD_MARK_LINE_POINTS : BEAD_MARK_LINE, .colour = (size_t)s};
            panels[p] = (struct bead_panel){.series = series[p], .series_count = 2};
            cells[p] = (struct graph_cell){.panel = &panels[p], .labels = labels[p], .plot = {LEFT, TOP, WIDTH, HEIGHT}};
        }
        const struct bead_graph graph = {.panels = panels, .panel_count = 2};
        const double reach = ceil(fmax(width_of("first", em), width_of("second", em)) + 0.45 * em);
        struct graph_layout l = {.graph = &graph, .look = &look, .cells = cells, .columns = 2, .width = reach / 0.2 * 2};
        bool wanted = true;
        labels[1][0] = third;
        switch (variant) {
        case 1:
            l.width -= 1;
            wanted = false;
            break;
        case 2:
            series[0][0].mark = BEAD_MARK_POINTS;
            wanted = false;
            break;
        case 3:
            series[0][1].faint = true;
            wanted = false;
            break;
        case 4:
            l.part = true;
            wanted = false;
            break;
        case 5:
            panels[0].image = &image;
            wanted = false;
            break;
        case 6:
            labels[1][0] = first;
            wanted = false;
            break; /* one entry explains both */
        case 7:
            labels[1][0] = first;
            series[1][0].colour = 4;
            break;
        case 8:
            labels[0][0] = labels[0][1] = NULL;
            wanted = false;
            break;
        case 9:
            series[0][0].mark = BEAD_MARK_BAND;
            wanted = false;
            break;
        default:
            break;
        }
        if (graph_ends_wanted(&l, 0) != wanted)
            fail_msg("variant %d: %g", variant, reach);
        labels[0][0] = first;
        labels[0][1] = second;
    }
}

/* ---- pages ---- */

/* A title above the plots' left end, or at the margin if it is too long for that; a caption at the bottom. */
static void titles_begin_above_the_axes(void **)
{
    static char caption[] = "A caption of some words.", shorter[] = "Title", wide[] = "A title as long as the whole page is wide";
    char *const titles[] = {shorter, wide};
    for (int longer = 0; longer < 2; longer++) {
        struct graph_page page = {.title = titles[longer], .caption = caption};
        struct bead_text_style style = graph_text(&look);
        double across, down, caption_height;
        style.size = 1.2 * look.title;
        style.bold = true;
        bead_text_size_lines(NULL, &style, 10000, page.title, &across, &down);
        const double width = longer ? across + 2 * look.margin + 5 : 600;
        style = graph_text(&look);
        bead_text_size_lines(NULL, &style, width - 2 * look.margin, caption, &across, &caption_height);
        graph_page_measure(&page, &look, width, 500);
        assert_true(page.above == ceil(down + 0.7 * em) && page.below == ceil(caption_height + 0.5 * em));
        assert_at(page.caption_height, caption_height);
        struct texts texts = {.count = 0};
        const struct bead_text_watch watch = {texts_note, &texts};
        struct canvas c = make_canvas(1000, 500);
        assert_true(bead_text_watch(c.surface, &watch));
        graph_page_draw(&page, &look, c.cr, 77);
        assert_int_equal(texts.count, 2);
        assert_true(fabs(texts.text[0].x - look.margin) < 3 && fabs(texts.text[1].x - (longer ? look.margin : 77)) < 3);
        assert_true(texts.text[0].y + texts.text[0].height < 500 - look.margin &&
                    texts.text[0].y > 500 - look.margin - caption_height);
        assert_true(texts.text[1].y > look.margin && texts.text[1].y + texts.text[1].height < look.margin + down);
        page.title = NULL;
        texts.count = 0;
        graph_page_draw(&page, &look, c.cr, 77);
        assert_int_equal(texts.count, 1);
        free_canvas(&c);
    }
}

/* Lines of any length have the room that is measured for them, between margins. */
static void pages_have_room_for_their_lines(void **)
{
    enum { MOST = 60, WIDE = 400, HIGH = 900 };
    for (int words = 1; words <= MOST; words++) {
        char text[5 * MOST + 1] = "";
        struct graph_page page = {.title = text, .caption = text};
        struct texts texts = {.count = 0};
        const struct bead_text_watch watch = {texts_note, &texts};
        struct canvas c = make_canvas(WIDE, HIGH);
        double ends[2][2] = {{HIGH, 0}, {HIGH, 0}}; /* of the title, of the caption */
        for (int i = 0; i < words; i++)
            strcat(text, i % 3 ? "is " : "wide ");
        assert_true(bead_text_watch(c.surface, &watch));
        graph_page_measure(&page, &look, WIDE, HIGH);
        graph_page_draw(&page, &look, c.cr, 77);
        for (size_t i = 0; i < texts.count; i++) {
            const struct text *line = &texts.text[i];
            double *end = ends[line->y > HIGH / 2.0];
            end[0] = fmin(end[0], line->y), end[1] = fmax(end[1], line->y + line->height);
            assert_true(line->x > look.margin - 1 && line->x + line->width < WIDE - look.margin + 1);
        }
        assert_true(ends[0][0] >= look.margin - 1 &&
                    fabs(ends[0][1] - look.margin + 0.7 * em - page.above) < 0.4 * 1.2 * look.title);
        assert_true(fabs(ends[1][1] - HIGH + look.margin) < 0.4 * em &&
                    fabs(ends[1][0] - HIGH + look.margin + page.below - 0.5 * em) < 0.4 * em);
        free_canvas(&c);
    }
}

static void panels_are_counted_in_letters(void **)
{
    char letter[32];
    static const struct {
        size_t index;
        const char *is;
    } letters[] = {{0, "(a)"}, {25, "(z)"}, {26, "(aa)"}, {27, "(ab)"}, {51, "(az)"}, {52, "(ba)"}, {701, "(zz)"}};
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
        graph_letter(letters[i].index, letter, sizeof letter);
        assert_string_equal(letter, letters[i].is);
    }
}

/* On a page twice as large everything is twice as far: no length is in pixels. */
static void layouts_scale_with_the_page(void **)
{
    static struct data d;
    static const struct bead_ruler rulers[] = {{false, 22, 20, 24, "plateau"}, {true, 0.5, NAN, NAN, "thesis"}};
    make_data(&d);
    for (int i = 0; i < N; i++)
        d.y[CURVES - 1][i] = i % 2 ? 20 : 40; /* all over the panels that have it */
    bool seen[2] = {false, false};
    for (int variant = 0; variant < 8; variant++) {
        struct bead_panel panels[5];
        const size_t count = (size_t[]){1, 2, 3, 5, 1, 4, 2, 4}[variant];
        const double width = variant == 4 || variant == 6 ? 620 : 1100, height = variant == 4 ? 700 : 560;
        struct graph_layout at[2];
        for (size_t p = 0; p < count; p++) {
            panels[p] = make_panel(&d, variant == 4 || variant == 0 || variant == 3 ? CURVES : 2);
            panels[p].y.zero = variant > 0;
            panels[p].title = variant % 2 ? "a title" : NULL;
            panels[p].rulers = rulers;
            panels[p].ruler_count = 2;
        }
        struct bead_look looks[2];
        const struct bead_graph graph = {.title = variant > 4 ? "All" : NULL,
                                         .caption = variant > 4 ? "A caption." : NULL,
                                         .panels = panels,
                                         .panel_count = count,
                                         .letters = variant % 2,
                                         .share_x = variant > 2,
                                         .share_y = variant > 2,
                                         .residuals = variant == 7};
        for (int k = 0; k < 2; k++) {
            bead_look_paper(&looks[k], 150 * (k + 1));
            at[k] = lay_out(&graph, &looks[k], (k + 1) * width, (k + 1) * height);
        }
        assert_true(at[0].columns == at[1].columns && at[0].rows == at[1].rows && at[0].legend_right == at[1].legend_right);
        assert_int_equal(at[0].legend.count, at[1].legend.count);
        const double near = 5;
        for (size_t p = 0; p < count; p++) {
            const struct graph_cell *a = &at[0].cells[p], *b = &at[1].cells[p],
                                    *above = p >= at[0].columns ? &at[0].cells[p - at[0].columns] : NULL;
            const struct bead_rect q = a->plot;
            assert_true(fabs(2.0 * q.x - b->plot.x) <= near && fabs(2.0 * q.y - b->plot.y) <= near);
            assert_true(fabs(2.0 * q.width - b->plot.width) <= near && fabs(2.0 * q.height - b->plot.height) <= near);
            /* Plots of a row and of a column are in line, and of the same size, except for residuals of half the height. */
            const struct graph_cell *left = p % at[0].columns ? a - 1 : NULL;
            assert_true(!left || (left->plot.y == q.y && left->plot.height == q.height && left->plot.width == q.width));
            assert_true(!above || (above->plot.x == q.x && above->plot.width == q.width));
            assert_true(!above || above->plot.height == q.height ||
                        (graph.residuals && abs(above->plot.height - 2 * q.height) <= 2));
            assert_true(!left || q.x - left->plot.x - left->plot.width >= (int)looks[0].label);
            assert_true(!above || q.y - above->plot.y - above->plot.height >= (int)(0.8 * looks[0].label));
            const double scale = a->legend.box.width > 0 && b->legend.box.width > 0 ? b->legend.box.width / a->legend.box.width : 2;
            assert_true(fabs(scale - 2) < 0.06);
        }
        /* Outer parts are at the margin, in line with the first plot. */
        for (int k = 0; k < 2; k++) {
            const struct graph_box b = at[k].legend.box;
            const double margin = looks[k].margin;
            if (at[k].legend.count == 0)
                continue;
            seen[at[k].legend_right] = true;
            if (at[k].legend_right) {
                assert_at(b.x + b.width, (k + 1) * width - margin);
                assert_at(b.y, at[k].cells[0].plot.y);
                assert_true(b.x - at[k].cells[at[k].columns - 1].plot.x - at[k].cells[at[k].columns - 1].plot.width >=
                            0.7 * looks[k].label);
            } else {
                assert_at(b.y + b.height, (k + 1) * height - margin - at[k].page.below);
                assert_at(b.x, fmin(at[k].cells[0].plot.x, (k + 1) * width - margin - b.width));
                assert_true(b.y - at[k].cells[count - 1].plot.y - at[k].cells[count - 1].plot.height >= 0.7 * looks[k].label);
            }
        }
        for (int k = 0; k < 2; k++)
            graph_layout_free(&at[k]);
    }
    assert_true(seen[0] && seen[1]);
}

/* Parts of a figure keep the insets that they are given, so that plots of several parts are in line. */
static void parts_keep_their_insets(void **)
{
    static struct data d;
    make_data(&d);
    struct bead_message msg = {""};
    for (size_t count = 1; count <= 4; count += 3) {
        struct bead_panel panels[4];
        for (size_t p = 0; p < count; p++)
            panels[p] = make_panel(&d, 1);
        const struct bead_graph graph = {.panels = panels, .panel_count = count};
        const struct graph_frame frame = {.margin = 13, .least = {160, 90, 70, 110}, .letter = ""};
        struct graph_layout layout;
        assert_int_equal(graph_layout_make(&graph, &look, 1400, 1000, &frame, &layout, &msg), BEAD_OK);
        const struct bead_rect first = layout.cells[0].plot, last = layout.cells[count - 1].plot;
        assert_true(first.x == 13 + 160 && first.y == 13 + 90);
        assert_true(abs(last.x + last.width - (1400 - 13 - 70)) <= 1 && abs(last.y + last.height - (1000 - 13 - 110)) <= 1);
        graph_layout_free(&layout);
    }
    /* Labels below each panel, or below the last of a column alone: what this saves, plots have. */
    double heights[2], widths[2];
    for (int shared = 0; shared < 2; shared++) {
        struct bead_panel panels[4];
        for (size_t p = 0; p < 4; p++)
            panels[p] = make_panel(&d, 1);
        const struct bead_graph graph = {.panels = panels, .panel_count = 4, .share_x = shared, .share_y = shared};
        struct graph_layout layout = lay_out(&graph, &look, 1400, 1000);
        const struct graph_cell *c = &layout.cells[0];
        double below[2], left[2];
        for (int labels = 0; labels < 2; labels++) {
            below[labels] = bead_axis_draw(NULL, &look, &c->axis[0], c->plot, BEAD_SIDE_BOTTOM, false, labels, c->panel->x.title);
            left[labels] = bead_axis_draw(NULL, &look, &c->axis[1], c->plot, BEAD_SIDE_LEFT, false, labels, c->panel->y.title);
        }
        assert_at(c->plot.x, look.margin + ceil(left[1]));
        assert_true(c[2].plot.y - c->plot.y - c->plot.height >= ceil(below[!shared]) + 0.8 * em - 1);
        assert_true(c[1].plot.x - c->plot.x - c->plot.width >= ceil(left[!shared]) + em - 1);
        assert_true(fabs(c[2].plot.y + c[2].plot.height + ceil(below[1]) + look.margin - 1000) <= 2);
        heights[shared] = c->plot.height;
        widths[shared] = c->plot.width;
        graph_layout_free(&layout);
    }
    assert_true(heights[1] > heights[0] + em && widths[1] > widths[0] + em);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(ranges_leave_room_around_the_data, set_up),
        cmocka_unit_test_setup(half_points_take_no_room, set_up),
        cmocka_unit_test_setup(masks_count_covered_cells, set_up),
        cmocka_unit_test_setup(words_stand_beside_their_lines, set_up),
        cmocka_unit_test_setup(legends_are_columns_of_entries, set_up),
        cmocka_unit_test_setup(entries_are_on_one_line, set_up),
        cmocka_unit_test_setup(legends_shrink_before_they_are_cut, set_up),
        cmocka_unit_test_setup(legends_prefer_corners, set_up),
        cmocka_unit_test_setup(samples_look_like_their_curves, set_up),
        cmocka_unit_test_setup(names_stand_where_lines_end, set_up),
        cmocka_unit_test_setup(names_are_wanted_at_ends_of_lines, set_up),
        cmocka_unit_test_setup(titles_begin_above_the_axes, set_up),
        cmocka_unit_test_setup(pages_have_room_for_their_lines, set_up),
        cmocka_unit_test_setup(panels_are_counted_in_letters, set_up),
        cmocka_unit_test_setup(layouts_scale_with_the_page, set_up),
        cmocka_unit_test_setup(parts_keep_their_insets, set_up),
    };
    return cmocka_run_group_tests_name("layout of graphs", tests, NULL, NULL);
}
