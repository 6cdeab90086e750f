/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strokes of a graph in a frame, as numbers: a plot of 400 x 200 pixels at 100, 50, with axes from 0 to 10. */
#include "graphs.h"
#include "render/draw/looks.h"
#include "strokes.h"

enum { LEFT = 100, TOP = 50, WIDTH = 400, HEIGHT = 200, RIGHT = LEFT + WIDTH, BOTTOM = TOP + HEIGHT };

static struct bead_look look;
static struct bead_panel panel;
static struct graph_cell cell;

static double at_x(double x)
{
    return LEFT + WIDTH * x / 10;
}

static double at_y(double y)
{
    return BOTTOM - HEIGHT * y / 10;
}

static int set_up(void **)
{
    bead_look_screen(&look, 1000, 800, false);
    look.label = 20;
    look.tick = 18;
    look.line = 2;
    panel = (struct bead_panel){.series_count = 0};
    cell = (struct graph_cell){.panel = &panel, .plot = {LEFT, TOP, WIDTH, HEIGHT}, .high = {10, 10}};
    bead_axis_make(&cell.axis[0], 0, 10, "", BEAD_SCALE_LINEAR, WIDTH, look.tick, true);
    bead_axis_make(&cell.axis[1], 0, 10, "", BEAD_SCALE_LINEAR, HEIGHT, look.tick, false);
    return 0;
}

/* What these series draw, all of the panel's. */
static void draw_panel(const struct bead_series *series, size_t count)
{
    panel.series = series;
    panel.series_count = count;
    struct canvas c = make_canvas(800, 400);
    strokes_begin();
    graph_draw_contents(c.cr, &look, &cell);
    free_canvas(&c);
}

static void assert_line(const struct stroke *s, size_t from, double x0, double y0, double x1, double y1)
{
    assert_true(from + 2 <= s->count);
    assert_true(s->at[from].begins && !s->at[from + 1].begins);
    assert_at(s->at[from].x, x0);
    assert_at(s->at[from].y, y0);
    assert_at(s->at[from + 1].x, x1);
    assert_at(s->at[from + 1].y, y1);
}

/* ---- error bars ---- */

/* From y - error to y + error, with caps of equal halves at the ends that are within the frame; beyond it there is nothing. */
static void bars_reach_their_errors_within_the_frame(void **)
{
    static const double x[] = {1, 2, 3, 4, 5, 6, 7, 8, 11, -1, 9, 9.5, 0.5}, y[] = {5, 1, 9, 15, -5, 5, 5, 5, 5, 5, 8, 12, NAN},
                        error[] = {2, 2, 3, 2, 2, 20, 0, NAN, 1, 1, 2, 2, 1};
    static const struct {
        double x, low, high;
        bool caps[2];
    } bars[] = {{1, 3, 7, {true, true}},
                {2, 0, 3, {false, true}},
                {3, 6, 10, {true, false}},
                {6, 0, 10, {false, false}},
                {9, 6, 10, {true, true}}};
    const struct bead_series series = {.x = x, .y = y, .error = error, .count = 13, .mark = BEAD_MARK_POINTS};
    draw_panel(&series, 1);
    const struct stroke *s = &strokes.list[0];
    assert_true(stroke_has(s, false, bead_look_curve(&look, 0)) && s->width == look.line && s->dashes == 0);
    size_t at = 0;
    const double cap = (s->at[3].x - s->at[2].x) / 2;
    assert_true(cap > 0.3 * graph_full_point(&look) && cap < graph_full_point(&look));
    for (size_t i = 0; i < sizeof bars / sizeof bars[0]; i++) {
        assert_line(s, at, at_x(bars[i].x), at_y(bars[i].low), at_x(bars[i].x), at_y(bars[i].high));
        at += 2;
        for (int end = 0; end < 2; end++) {
            const double level = at_y(end ? bars[i].high : bars[i].low);
            if (!bars[i].caps[end])
                continue;
            assert_line(s, at, at_x(bars[i].x) - cap, level, at_x(bars[i].x) + cap, level);
            at += 2;
        }
    }
    assert_int_equal(s->count, at);
}

