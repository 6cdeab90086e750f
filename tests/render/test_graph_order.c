/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of curves, rulers and panels does not matter: reversed, they have the same axes, places, words and names, for graphs of
 * all kinds of curves, made up at random from a fixed seed. What is asked of one is asked of the first and the last, too. */
#include <math.h>

#include "graphs.h"
#include "render/draw/looks.h"

enum { POINTS = 7, SERIES_MOST = 4, RULERS_MOST = 3, PANELS_MOST = 3, GRAPHS = 150 };

struct made {
    struct curve {
        double x[POINTS], y[POINTS], upper[POINTS], error[POINTS];
    } curve[SERIES_MOST];
    struct bead_series series[SERIES_MOST];
    struct bead_ruler rulers[RULERS_MOST];
    struct bead_panel panel;
};

static uint32_t state;

static uint32_t below(uint32_t count)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 16) % count;
}

/* Digits are equally wide, so that legends are the same in any order. */
static void make_curve(struct made *m, size_t s, bool ends)
{
    static const char *const labels[SERIES_MOST] = {"curve 1", "curve 2", "curve 3", "curve 4"};
    static const enum bead_mark marks[] = {BEAD_MARK_LINE, BEAD_MARK_LINE_POINTS, BEAD_MARK_POINTS, BEAD_MARK_BAND};
    struct curve *c = &m->curve[s];
    const double length = below(4) ? 1 : 0.6, level = 1 + below(9), slope = below(3);
    const bool broken = below(6) == 0;
    for (int i = 0; i < POINTS; i++) {
        c->x[i] = length * i / (POINTS - 1);
        c->y[i] = broken && i < 2 ? NAN : level + slope * c->x[i];
        c->upper[i] = c->y[i] + 0.7;
        c->error[i] = 0.3 + 0.1 * i;
    }
    const enum bead_mark mark = marks[below(ends ? 2 : 4)];
    m->series[s] = (struct bead_series){.x = c->x,
                                        .y = c->y,
                                        .upper = mark == BEAD_MARK_BAND ? c->upper : NULL,
                                        .error = mark == BEAD_MARK_POINTS && below(2) ? c->error : NULL,
                                        .count = POINTS,
                                        .mark = mark,
                                        .colour = s,
                                        .shape = s,
                                        .dash = s,
                                        .faint = !ends && below(5) == 0,
                                        .label = below(6) ? labels[s] : NULL};
}

static void make_panel_at_random(struct made *m)
{
    static const char *const words[RULERS_MOST] = {"word 1", "word 2", "word 3"};
    const bool ends = below(2);
    const size_t series = 1 + below(SERIES_MOST), rulers = below(RULERS_MOST + 1);
    for (size_t s = 0; s < series; s++)
        make_curve(m, s, ends);
    for (size_t r = 0; r < rulers; r++)
        m->rulers[r] = (struct bead_ruler){.vertical = below(2), .low = NAN, .high = NAN, .label = words[r]};
    for (size_t r = 0; r < rulers; r++)
        m->rulers[r].value = m->rulers[r].vertical ? 0.1 * (1 + below(8)) : 0.5 + below(12);
    m->panel = (struct bead_panel){.x = {"along", "m", NAN, NAN, BEAD_SCALE_LINEAR, false},
                                   .y = {"up", "N", NAN, NAN, below(4) ? BEAD_SCALE_LINEAR : BEAD_SCALE_LOG, below(2)},
                                   .series = m->series,
                                   .series_count = series,
                                   .rulers = m->rulers,
                                   .ruler_count = rulers};
}

static void turn(const struct made *m, struct made *to)
{
    *to = *m;
    to->panel.series = to->series;
    to->panel.rulers = to->rulers;
    for (size_t s = 0; s < m->panel.series_count; s++)
        to->series[s] = m->series[m->panel.series_count - 1 - s];
    for (size_t r = 0; r < m->panel.ruler_count; r++)
        to->rulers[r] = m->rulers[m->panel.ruler_count - 1 - r];
}

