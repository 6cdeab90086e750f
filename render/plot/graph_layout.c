/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a graph: axes and words are measured, plots get the remaining room. Names that do not fit at the ends of their
 * lines move to the legend; words and legends that do not fit in free room of the panels move outside; this repeats until
 * everything has a place. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/markup.h"
#include "render/plot/graph_private.h"
#include "sim/base/memory.h"

/* In units of the label's font size. */
static const double head_gap = 0.35, between_columns = 1.0, between_rows = 0.8;
/* Preferred ratio of a panel's width to its height. */
static const double wanted_shape = 1.45;
static const int smallest_plot = 24; /* px */

static bool has(const char *text)
{
    return text && *text;
}

/* ---- words ---- */

void graph_letter(size_t index, char *text, size_t size)
{
    if (index < 26)
        snprintf(text, size, "(%c)", (char)('a' + index));
    else
        snprintf(text, size, "(%c%c)", (char)('a' + (index / 26 - 1) % 26), (char)('a' + index % 26));
}

/* Letter and title as one text. */
static bool make_head(struct graph_cell *cell, const char *letter)
{
    const char *title = has(cell->panel->title) ? cell->panel->title : "";
    if (!*letter && !*title)
        return true;
    BEAD_FREED char *markup = bead_markup_new(title);
    bool good = markup && asprintf(&cell->head, "<b>%s</b>%s%s", letter, *letter && *title ? "\u2002" : "", markup) > 0;
    return good;
}

/* A ruler's word, and the same with the letter of its panel. */
static bool make_word(struct graph_word *word, const char *label, const char *letter)
{
    if (!has(label))
        return true;
    word->markup = bead_markup_new(label);
    if (!word->markup || asprintf(&word->lettered, "<b>%s</b>\u2002%s", letter, word->markup) <= 0) {
        word->lettered = NULL;
        return false;
    }
    return true;
}

static bool word_cell(struct graph_cell *cell, const struct bead_graph *graph, const struct graph_frame *frame, size_t index)
{
    const struct bead_panel *panel = cell->panel;
    char letter[32];
    bool good = true;
    cell->words = calloc(panel->ruler_count + 1, sizeof *cell->words);
    cell->labels = calloc(panel->series_count + 1, sizeof *cell->labels);
    cell->legend.entries = calloc(panel->series_count + panel->ruler_count + 1, sizeof *cell->legend.entries);
    if (!cell->words || !cell->labels || !cell->legend.entries)
        return false;
    graph_letter(index, letter, sizeof letter);
    for (size_t r = 0; r < panel->ruler_count; r++)
        good = good && make_word(&cell->words[r], panel->rulers[r].label, letter);
    for (size_t s = 0; s < panel->series_count; s++)
        good = good && (!has(panel->series[s].label) || (cell->labels[s] = bead_markup_new(panel->series[s].label)) != NULL);
    bool lettered = graph->letters && graph->panel_count > 1;
    return good && make_head(cell, lettered ? letter : index == 0 ? frame->letter : "");
}

static size_t largest_cloud(const struct bead_graph *graph)
{
    size_t most = 0;
    for (size_t p = 0; p < graph->panel_count; p++) {
        for (size_t s = 0; s < graph->panels[p].series_count; s++) {
            const size_t points = graph_cloud(&graph->panels[p].series[s]);
            most = points > most ? points : most;
        }
    }
    return most;
}

static enum bead_error graph_prepare(struct graph_layout *l, struct bead_message *msg)
{
    const struct bead_graph *graph = l->graph;
    size_t entries = 1;
    l->cells = calloc(graph->panel_count, sizeof *l->cells);
    bool good = l->cells;
    for (size_t p = 0; good && p < graph->panel_count; p++) {
        struct graph_cell *cell = &l->cells[p];
        cell->panel = &graph->panels[p];
        cell->most_points = largest_cloud(graph);
        cell->row = p / l->columns;
        cell->column = p % l->columns;
        bool lowest = p + l->columns >= graph->panel_count;
        cell->labelled[0] = (!graph->share_x || lowest) && !(l->frame.no_across && lowest);
        cell->labelled[1] = !graph->share_y || cell->column == 0;
        entries += cell->panel->series_count + cell->panel->ruler_count;
        good = word_cell(cell, graph, &l->frame, p);
    }
    l->legend.entries = calloc(entries, sizeof *l->legend.entries);
    good = good && l->legend.entries && (!has(graph->title) || (l->page.title = bead_markup_new(graph->title)) != NULL);
    good = good && (!has(graph->caption) || (l->page.caption = bead_markup_new(graph->caption)) != NULL);
    return good ? BEAD_OK : bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a graph");
}