/* ---- points ---- */

/* The corners of each shape around its place: how many, how far, and the direction of the first one. */
static void shapes_are_what_they_are_called(void **)
{
    static const struct {
        size_t corners;
        double far, dent, first; /* far in sizes, first in parts of a turn, clockwise from the right */
        bool hollow;
    } shapes[] = {{0, 1, 0, 0, false},      {4, 1.2, 0, 0.125, false},   {3, 1.3, 0, 0.75, false}, {4, 1.3, 0, 0, false},
                  {3, 1.3, 0, 0.25, false}, {10, 1.5, 0.4, 0.75, false}, {0, 1, 0, 0, true}};
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        const struct bead_series series = {.shape = i, .colour = 1, .hollow = i == 3};
        struct canvas c = make_canvas(400, 400);
        for (int small = 0; small < 2; small++) {
            const double size = small ? 2 : 10;
            strokes_begin();
            graph_draw_point(c.cr, &look, &series, 200, 100, size);
            const struct stroke *inside = &strokes.list[0], *outline = &strokes.list[1];
            assert_int_equal(strokes.count, 2);
            assert_true(stroke_has(inside, true, shapes[i].hollow || i == 3 ? look.background : bead_look_curve(&look, 1)));
            assert_true(stroke_has(outline, false, bead_look_curve(&look, 1)) && outline->dashes == 0);
            assert_int_equal(outline->join, CAIRO_LINE_JOIN_MITER);
            assert_at(outline->width, small ? 1 : look.line);
            if (shapes[i].corners == 0)
                assert_true(fabs(outline->high[0] - 200 - size) < 0.02 && fabs(200 - size - outline->low[0]) < 0.02);
            else
                assert_int_equal(outline->count, shapes[i].corners);
            if (shapes[i].corners == 0)
                assert_true(outline->at[0].y == 100 && outline->at[outline->count - 1].y == 100); /* all round */
            for (size_t k = 0; k < shapes[i].corners; k++) {
                const double far = size * shapes[i].far * (shapes[i].dent > 0 && k % 2 ? shapes[i].dent : 1),
                             turn = 2 * M_PI * (shapes[i].first + (double)k / (double)shapes[i].corners);
                assert_at(outline->at[k].x, 200 + far * cos(turn));
                assert_at(outline->at[k].y, 100 + far * sin(turn));
            }
        }
        free_canvas(&c);
    }
    const struct bead_series series = {.shape = 7};
    struct canvas c = make_canvas(400, 400);
    strokes_begin();
    graph_draw_point(c.cr, &look, &series, 200, 100, 10);
    const struct stroke *cross = &strokes.list[0];
    assert_true(strokes.count == 1 && !cross->filled && cross->width == 1.5 * look.line && cross->count == 8);
    for (size_t k = 0; k < 4; k++)
        assert_line(cross, 2 * k, 200, 100, 200 + 12 * cos(M_PI * (0.25 + 0.5 * (double)k)),
                    100 + 12 * sin(M_PI * (0.25 + 0.5 * (double)k)));
    free_canvas(&c);
}

