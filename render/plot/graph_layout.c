/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a graph. Axes and words are measured, plots get the remaining room. Words and legends that find no free room inside
 * the panels go outside, which makes plots smaller; this repeats until everything has a place. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/draw/markup.h"
#include "render/plot/graph_private.h"

/* In units of the label's font size. */
static const double title_gap = 0.7, caption_gap = 0.5, head_gap = 0.35, between_columns = 1.0, between_rows = 0.8;
/* Preferred ratio of a panel's width to its height. */
static const double wanted_shape = 1.45;
static const int smallest_plot = 24; /* px */

static bool has(const char *text)
{
    return text && *text;
}

/* ---- words ---- */

/* "(a)", ... "(z)", "(aa)", ... */
static void letter_of(size_t index, char *text, size_t size)
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
    char *markup = bead_markup_new(title);
    bool good = markup && asprintf(&cell->head, "<b>%s</b>%s%s", letter, *letter && *title ? "\u2002" : "", markup) > 0;
    free(markup);
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
    letter_of(index, letter, sizeof letter);
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
    l->left = calloc(l->columns, sizeof *l->left);
    l->right = calloc(l->columns, sizeof *l->right);
    l->top = calloc(l->rows, sizeof *l->top);
    l->head = calloc(l->rows, sizeof *l->head);
    l->bottom = calloc(l->rows, sizeof *l->bottom);
    bool good = l->cells && l->left && l->right && l->top && l->bottom && l->head;
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
    good = good && l->legend.entries && (!has(graph->title) || (l->title = bead_markup_new(graph->title)) != NULL);
    good = good && (!has(graph->caption) || (l->caption = bead_markup_new(graph->caption)) != NULL);
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
    free(l->left);
    free(l->right);
    free(l->top);
    free(l->head);
    free(l->bottom);
    free(l->legend.entries);
    free(l->title);
    free(l->caption);
    *l = (struct graph_layout){0};
}

static double wrapped_height(const struct bead_look *look, const char *markup, double size, bool bold, double wrap)
{
    double width, height;
    struct bead_text_style style = graph_text(look);
    style.size = size;
    style.bold = bold;
    bead_text_size_lines(NULL, &style, wrap, markup, &width, &height);
    return height;
}

/* ---- room ---- */

static void measure_lines(struct graph_layout *l)
{
    double width = l->width - 2 * l->frame.margin;
    l->title_height = l->title ? wrapped_height(l->look, l->title, graph_title_size(l->look), true, width) : 0;
    l->caption_height = l->caption ? wrapped_height(l->look, l->caption, l->look->label, false, width) : 0;
}

double graph_above_panels(const struct graph_layout *l)
{
    return l->title ? ceil(l->title_height + title_gap * l->look->label) : 0;
}

double graph_below_panels(const struct graph_layout *l)
{
    return l->caption ? ceil(l->caption_height + caption_gap * l->look->label) : 0;
}

void graph_room_of_plots(const struct graph_layout *l, double *width, double *height)
{
    double em = l->look->label;
    *width = l->width - 2 * l->frame.margin - (double)(l->columns - 1) * between_columns * em;
    *height =
        l->height - 2 * l->frame.margin - graph_above_panels(l) - graph_below_panels(l) - (double)(l->rows - 1) * between_rows * em;
    for (size_t c = 0; c < l->columns; c++)
        *width -= ceil(l->left[c]) + ceil(l->right[c]);
    for (size_t r = 0; r < l->rows; r++)
        *height -= ceil(l->top[r]) + ceil(l->bottom[r]);
}

/* ---- plots ---- */

/* How far the labels of a level axis reach beyond its ends. */
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

static const char *graph_unit_of(const struct bead_graph_axis *axis)
{
    return axis->unit ? axis->unit : "";
}

static void graph_make_axes(struct graph_cell *cell, const struct bead_look *look)
{
    const struct bead_graph_axis *x = &cell->panel->x, *y = &cell->panel->y;
    bead_axis_make(&cell->axis[0], cell->low[0], cell->high[0], graph_unit_of(x), x->scale, cell->plot.width, look->tick, true);
    bead_axis_make(&cell->axis[1], cell->low[1], cell->high[1], graph_unit_of(y), y->scale, cell->plot.height, look->tick, false);
}