void graph_layout_free(struct graph_layout *l)
{
    for (size_t p = 0; l->cells && p < l->graph->panel_count; p++) {
        struct graph_cell *cell = &l->cells[p];
        for (size_t r = 0; cell->words && r < cell->panel->ruler_count; r++) {
            free(cell->words[r].markup);
            free(cell->words[r].lettered);
        }
        for (size_t s = 0; cell->labels && s < cell->panel->series_count; s++)
            free(cell->labels[s]);
        free(cell->words);
        free(cell->labels);
        free(cell->legend.entries);
        free(cell->head);
    }
    free(l->cells);
    bead_layout_free(&l->grid);
    free(l->legend.entries);
    free(l->page.title);
    free(l->page.caption);
    *l = (struct graph_layout){0};
}

/* ---- room ---- */

/* Rows: the title, the rows of panels, the outer legend, the caption. Columns: the columns of panels, an outer legend. */
static enum bead_error make_grid(struct graph_layout *l, struct bead_message *msg)
{
    const struct bead_insets *least = &l->frame.least;
    double em = l->look->label, margin = l->frame.margin;
    BEAD_TRY(bead_layout_make(l->columns + 1, l->rows + 3, l->graph->panel_count, &l->grid, msg));
    struct bead_lane *columns = l->grid.columns.lane, *rows = l->grid.rows.lane;
    for (size_t p = 0; p < l->grid.count; p++) {
        l->grid.boxes[p].column = l->cells[p].column;
        l->grid.boxes[p].row = 1 + l->cells[p].row;
    }
    rows[0].least = l->page.above;
    rows[l->rows + 2].least = l->page.below;
    bead_lanes_want(columns, l->columns, (struct bead_lane){.gap = between_columns * em, .least = smallest_plot, .share = 1});
    bead_lanes_want(rows + 1, l->rows, (struct bead_lane){.gap = between_rows * em, .least = smallest_plot, .share = 1});
    if (l->graph->residuals)
        rows[l->rows].share = 0.5;
    columns[0].keep[0] = least->left;
    columns[l->columns - 1].keep[1] = least->right;
    rows[1].keep[0] = least->top;
    rows[l->rows].keep[1] = least->bottom;
    bead_lanes_within(&l->grid.columns, margin, l->width - 2 * margin);
    bead_lanes_within(&l->grid.rows, margin, l->height - 2 * margin);
    return BEAD_OK;
}

/* ---- plots ---- */

/* Reach of a horizontal axis' labels beyond its ends. */
static void overhang(const struct bead_axis *axis, const struct bead_look *look, double length, double *left, double *right)
{
    struct bead_text_style style = graph_text(look);
    style.size = look->tick;
    *left = *right = 0;
    for (size_t i = 0; i < axis->count; i++) {
        double width, height, at = axis->ticks[i].place * length;
        bead_text_size(NULL, &style, axis->ticks[i].label, &width, &height);
        *left = fmax(*left, width / 2 - at);
        *right = fmax(*right, at + width / 2 - length);
    }
}

static void graph_make_axes(struct graph_cell *cell, const struct bead_look *look)
{
    const struct bead_graph_axis *x = &cell->panel->x, *y = &cell->panel->y;
    bead_axis_make(&cell->axis[0], cell->low[0], cell->high[0], x->unit, x->scale, cell->plot.width, look->tick, true);
    bead_axis_make(&cell->axis[1], cell->low[1], cell->high[1], y->unit, y->scale, cell->plot.height, look->tick, false);
}

static double head_height(const struct graph_layout *l, const struct graph_cell *cell)
{
    struct bead_text_style style = graph_text(l->look);
    double width, height;
    if (!cell->head)
        return 0;
    bead_text_size_lines(NULL, &style, -cell->plot.width, cell->head, &width, &height);
    return ceil(height + head_gap * l->look->label);
}