/* Points beyond the frame: arrows of a point's width that touch it from inside, filled as points are. */
static void arrows_point_at_what_is_beyond(void **)
{
    static const double x[] = {0, 3, 6, 10, 11, -1}, y[] = {5, 15, -3, 5, 15, 15};
    for (int hollow = 0; hollow < 2; hollow++) {
        const struct bead_series series = {
            .x = x, .y = y, .count = 6, .mark = BEAD_MARK_POINTS, .arrows = true, .hollow = hollow, .shape = 1};
        draw_panel(&series, 1);
        const double size = graph_point_size(&series, &cell, &look);
        size_t arrows[2] = {0, 0}, points = 0;
        for (size_t i = 0; i < strokes.count; i++) {
            const struct stroke *s = &strokes.list[i];
            points += !s->filled && s->count == 4;
            if (s->count != 3)
                continue;
            const bool up = s->at[2].y == TOP;
            const double base = up ? s->high[1] : s->low[1];
            arrows[up] += s->filled ? 10 : 1;
            assert_at(s->at[2].x, at_x(up ? 3 : 6));
            assert_at(s->at[2].y, up ? TOP : BOTTOM);
            assert_at(s->at[0].x, s->at[2].x - size);
            assert_at(s->at[1].x, s->at[2].x + size);
            assert_at(s->at[0].y, base);
            assert_at(s->at[1].y, base);
            assert_at(fabs(base - s->at[2].y), 1.6 * size);
            assert_true(s->low[1] >= TOP && s->high[1] <= BOTTOM);
            assert_true(stroke_has(s, s->filled, bead_look_curve(&look, 0)) && s->width == look.line);
        }
        assert_true(arrows[0] == (hollow ? 1 : 11) && arrows[1] == arrows[0] && points == 2); /* on the frame's sides */
        struct bead_series none = series;
        none.arrows = false;
        draw_panel(&none, 1);
        assert_int_equal(strokes.count, 4);
    }
}

/* Points of equal x: the k-th at the fractional part of k golden ratios of a width, which is part of the way to the next x, or from
 * the one before, no more than 1.6 letters, and within the frame. */
static void points_of_equal_x_are_beside_each_other(void **)
{
    static const double x[] = {0.1, 0.1, 2, 2, 2, 2, 3, 5, 5, 5.5, 5.5, 5.5, 7, 7, 8, 8, 10, 10};
    static const struct {
        size_t count;
        double width; /* px */
    } groups[] = {{2, 8}, {4, 0.55 * 40}, {1, 0}, {2, 0.55 * 20}, {3, 32}, {2, 0.55 * 40}, {2, 32}, {2, 0}};
    double y[18];
    struct bead_series series = {.x = x, .y = y, .count = 18, .mark = BEAD_MARK_POINTS, .shape = 1, .jitter = true};
    for (size_t i = 0; i < 18; i++)
        y[i] = 5;
    for (int jitter = 1; jitter >= 0; jitter--) {
        series.jitter = jitter;
        draw_panel(&series, 1);
        assert_int_equal(strokes.count, 36);
        for (size_t g = 0, i = 0; g < sizeof groups / sizeof groups[0]; g++) {
            for (size_t k = 1; k <= groups[g].count; k++, i++) {
                const struct stroke *s = &strokes.list[2 * i];
                const double turns = (double)k * (sqrt(5) - 1) / 2, off = groups[g].width * (turns - floor(turns) - 0.5);
                assert_at((s->low[0] + s->high[0]) / 2, at_x(x[i]) + (jitter && groups[g].count > 1 ? off : 0));
                assert_at((s->low[1] + s->high[1]) / 2, at_y(5));
            }
        }
    }
    static const double last[] = {2, 9, 9};
    series = (struct bead_series){.x = last, .y = y, .count = 3, .mark = BEAD_MARK_POINTS, .shape = 1, .jitter = true};
    draw_panel(&series, 1);
    const double first_off = 32 * ((sqrt(5) - 1) / 2 - 0.5);
    assert_at((strokes.list[2].low[0] + strokes.list[2].high[0]) / 2, at_x(9) + first_off);
    draw_panel(&(struct bead_series){.x = last + 1, .y = y, .count = 2, .mark = BEAD_MARK_POINTS, .shape = 1, .jitter = true}, 1);
    assert_at((strokes.list[0].low[0] + strokes.list[0].high[0]) / 2, at_x(9)); /* no other x gives the width */
}