static double head_height(const struct graph_layout *l, const struct graph_cell *cell)
{
    double em = l->look->label;
    return cell->head ? ceil(wrapped_height(l->look, cell->head, em, false, cell->plot.width) + head_gap * em) : 0;
}

static void forget(struct graph_layout *l)
{
    memset(l->left, 0, l->columns * sizeof *l->left);
    memset(l->right, 0, l->columns * sizeof *l->right);
    memset(l->top, 0, l->rows * sizeof *l->top);
    memset(l->bottom, 0, l->rows * sizeof *l->bottom);
    memset(l->head, 0, l->rows * sizeof *l->head);
}

/* At least as far as before. */
static void graph_measure(struct graph_layout *l)
{
    const struct bead_look *look = l->look;
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        struct graph_cell *cell = &l->cells[p];
        double *left = &l->left[cell->column], *right = &l->right[cell->column], over_left, over_right;
        double *top = &l->top[cell->row], *bottom = &l->bottom[cell->row];
        graph_make_axes(cell, look);
        overhang(&cell->axis[0], look, cell->plot.width, &over_left, &over_right);
        if (cell->labelled[0]) {
            *left = fmax(*left, over_left);
            *right = fmax(*right, over_right);
        }
        double half = cell->labelled[1] ? 0.45 * look->tick : 0;
        *left = fmax(*left, bead_axis_draw(NULL, look, &cell->axis[1], cell->plot, BEAD_SIDE_LEFT, false, cell->labelled[1],
                                           cell->panel->y.title));
        *bottom = fmax(*bottom, bead_axis_draw(NULL, look, &cell->axis[0], cell->plot, BEAD_SIDE_BOTTOM, false, cell->labelled[0],
                                               cell->panel->x.title));
        *bottom = fmax(*bottom, half);
        *right = fmax(*right, 0.3 * look->tick); /* points on the frame */
        l->head[cell->row] = fmax(l->head[cell->row], head_height(l, cell));
        *top = fmax(*top, fmax(l->head[cell->row], fmax(half, 0.3 * look->tick)));
    }
    const struct bead_insets *least = &l->frame.least;
    l->left[0] = fmax(l->left[0], least->left);
    l->right[l->columns - 1] = fmax(l->right[l->columns - 1], least->right);
    l->top[0] = fmax(l->top[0], least->top);
    l->bottom[l->rows - 1] = fmax(l->bottom[l->rows - 1], least->bottom);
}

static enum bead_error no_room(const struct graph_layout *l, struct bead_message *msg)
{
    return bead_fail(msg, BEAD_ERROR_SCENE, "size: %s leave%s no room for %zu plot%s and their labels",
                     l->graph->size ? l->graph->size : "this", l->graph->size ? "" : "s", l->graph->panel_count,
                     l->graph->panel_count == 1 ? "" : "s");
}

/* An outer legend that has more room than all plots is no picture of them. */
static enum bead_error check_legend(const struct graph_layout *l, struct bead_message *msg)
{
    double plots = 0;
    for (size_t p = 0; p < l->graph->panel_count; p++)
        plots += (double)l->cells[p].plot.width * (double)l->cells[p].plot.height;
    return l->legend.count > 0 && l->legend.box.width * l->legend.box.height > plots ? no_room(l, msg) : BEAD_OK;
}