static struct bead_insets reach_of(const struct graph_layout *l, const struct graph_cell *cell)
{
    const struct bead_look *look = l->look;
    double over_left, over_right, half = cell->labelled[1] ? 0.45 * look->tick : 0;
    double points = 0.3 * look->tick; /* on the frame */
    overhang(&cell->axis[0], look, cell->plot.width, &over_left, &over_right);
    double left =
        bead_axis_draw(NULL, look, &cell->axis[1], cell->plot, BEAD_SIDE_LEFT, false, cell->labelled[1], cell->panel->y.title);
    double bottom =
        bead_axis_draw(NULL, look, &cell->axis[0], cell->plot, BEAD_SIDE_BOTTOM, false, cell->labelled[0], cell->panel->x.title);
    return (struct bead_insets){.left = cell->labelled[0] ? fmax(left, over_left) : left,
                                .top = fmax(half, points),
                                .right = fmax(cell->labelled[0] ? fmax(points, over_right) : points,
                                              fmax(graph_image_reach(look, cell), graph_ends_reach(cell, look))),
                                .bottom = fmax(bottom, half)};
}

static void take_plots(struct graph_layout *l)
{
    for (size_t p = 0; p < l->grid.count; p++) {
        l->cells[p].plot = l->grid.boxes[p].at;
        graph_make_axes(&l->cells[p], l->look);
    }
}

static enum bead_error graph_measure(void *user, struct bead_message *)
{
    struct graph_layout *l = user;
    take_plots(l);
    for (size_t p = 0; p < l->grid.count; p++) {
        struct graph_cell *cell = &l->cells[p];
        struct bead_insets *reach = &l->grid.boxes[p].reach;
        *reach = reach_of(l, cell);
        reach->top = fmax(reach->top, head_height(l, cell));
    }
    return BEAD_OK;
}

static enum bead_error no_room(void *user, struct bead_message *msg)
{
    const struct graph_layout *l = user;
    return bead_fail(msg, BEAD_ERROR_SCENE, "size: %s leave%s no room for %zu plot%s and their labels",
                     l->graph->size ? l->graph->size : "this", l->graph->size ? "" : "s", l->graph->panel_count,
                     l->graph->panel_count == 1 ? "" : "s");
}

/* Fails if an outer legend is larger than all plots together. */
static enum bead_error check_legend(struct graph_layout *l, struct bead_message *msg)
{
    double plots = 0;
    for (size_t p = 0; p < l->graph->panel_count; p++)
        plots += (double)l->cells[p].plot.width * (double)l->cells[p].plot.height;
    return l->legend.count > 0 && l->legend.box.width * l->legend.box.height > plots ? no_room(l, msg) : BEAD_OK;
}

static void put_outer_legend(struct graph_layout *l)
{
    double margin = l->frame.margin;
    const struct graph_cell *first = &l->cells[0];
    if (l->legend_right) {
        l->legend.box.x = l->width - margin - l->legend.box.width;
        l->legend.box.y = first->plot.y;
        return;
    }
    double bottom = l->height - margin - l->page.below;
    double free = l->width - margin - first->plot.x - l->legend.box.width; /* from the plots' left border if it fits */
    l->legend.box.x = first->plot.x + fmin(0, free);
    l->legend.box.y = bottom - l->legend.box.height;
}

/* The room for axes depends on the size of plots, and vice versa. At first the room may shrink; later it only grows, until
 * everything fits. */
static enum bead_error graph_arrange(struct graph_layout *l, struct bead_message *msg)
{
    enum { FREELY = 3 };
    const double gap = graph_legend_gap * l->look->label;
    struct bead_lane *columns = l->grid.columns.lane, *rows = l->grid.rows.lane;
    bool outside = l->legend.count > 0;
    columns[l->columns].least = outside && l->legend_right ? ceil(l->legend.box.width + gap) : 0;
    rows[l->rows + 1].least = outside && !l->legend_right ? ceil(l->legend.box.height + gap) : 0;
    BEAD_TRY(bead_layout_settle(&l->grid, FREELY, true,
                                &(struct bead_layout_owner){.user = l, .measure = graph_measure, .no_room = no_room}, msg));
    take_plots(l);
    put_outer_legend(l);
    return BEAD_OK;
}