/* Marks of dense curves: 16 radii apart, those of several curves evenly between each other's; sparse ones have all. */
static void marks_of_dense_curves_alternate(void **)
{
    static double x[401], y[401];
    struct bead_series series[3];
    const double radius = graph_full_point(&look);
    assert_at(radius, 0.24 * look.label);
    for (size_t i = 0; i < 401; i++) {
        x[i] = (double)i / 40;
        y[i] = 5;
    }
    for (size_t curves = 1; curves <= 3; curves++) {
        for (size_t s = 0; s < curves; s++)
            series[s] = (struct bead_series){.x = x, .y = y, .count = 401, .mark = BEAD_MARK_LINE_POINTS, .shape = 1, .colour = s};
        draw_panel(series, curves);
        for (size_t s = 0; s < curves; s++) {
            const struct graph_thinning thin = graph_thin(&cell, &look, &series[s]);
            assert_int_equal(thin.every, (size_t)ceil(16 * radius));
            assert_true(fabs((double)thin.first - ((double)s + 0.5) * (double)thin.every / (double)curves) <= 1);
            assert_false(graph_is_guide(&cell, &look, &series[s]));
            assert_true(graph_point_size(&series[s], &cell, &look) == radius);
            size_t marks = 0;
            for (size_t i = 0; i < strokes.count; i++) {
                const struct stroke *mark = &strokes.list[i];
                if (!stroke_has(mark, true, bead_look_curve(&look, s)))
                    continue;
                assert_at((mark->low[0] + mark->high[0]) / 2, at_x(x[thin.first + marks * thin.every]));
                marks++;
            }
            assert_int_equal(marks, (400 - thin.first) / thin.every + 1);
        }
        /* All marks side by side: 2.6 radii apart, of a single curve down to 0.6 of that, where they shrink. */
        const double least = 2.6 * radius * (curves > 1 ? 1 : 0.6);
        for (int more = 0; more < 2; more++) {
            const size_t count = (size_t)floor(WIDTH / least) + 1 + (size_t)more;
            for (size_t s = 0; s < curves; s++)
                series[s].count = count;
            const double alone = WIDTH / ((double)count - 1) / 2.6, size = graph_point_size(&series[0], &cell, &look);
            assert_true((graph_thin(&cell, &look, &series[0]).every == 1) == !more);
            assert_true(graph_is_guide(&cell, &look, &series[0]) == !more);
            assert_at(size, more ? radius : fmin(radius, fmax(0.6 * radius, alone)));
        }
        series[0].mark = BEAD_MARK_LINE; /* lines have no marks */
        assert_int_equal(graph_thin(&cell, &look, &series[0]).every, 1);
        assert_false(graph_is_guide(&cell, &look, &series[0]));
    }
}

/* Points: full size if there is room, side by side if it is narrow, never invisible; clouds by the root of their number. */
static void points_have_the_size_that_fits(void **)
{
    static double x[4000], y[4000];
    struct bead_series series = {.x = x, .y = y, .count = 20, .mark = BEAD_MARK_POINTS};
    const double full = graph_full_point(&look);
    for (size_t i = 0; i < 4000; i++)
        x[i] = (double)i;
    assert_int_equal(graph_cloud(&series), 0);
    assert_at(graph_point_size(&series, &cell, &look), full);
    series.count = 41; /* 10 px apart */
    assert_at(graph_point_size(&series, &cell, &look), 10 / 2.6);
    series.count = 4000;
    assert_at(graph_point_size(&series, &cell, &look), 0.5 * fmax(0.7 * look.line, 0.4 * full));
    look.line = 4;
    assert_at(graph_point_size(&series, &cell, &look), 0.5 * 0.7 * 4);
    look.line = 2;
    series.count = 1;
    assert_at(graph_point_size(&series, &cell, &look), full);
    x[3] = x[2];
    series.count = 600;
    assert_int_equal(graph_cloud(&series), 600);
    cell.most_points = 599;
    assert_at(graph_point_size(&series, &cell, &look), full * 0.5);
    cell.most_points = 149;
    assert_at(graph_point_size(&series, &cell, &look), full);
    cell.most_points = 100000;
    assert_at(graph_point_size(&series, &cell, &look), 0.4 * full);
    series.mark = BEAD_MARK_LINE_POINTS;
    assert_int_equal(graph_cloud(&series), 0);
}

/* ---- lines ---- */