static enum bead_error graph_divide(struct graph_layout *l, struct bead_message *msg)
{
    double em = l->look->label, width, height;
    graph_room_of_plots(l, &width, &height);
    if (l->legend.count > 0 && l->legend_right)
        width -= ceil(l->legend.box.width + graph_legend_gap * em);
    else if (l->legend.count > 0)
        height -= ceil(l->legend.box.height + graph_legend_gap * em);
    width = floor(width / (double)l->columns);
    height = floor(height / (double)l->rows);
    if (!(width >= smallest_plot) || !(height >= smallest_plot))
        return no_room(l, msg);
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        struct graph_cell *cell = &l->cells[p];
        double x = l->frame.margin + ceil(l->left[0]), y = l->frame.margin + graph_above_panels(l) + ceil(l->top[0]);
        for (size_t c = 1; c <= cell->column; c++)
            x += width + ceil(l->right[c - 1]) + between_columns * em + ceil(l->left[c]);
        for (size_t r = 1; r <= cell->row; r++)
            y += height + ceil(l->bottom[r - 1]) + between_rows * em + ceil(l->top[r]);
        cell->plot = (struct bead_rect){(int)round(x), (int)round(y), (int)width, (int)height};
    }
    return BEAD_OK;
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
    double bottom = l->height - margin - graph_below_panels(l);
    double free = l->width - margin - first->plot.x - l->legend.box.width; /* from the plots' left border if it fits */
    l->legend.box.x = first->plot.x + fmin(0, free);
    l->legend.box.y = bottom - l->legend.box.height;
}

static double reaches(const struct graph_layout *l)
{
    double sum = 0;
    for (size_t c = 0; c < l->columns; c++)
        sum += ceil(l->left[c]) + ceil(l->right[c]);
    for (size_t r = 0; r < l->rows; r++)
        sum += ceil(l->top[r]) + ceil(l->bottom[r]);
    return sum;
}

/* Several passes: the room for axes depends on the size of plots, and the reverse. First the room may shrink; later it only grows,
 * until everything fits. */
static enum bead_error graph_arrange(struct graph_layout *l, struct bead_message *msg)
{
    enum { FREELY = 3 };
    double em = l->look->label, before = -1;
    for (size_t c = 0; c < l->columns; c++)
        l->left[c] = 4 * em;
    for (size_t r = 0; r < l->rows; r++)
        l->bottom[r] = 2.5 * em;
    enum bead_error err = graph_divide(l, msg);
    for (int pass = 0; !err && (pass <= FREELY || reaches(l) > before); pass++) {
        before = reaches(l);
        if (pass < FREELY)
            forget(l);
        graph_measure(l);
        err = graph_divide(l, msg);
    }
    for (size_t p = 0; !err && p < l->graph->panel_count; p++)
        graph_make_axes(&l->cells[p], l->look);
    if (!err)
        put_outer_legend(l);
    return err;
}

/* Raises the axis to make room for the legend above the curves of all panels that share it. False: impossible. */
static bool raise_axes(struct graph_layout *l, struct graph_cell *cell)
{
    double air = 4 * graph_air(l->look), free = cell->plot.height;
    struct graph_legend legend = cell->legend;
    bool own = l->graph->panel_count > 1 && (!l->graph->share_y || cell->legend_outside); /* of this panel alone */
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

/* The words of all rulers stand in one kind of place: beside their lines, or in legends. */
static void move_words(struct graph_layout *l)
{
    for (size_t p = 0; p < l->graph->panel_count; p++) {
        for (size_t r = 0; r < l->cells[p].panel->ruler_count; r++) {
            if (l->cells[p].words[r].markup)
                l->cells[p].words[r].state = GRAPH_WORD_IN_LEGEND;
        }
    }
}

/* Places words and legend in a panel. *moved: something has to go outside. */
static enum bead_error furnish(struct graph_layout *l, struct graph_cell *cell, bool *moved, struct bead_message *msg)
{
    struct graph_mask mask;
    if (cell->panel->ruler_count == 0 && cell->legend.count == 0)
        return BEAD_OK;
    enum bead_error err = graph_mask_make(cell, l->look, &mask, msg);
    if (err)
        return err;
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
    double best = INFINITY;
    l->columns = l->graph->columns < count ? l->graph->columns : count;
    for (size_t columns = 1; l->graph->columns == 0 && columns <= count; columns++) {
        size_t rows = (count + columns - 1) / columns;
        double shape = l->width / (double)columns / (l->height / (double)rows);
        double badness = fabs(log(shape / wanted_shape)) + 1.5 * (double)(columns * rows - count) / (double)(columns * rows);
        if (badness < best) {
            best = badness;
            l->columns = columns;
        }
    }
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
    if (!err)
        measure_lines(layout);
    for (bool moved = true; !err && moved;) { /* ends, because every word and legend moves at most once */
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