#define assert_alike(law)                                    \
    do {                                                     \
        if (!(law))                                          \
            fail_msg("graph %d: reversed, not %s", g, #law); \
    } while (0)

static void assert_same_box(int g, struct graph_box a, struct graph_box b)
{
    assert_alike(a.width == b.width && (a.width == 0 || (a.x == b.x && a.y == b.y && a.height == b.height)));
}

static void assert_same_cell(int g, const struct graph_cell *a, const struct graph_cell *b)
{
    assert_alike(memcmp(&a->plot, &b->plot, sizeof a->plot) == 0);
    assert_alike(memcmp(a->low, b->low, sizeof a->low) == 0 && memcmp(a->high, b->high, sizeof a->high) == 0);
    assert_alike(a->ends == b->ends && a->legend_outside == b->legend_outside && a->raised == b->raised);
    assert_alike(a->legend.count == b->legend.count && a->rulers_outside == b->rulers_outside);
    assert_same_box(g, a->legend.box, b->legend.box);
    for (size_t r = 0; r < a->panel->ruler_count; r++)
        assert_alike(a->words[r].state == b->words[a->panel->ruler_count - 1 - r].state);
}

static void curves_and_rulers_have_no_order(void **)
{
    static struct made m, other;
    struct bead_look look;
    int ends = 0, outside = 0, words = 0;
    state = 20261128;
    bead_look_paper(&look, 150);
    for (int g = 0; g < GRAPHS; g++) {
        make_panel_at_random(&m);
        turn(&m, &other);
        const double width = below(2) ? 500 : 330, height = 260;
        const struct bead_graph one = {.panels = &m.panel, .panel_count = 1}, reversed = {.panels = &other.panel, .panel_count = 1};
        struct graph_layout a = lay_out(&one, &look, width, height), b = lay_out(&reversed, &look, width, height);
        assert_same_cell(g, a.cells, b.cells);
        assert_alike(a.legend.count == b.legend.count && a.legend_right == b.legend_right);
        assert_same_box(g, a.legend.box, b.legend.box);
        ends += a.cells->ends, outside += a.legend.count > 0;
        words += m.panel.ruler_count > 0 && a.cells->words[0].state == GRAPH_WORD_IN_LEGEND;
        graph_layout_free(&a);
        graph_layout_free(&b);
    }
    assert_true(ends > 20 && outside > 20 && words > 20);
}

/* Shared axes have the range of all panels; an entry that is in several is explained once. */
static void panels_have_no_order(void **)
{
    static struct made m[PANELS_MOST];
    struct bead_look look;
    state = 20261129;
    bead_look_paper(&look, 150);
    for (int g = 0; g < GRAPHS / 3; g++) {
        const size_t count = 2 + below(PANELS_MOST - 1);
        struct bead_panel panels[2][PANELS_MOST];
        struct graph_layout at[2];
        struct bead_graph graph = {.panel_count = count, .share_x = below(2), .share_y = below(2), .letters = true};
        for (size_t p = 0; p < count; p++)
            make_panel_at_random(&m[p]);
        for (size_t p = 0; p < count; p++) {
            m[p].panel.y = m[0].panel.y;
            m[p].panel.ruler_count = 0;
            panels[0][p] = panels[1][count - 1 - p] = m[p].panel;
        }
        for (int k = 0; k < 2; k++) {
            graph.panels = panels[k];
            at[k] = lay_out(&graph, &look, 330, 900);
        }
        assert_alike(at[0].columns == 1 && at[1].columns == 1);
        for (size_t p = 0; p < count; p++) {
            const struct graph_cell *a = &at[0].cells[p], *b = &at[1].cells[count - 1 - p], *first = at[0].cells;
            const bool shared[2] = {graph.share_x, graph.share_y};
            for (int k = 0; k < 2; k++) {
                assert_alike(a->low[k] == b->low[k] && (a->raised || b->raised || a->high[k] == b->high[k]));
                assert_alike(!shared[k] || (a->low[k] == first->low[k] && a->high[k] == first->high[k]));
            }
            assert_alike(a->ends == b->ends);
        }
        for (int k = 0; k < 2; k++)
            graph_layout_free(&at[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_and_rulers_have_no_order),
        cmocka_unit_test(panels_have_no_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