/* Faint lines are thin and pale, guides a little pale, curves in full ink, all in their dashes; on images, with an edge. */
static void lines_have_their_style(void **)
{
    static const double x[] = {1, 9}, y[] = {2, 3};
    static const struct bead_graph_image image = {.columns = 2, .rows = 2};
    const struct bead_rgb ink = bead_look_curve(&look, 2), page = look.background;
    for (size_t dash = 0; dash <= BEAD_DASHES; dash++) {
        for (int kind = 0; kind < 4; kind++) { /* a curve, a faint one, a guide, a faint guide */
            const struct bead_series series = {.x = x,
                                               .y = y,
                                               .count = 2,
                                               .colour = 2,
                                               .dash = dash,
                                               .faint = kind & 1,
                                               .mark = kind & 2 ? BEAD_MARK_LINE_POINTS : BEAD_MARK_LINE};
            const double part = (double[]){1, 0.35, 0.55, 0.35}[kind], width = kind == 0 ? 3 : look.line; /* 1.5 lines */
            const struct bead_rgb shown = {page.r + part * (ink.r - page.r), page.g + part * (ink.g - page.g),
                                           page.b + part * (ink.b - page.b)};
            const struct bead_dashes *pattern = bead_look_dashes(dash);
            cell.undashed = false;
            draw_panel(&series, 1);
            const struct stroke *s = &strokes.list[0];
            assert_true(stroke_has(s, false, shown) && s->dashes == pattern->count);
            assert_at(s->width, width);
            for (int i = 0; i < pattern->count; i++)
                assert_at(s->dash[i], width * pattern->lengths[i]);
            assert_int_equal(s->count, 2);
            assert_line(s, 0, at_x(1), at_y(2), at_x(9), at_y(3));
            assert_int_equal(strokes.count, kind & 2 ? 5 : 1);
            cell.undashed = true;
            draw_panel(&series, 1);
            assert_int_equal(strokes.list[0].dashes, 0);
            cell.undashed = false;
            panel.image = &image;
            draw_panel(&series, 1);
            const struct stroke *edge = &strokes.list[0], *over = &strokes.list[1];
            const double full = kind & 1 ? look.line : 3;
            assert_true(stroke_has(edge, false, page) && edge->width == full + 2 * look.line);
            assert_true(stroke_has(over, false, kind & 1 ? shown : ink) && over->width == full);
            panel.image = NULL;
        }
    }
    look.label = 50; /* curves are as wide as large letters ask for */
    draw_panel(&(struct bead_series){.x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE}, 1);
    assert_at(strokes.list[0].width, 0.09 * 50);
}

/* Lines end eight widths beyond the frame, on their way, and come back on it. */
static void lines_are_cut_on_their_way(void **)
{
    static const double x[] = {5, 5, 25, 25, 8, 8, -40, -40, 2, 3}, y[] = {5, 40, 40, -30, 4, 8, 8, 1e9, 5, NAN};
    static const double out = 8 * 2;
    const struct bead_series series = {.x = x, .y = y, .count = 10, .mark = BEAD_MARK_LINE};
    draw_panel(&series, 1);
    const struct stroke *s = &strokes.list[0];
    const double slope = (at_y(4) - at_y(-30)) / (at_x(8) - at_x(25)), low = BOTTOM + out;
    assert_int_equal(s->count, 8);
    assert_int_equal(s->begun, 3);
    assert_int_equal(s->join, CAIRO_LINE_JOIN_ROUND);
    assert_true(s->clip_low[0] == LEFT && s->clip_high[0] == RIGHT && s->clip_low[1] == TOP && s->clip_high[1] == BOTTOM);
    assert_line(s, 0, at_x(5), at_y(5), at_x(5), TOP - out);
    assert_line(s, 2, at_x(8) + (low - at_y(4)) / slope, low, at_x(8), at_y(4));
    assert_at(s->at[4].x, at_x(8));
    assert_at(s->at[4].y, at_y(8));
    assert_at(s->at[5].x, LEFT - out);
    assert_at(s->at[5].y, at_y(8));
    assert_line(s, 6, at_x(2), TOP - out, at_x(2), at_y(5)); /* from so far away that it comes straight down */
    assert_bounds(s, LEFT - out, TOP - out, at_x(8) + (low - at_y(4)) / slope, low);
}