/* Raises the end of the y axis, in all panels that share it, to make room for the legend above the curves. False: impossible. */
static bool raise_axes(struct graph_layout *l, struct graph_cell *cell)
{
    double air = 4 * graph_air(l->look), free = cell->plot.height;
    struct graph_legend legend = cell->legend;
    bool own = l->graph->panel_count > 1 && (!l->graph->share_y || cell->legend_outside); /* only of this panel */
    if (!(l->part || own) || cell->raised || isfinite(cell->panel->y.high))
        return false;
    graph_legend_measure(&legend, l->look, 0.9 * cell->plot.width, 0);
    free -= legend.box.height + air;
    if (legend.wrap != 0 || free < 0.5 * cell->plot.height)
        return false;
    double low = cell->low[1], high = cell->high[1], more = cell->plot.height / free;
    high = cell->panel->y.scale == BEAD_SCALE_LOG ? low * pow(high / low, more) : low + (high - low) * more;
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        struct graph_cell *other = &l->cells[p];
        if (other != cell && !l->graph->share_y)
            continue;
        other->high[1] = high;
        other->raised = true;
    }
    return true;
}

/* All rulers have their words in the same kind of place: beside their lines, or in legends. */
static void move_words(struct graph_layout *l)
{
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        for (size_t r = 0; r < l->cells[p].panel->ruler_count; r++) {
            if (l->cells[p].words[r].markup && !isnan(l->cells[p].panel->rulers[r].value))
                l->cells[p].words[r].state = GRAPH_WORD_IN_LEGEND;
        }
    }
}

/* Places words and legend in a panel. *moved: something must move outside. */
static enum bead_error furnish(struct graph_layout *l, struct graph_cell *cell, bool *moved, struct bead_message *msg)
{
    struct graph_mask mask;
    if (cell->ends && !graph_ends_fit(cell, l->look)) {
        cell->ends = false;
        *moved = true;
        return BEAD_OK;
    }
    if (cell->panel->ruler_count == 0 && cell->legend.count == 0)
        return BEAD_OK;
    BEAD_TRY(graph_mask_make(cell, l->look, &mask, msg));
    bool words = graph_words_place(cell, l->look, &mask);
    if (words)
        move_words(l);
    if (!words && cell->legend.count > 0 && !graph_legend_place(&cell->legend, l->look, &mask)) {
        bool *outside = cell->legend_outside ? &cell->rulers_outside : &cell->legend_outside;
        *outside = !raise_axes(l, cell);
        words = true;
    }
    *moved = *moved || words;
    graph_mask_free(&mask);
    return BEAD_OK;
}

static void choose_columns(struct graph_layout *l)
{
    size_t count = l->graph->panel_count;
    const struct bead_layout_area area = {.width = l->width, .height = l->height, .shape = wanted_shape, .empty = 1.5};
    l->columns = l->graph->residuals ? count / 2 : bead_layout_columns(count, &area);
    l->rows = (count + l->columns - 1) / l->columns;
}

enum bead_error graph_layout_make(const struct bead_graph *graph, const struct bead_look *look, double width, double height,
                                  const struct graph_frame *frame, struct graph_layout *layout, struct bead_message *msg)
{
    *layout = (struct graph_layout){.graph = graph, .look = look, .width = width, .height = height};
    layout->frame = frame ? *frame : (struct graph_frame){.margin = look->margin, .letter = ""};
    layout->part = frame != NULL;
    if (graph->panel_count == 0 || !(width >= 1) || !(height >= 1))
        return bead_fail(msg, BEAD_ERROR_SCENE, "size: %.0f x %.0f pixels have no room for %zu panels", width, height,
                         graph->panel_count);
    choose_columns(layout);
    enum bead_error err = graph_prepare(layout, msg);
    if (!err)
        err = graph_find_ranges(layout, msg);
    if (!err) {
        graph_page_measure(&layout->page, look, width, height);
        err = make_grid(layout, msg);
    }
    for (size_t p = 0; !err && p < graph->panel_count; p++)
        layout->cells[p].ends = graph_ends_wanted(layout, p);
    for (bool moved = true; !err && moved;) { /* ends: every name, word and legend moves at most once */
        moved = false;
        graph_gather_legends(layout);
        graph_measure_outside(layout);
        err = graph_arrange(layout, msg);
        for (size_t p = 0; !err && p < graph->panel_count; p++)
            err = furnish(layout, &layout->cells[p], &moved, msg);
    }
    if (!err)
        err = check_legend(layout, msg);
    if (err)
        graph_layout_free(layout);
    return err;
}