/* Of many values in a column of pixels: the first, the extremes in their order, the last. */
static void dense_curves_keep_their_extremes_in_order(void **)
{
    enum { EACH = 5, MANY = EACH * WIDTH };
    static const double values[2][EACH] = {{5, 2, 8, 4, 6}, {5, 8, 2, 7, 4}};
    static double x[MANY], y[MANY];
    for (size_t i = 0; i < MANY; i++) {
        x[i] = 10 * ((double)(i / EACH) + 0.1 + 0.2 * (double)(i % EACH)) / WIDTH;
        y[i] = values[i / EACH % 2][i % EACH];
    }
    x[MANY - 1] = x[MANY - 2] = x[MANY - 3] = NAN; /* two are left in the last column */
    draw_panel(&(struct bead_series){.x = x, .y = y, .count = MANY, .mark = BEAD_MARK_LINE}, 1);
    const struct stroke *s = &strokes.list[0];
    assert_int_equal(s->count, 4 * (WIDTH - 1) + 2);
    for (size_t c = 0; c < WIDTH; c++) {
        const double *v = values[c % 2];
        const size_t kept[] = {0, 1, 2, 4};
        for (size_t k = 0; k < (c + 1 < WIDTH ? 4 : 2); k++) {
            assert_at(s->at[4 * c + k].x, LEFT + (double)c + 0.1 + 0.2 * (double)kept[k]);
            assert_at(s->at[4 * c + k].y, at_y(v[kept[k]]));
            assert_true(s->at[4 * c + k].begins == (c + k == 0));
        }
    }
    y[EACH + 2] = NAN; /* a gap within a column: both of its parts are drawn */
    draw_panel(&(struct bead_series){.x = x, .y = y, .count = MANY, .mark = BEAD_MARK_LINE}, 1);
    assert_true(s->begun == 2 && s->at[6].begins && s->count == 4 * (WIDTH - 1) + 2);
    assert_at(s->at[5].y, at_y(8));
    assert_at(s->at[6].y, at_y(7));
    y[EACH + 2] = 2;
    draw_panel(&(struct bead_series){.x = x, .y = y, .count = 4 * WIDTH, .mark = BEAD_MARK_LINE}, 1); /* four in a pixel: all */
    assert_int_equal(strokes.list[0].count, 4 * WIDTH);
}

/* Between y and the upper values, with both as thin lines. */
static void bands_lie_between_their_edges(void **)
{
    static const double x[] = {1, 4, 9}, y[] = {2, 3, 1}, upper[] = {4, 6, 5};
    const struct bead_series series = {.x = x, .y = y, .upper = upper, .count = 3, .mark = BEAD_MARK_BAND, .colour = 1};
    const struct bead_rgb ink = bead_look_curve(&look, 1), page = look.background;
    draw_panel(&series, 1);
    assert_int_equal(strokes.count, 3);
    const struct stroke *s = strokes.list;
    assert_true(stroke_has(
        &s[0], true,
        (struct bead_rgb){page.r + 0.22 * (ink.r - page.r), page.g + 0.22 * (ink.g - page.g), page.b + 0.22 * (ink.b - page.b)}));
    assert_int_equal(s[0].count, 6);
    for (size_t i = 0; i < 3; i++) {
        assert_at(s[0].at[i].x, at_x(x[i]));
        assert_at(s[0].at[i].y, at_y(y[i]));
        assert_at(s[0].at[5 - i].x, at_x(x[i]));
        assert_at(s[0].at[5 - i].y, at_y(upper[i]));
        for (int edge = 0; edge < 2; edge++) {
            assert_true(!s[1 + edge].filled && s[1 + edge].count == 3 && s[1 + edge].width == look.line);
            assert_at(s[1 + edge].at[i].x, at_x(x[i]));
            assert_at(s[1 + edge].at[i].y, at_y(edge ? upper[i] : y[i]));
        }
    }
}

/* Places for a name: the last point, or the point where the frame cuts the line off; nowhere above and below. */
static void lines_end_where_the_frame_cuts_them(void **)
{
    static const double x[] = {2, 8, 12, 14}, y[] = {1, 3, 7, 9}, high[] = {1, 9, 13, 14}, gap[] = {1, 3, NAN, 9};
    double end[2];
    struct bead_series series = {.x = x, .y = y, .count = 4};
    assert_true(graph_series_end(&cell, &series, end));
    assert_at(end[0], RIGHT);
    assert_at(end[1], at_y(5)); /* half way from 3 to 7 */
    series.count = 2;
    assert_true(graph_series_end(&cell, &series, end));
    assert_at(end[0], at_x(8));
    assert_at(end[1], at_y(3));
    series.count = 4;
    series.y = gap;
    assert_true(graph_series_end(&cell, &series, end));
    assert_at(end[1], at_y(5)); /* a third of the way from 3 to 9 */
    series.y = high;
    assert_false(graph_series_end(&cell, &series, end));
    static const double down[] = {9, 1, -3, -4};
    series.y = down;
    assert_false(graph_series_end(&cell, &series, end));
    series.x = x + 2;
    series.count = 2;
    assert_false(graph_series_end(&cell, &series, end));
    for (int k = 0; k < 4; k++) { /* on the frame, and just beyond */
        const double last = (double[]){0, 10, -0.01, 10.01}[k];
        assert_true(graph_series_end(&cell, &(struct bead_series){.x = x, .y = &last, .count = 1}, end) == (k < 2));
    }
}

/* Each axis has its own scale: a logarithmic one below has no place for values not above 0. */
static void axes_have_their_own_scales(void **)
{
    static const double x[] = {1, 10, 100, -1, 1000, 0, 1}, y[] = {-10, 10, 0, 5, 2, 5, 10}, error[] = {5, 5, 5, 5, 5, 5, 5};
    bead_axis_make(&cell.axis[0], 1, 100, "", BEAD_SCALE_LOG, WIDTH, look.tick, true);
    bead_axis_make(&cell.axis[1], -20, 20, "", BEAD_SCALE_LINEAR, HEIGHT, look.tick, false);
    draw_panel(&(struct bead_series){.x = x, .y = y, .error = error, .count = 7, .mark = BEAD_MARK_LINE_POINTS, .shape = 1}, 1);
    assert_int_equal(strokes.count, 2 + 2 * 4);
    assert_line(&strokes.list[0], 0, LEFT, TOP + 0.75 * HEIGHT, LEFT + 0.5 * WIDTH, TOP + 0.25 * HEIGHT);
    assert_true(strokes.list[0].count == 3 && strokes.list[1].count == 4 * 6);
    for (size_t i = 0; i < 4; i++) {
        const struct stroke *s = &strokes.list[2 + 2 * i];
        const double place = (double[]){0, 0.5, 1, 0}[i], value = (double[]){0.75, 0.25, 0.5, 0.25}[i];
        assert_at((s->low[0] + s->high[0]) / 2, LEFT + place * WIDTH);
        assert_at((s->low[1] + s->high[1]) / 2, TOP + value * HEIGHT);
        assert_true(s->clip_low[0] < LEFT); /* marks are whole on the frame */
    }
}

/* ---- rulers ---- */

/* Lines right across at their values, thresholds dashed, plateaus dotted; bands as far as the frame; nothing beyond. */
static void rulers_cross_at_their_values(void **)
{
    static const struct bead_ruler rulers[] = {{true, 3, NAN, NAN, NULL}, {false, 4, 2, 12, NULL}, {true, 11, 8, 15, NULL},
                                               {false, -1, -3, 1, NULL},  {true, 10, 4, 6, NULL},  {false, 0, 5, 5, NULL}};
    static const double bands[][4] = {{0, 2, 10, 10}, {8, 0, 10, 10}, {0, 0, 10, 1}, {4, 0, 6, 10}};
    panel.rulers = rulers;
    panel.ruler_count = 6;
    draw_panel(NULL, 0);
    assert_int_equal(strokes.count, 4);
    for (size_t i = 0; i < 4; i++) {
        const bool vertical = i % 2 == 0;
        const struct stroke *s = &strokes.list[i];
        const double at = (double[]){3, 4, 10, 0}[i];
        assert_true(stroke_has(s, false, look.faint) && s->width == look.line && s->dashes == 2);
        assert_at(s->dash[0], look.line * (vertical ? 5 : 1.2));
        assert_at(s->dash[1], look.line * (vertical ? 3 : 2.2));
        if (vertical)
            assert_bounds(s, at_x(at), TOP, at_x(at), BOTTOM);
        else
            assert_bounds(s, LEFT, at_y(at), RIGHT, at_y(at));
    }
    for (int dark = 0; dark < 2; dark++) {
        struct canvas c = make_canvas(800, 400);
        const double part = dark ? 0.25 : 0.16;
        if (dark)
            bead_look_darken(&look);
        const struct bead_rgb page = dark ? look.panel : look.background;
        strokes_begin();
        graph_draw_bands(c.cr, &look, &cell);
        assert_int_equal(strokes.count, 4);
        for (size_t i = 0; i < 4; i++) {
            assert_bounds(&strokes.list[i], at_x(bands[i][0]), at_y(bands[i][3]), at_x(bands[i][2]), at_y(bands[i][1]));
            assert_true(stroke_has(&strokes.list[i], true, bead_rgb_mix(page, look.accent, part)));
        }
        free_canvas(&c);
    }
}

/* Faint curves, then rulers, then the others, in their order. */
static void faint_curves_are_below(void **)
{
    static const double x[] = {1, 9}, y[] = {2, 3};
    static const struct bead_ruler ruler = {true, 3, NAN, NAN, NULL};
    struct bead_series series[4];
    for (size_t s = 0; s < 4; s++)
        series[s] = (struct bead_series){.x = x, .y = y, .count = 2, .mark = BEAD_MARK_LINE, .colour = s, .faint = s % 2};
    panel.rulers = &ruler;
    panel.ruler_count = 1;
    draw_panel(series, 4);
    assert_int_equal(strokes.count, 5);
    const struct bead_rgb page = look.background;
    assert_true(stroke_has(&strokes.list[0], false, bead_rgb_mix(page, bead_look_curve(&look, 1), 0.35)));
    assert_true(stroke_has(&strokes.list[1], false, bead_rgb_mix(page, bead_look_curve(&look, 3), 0.35)));
    assert_true(stroke_has(&strokes.list[2], false, look.faint));
    assert_true(stroke_has(&strokes.list[3], false, bead_look_curve(&look, 0)));
    assert_true(stroke_has(&strokes.list[4], false, bead_look_curve(&look, 2)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(bars_reach_their_errors_within_the_frame, set_up),
        cmocka_unit_test_setup(shapes_are_what_they_are_called, set_up),
        cmocka_unit_test_setup(arrows_point_at_what_is_beyond, set_up),
        cmocka_unit_test_setup(points_of_equal_x_are_beside_each_other, set_up),
        cmocka_unit_test_setup(marks_of_dense_curves_alternate, set_up),
        cmocka_unit_test_setup(points_have_the_size_that_fits, set_up),
        cmocka_unit_test_setup(lines_have_their_style, set_up),
        cmocka_unit_test_setup(lines_are_cut_on_their_way, set_up),
        cmocka_unit_test_setup(dense_curves_keep_their_extremes_in_order, set_up),
        cmocka_unit_test_setup(bands_lie_between_their_edges, set_up),
        cmocka_unit_test_setup(lines_end_where_the_frame_cuts_them, set_up),
        cmocka_unit_test_setup(axes_have_their_own_scales, set_up),
        cmocka_unit_test_setup(rulers_cross_at_their_values, set_up),
        cmocka_unit_test_setup(faint_curves_are_below, set_up),
    };
    return cmocka_run_group_tests_name("what graphs draw", tests, NULL, NULL);
}
