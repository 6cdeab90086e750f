/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of panels: every panel says how far its axes reach out of its plots; then the plots of a row get one width and height,
 * and those of a column one left border. */
#include <math.h>
#include <string.h>

#include "render/figure/panels_private.h"

/* In units of the label's font size. */
static const double between_columns = 1.1, between_rows = 0.9, title_gap = 0.7, caption_gap = 0.5;

size_t panels_columns(const struct bead_still *s, size_t row)
{
    size_t columns = 0;
    for (size_t p = 0; p < s->count; p++)
        columns += s->panels[p].row == row;
    return columns;
}

struct still_panel *panels_at(const struct bead_still *s, size_t row, size_t column)
{
    for (size_t p = 0; p < s->count; p++) {
        if (s->panels[p].row == row && s->panels[p].column == column)
            return &s->panels[p];
    }
    return NULL;
}

struct bead_graph panel_graph(const struct still_panel *panel, struct bead_panel *panels)
{
    struct bead_graph graph = {.panels = panels, .share_x = true, .share_y = true};
    const struct bead_panel *own = bead_plot_data_panels(panel->plot, &graph.panel_count);
    graph.panel_count = graph.panel_count < PANEL_PLOTS ? graph.panel_count : PANEL_PLOTS;
    memcpy(panels, own, graph.panel_count * sizeof *panels);
    if (*panel->title && graph.panel_count == 1)
        panels[0].title = panel->title;
    else if (*panel->title)
        graph.title = NULL;
    return graph;
}

/* ---- what is shared ---- */

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static const char *map_of(const struct bead_output *output)
{
    return output->colours.colormap ? output->colours.colormap : "auto";
}

static bool same_colours(const struct bead_output *a, const struct bead_output *b)
{
    return a->shown.field == b->shown.field && a->colours.scale == b->colours.scale && a->image.sampling == b->image.sampling &&
           strcmp(map_of(a), map_of(b)) == 0 && same_number(a->colours.range[0], b->colours.range[0]) &&
           same_number(a->colours.range[1], b->colours.range[1]);
}

static void panels_find_groups(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        s->panels[p].group = p;
        for (size_t q = 0; s->panels[p].figure && q < p; q++) {
            if (s->panels[q].figure && same_colours(s->panels[p].output, s->panels[q].output)) {
                s->panels[p].group = s->panels[q].group;
                break;
            }
        }
    }
}

static bool one_group(const struct still_panel *a, const struct still_panel *b)
{
    return a && b && a->figure && b->figure && a->group == b->group;
}

/* A bar stands to the right of the last panel of its group in a row. If the row above has the same bar in the same column, that bar
 * extends down instead. */
static bool has_own_bar(const struct bead_still *s, const struct still_panel *panel)
{
    const struct still_panel *above = panel->row > 0 ? panels_at(s, panel->row - 1, panel->column) : NULL;
    bool last = !one_group(panel, panels_at(s, panel->row, panel->column + 1));
    bool above_last = above && !one_group(above, panels_at(s, above->row, above->column + 1));
    bool aligned = above && panels_columns(s, panel->row) == panels_columns(s, above->row);
    return last && !(aligned && above_last && one_group(panel, above));
}

static struct bead_axis_kind axis_of(const struct still_panel *panel, bool upright)
{
    struct bead_axis_kind none = {NULL, 0, 0};
    if (panel->figure)
        return bead_figure_axis(panel->figure, upright);
    size_t count;
    const struct bead_panel *plots = bead_plot_data_panels(panel->plot, &count);
    return upright ? none : (struct bead_axis_kind){plots[0].x.title, plots[0].x.low, plots[0].x.high};
}

static bool same_axis(const struct still_panel *a, const struct still_panel *b, bool upright)
{
    if (!a || !b)
        return false;
    struct bead_axis_kind x = axis_of(a, upright), y = axis_of(b, upright);
    return x.title && y.title && strcmp(x.title, y.title) == 0 && x.low == y.low && x.high == y.high;
}

static void share(struct bead_still *s)
{
    panels_find_groups(s);
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        const struct still_panel *below = panels_at(s, panel->row + 1, panel->column);
        const struct still_panel *left = panel->column > 0 ? panels_at(s, panel->row, panel->column - 1) : NULL;
        bool aligned = below && panels_columns(s, panel->row) == panels_columns(s, panel->row + 1);
        panel->set.no_across = aligned && same_axis(panel, below, false);
        panel->set.no_upwards = panel->figure && left && left->figure && same_axis(panel, left, true);
        panel->set.no_bar = panel->figure && !has_own_bar(s, panel);
        if (panel->figure)
            bead_figure_change(panel->figure, &panel->set);
    }
}

/* ---- places ---- */

/* Before the run the ends of axes are unknown: assumes the widest numbers. */
static enum bead_error put_plot(struct bead_still *s, struct still_panel *panel, const struct bead_insets *least,
                                struct bead_message *msg)
{
    struct bead_panel plots[PANEL_PLOTS];
    struct bead_graph graph = panel_graph(panel, plots);
    struct graph_frame frame = {.least = *least, .letter = panel->set.letter, .no_across = panel->set.no_across};
    struct graph_layout layout;
    struct bead_message why = {""};
    for (size_t i = 0; i < graph.panel_count; i++) {
        struct bead_graph_axis *y = &plots[i].y;
        y->high = isnan(y->high) ? (y->scale == BEAD_SCALE_LOG ? 1e3 : y->unit && *y->unit ? 888 : 0.0888) : y->high;
        y->low = isnan(y->low) ? (y->scale == BEAD_SCALE_LOG ? 1 : fmin(0, y->high - 1)) : y->low;
    }
    enum bead_error err = graph_layout_make(&graph, &s->look, panel->area.width, panel->area.height, &frame, &layout, &why);
    if (err)
        return bead_fail(msg, err, "%s:%zu:%zu: %.600s", s->context.scene->file, panel->output->place.line,
                         panel->output->place.column, why.text);
    double right = 0, bottom = 0;
    for (size_t i = 0; i < graph.panel_count; i++) {
        right = fmax(right, layout.cells[i].plot.x + layout.cells[i].plot.width);
        bottom = fmax(bottom, layout.cells[i].plot.y + layout.cells[i].plot.height);
    }
    const struct bead_rect *first = &layout.cells[0].plot;
    panel->insets = (struct bead_insets){first->x, first->y, panel->area.width - right, panel->area.height - bottom};
    graph_layout_free(&layout);
    return BEAD_OK;
}

/* Lays panels out in their areas. `keep`: with their present insets; else the insets are measured. */
static enum bead_error panels_put(struct bead_still *s, bool keep, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    for (size_t p = 0; !err && p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        struct bead_insets kept = keep ? panel->insets : (struct bead_insets){0};
        err = panel->figure ? bead_figure_put(panel->figure, panel->area, &kept, &panel->insets, msg)
                            : put_plot(s, panel, &kept, msg);
        if (keep)
            panel->insets = kept;
    }
    return err;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Gives panels of one row equal insets above and below; the first and last panels, and columns of rows of equal length, equal
 * insets left and right. */
static void align(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        for (size_t q = 0; q < s->count; q++) {
            struct still_panel *a = &s->panels[p], *b = &s->panels[q];
            bool alike = panels_columns(s, a->row) == panels_columns(s, b->row);
            if (a->row == b->row) {
                a->insets.top = b->insets.top = larger(a->insets.top, b->insets.top);
                a->insets.bottom = b->insets.bottom = larger(a->insets.bottom, b->insets.bottom);
            }
            if (a->column == b->column && (alike || a->column == 0))
                a->insets.left = b->insets.left = larger(a->insets.left, b->insets.left);
            if (a->column == b->column && alike)
                a->insets.right = b->insets.right = larger(a->insets.right, b->insets.right);
        }
    }
}

static struct bead_rect panels_room_of(const struct bead_still *s)
{
    double em = s->look.label, margin = s->look.margin;
    double above = s->title ? ceil(s->title_height + title_gap * em) : 0;
    double below = s->caption ? ceil(s->caption_height + caption_gap * em) : 0;
    return (struct bead_rect){(int)margin, (int)(margin + above), (int)(s->page.width - 2 * margin),
                              (int)(s->page.height - 2 * margin - above - below)};
}

/* Heights of rows: plots take less than images, several views more. */
static double panels_weight_of(const struct bead_still *s, size_t row)
{
    double weight = 0;
    for (size_t p = 0; p < s->count; p++) {
        const struct still_panel *panel = &s->panels[p];
        if (panel->row == row)
            weight = fmax(weight, panel->plot ? 0.85 : 0.7 + 0.3 * (double)panel->output->views.count);
    }
    return weight;
}

/* Divides the page into rows and columns and sets each panel's area. */
static enum bead_error panels_divide(struct bead_still *s, struct bead_message *msg)
{
    static const int smallest = 24; /* px */
    double em = s->look.label, weights = 0;
    struct bead_rect room = panels_room_of(s);
    double high = room.height - (double)(s->rows - 1) * round(between_rows * em), y = room.y;
    for (size_t r = 0; r < s->rows; r++) {
        const struct bead_insets *first = &panels_at(s, r, 0)->insets;
        weights += panels_weight_of(s, r);
        high -= first->top + first->bottom;
    }
    for (size_t r = 0; r < s->rows; r++) {
        size_t columns = panels_columns(s, r);
        double wide = room.width - (double)(columns - 1) * round(between_columns * em), x = room.x;
        double height = floor(high * panels_weight_of(s, r) / weights);
        for (size_t c = 0; c < columns; c++)
            wide -= panels_at(s, r, c)->insets.left + panels_at(s, r, c)->insets.right;
        double width = floor(wide / (double)columns);
        char words[BEAD_SIZE_WORDS];
        if (width < smallest || height < smallest)
            return bead_fail(msg, BEAD_ERROR_SCENE, "%s:%zu:%zu: size: %s leave no room for %zu panels and their labels",
                             s->context.scene->file, s->output->place.line, s->output->place.column,
                             bead_page_size(&s->page, words), s->count);
        for (size_t c = 0; c < columns; c++) {
            struct still_panel *panel = panels_at(s, r, c);
            const struct bead_insets *in = &panel->insets;
            panel->area =
                (struct bead_rect){(int)x, (int)y, (int)(in->left + width + in->right), (int)(in->top + height + in->bottom)};
            x += in->left + width + in->right + round(between_columns * em);
        }
        const struct bead_insets *first = &panels_at(s, r, 0)->insets;
        y += first->top + height + first->bottom + round(between_rows * em);
    }
    return BEAD_OK;
}

static void guess(struct bead_still *s)
{
    double em = s->look.label;
    for (size_t p = 0; p < s->count; p++)
        s->panels[p].insets = (struct bead_insets){round(3 * em), round(1.5 * em), round(em), round(2 * em)};
}

/* A bar for several rows extends down to the last one. */
static void stretch_bars(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        size_t row = panel->row;
        if (!panel->figure || panel->set.no_bar)
            continue;
        const struct still_panel *last = panel;
        for (const struct still_panel *below; (below = panels_at(s, ++row, panel->column)) != NULL; last = below) {
            if (!one_group(panel, below) || one_group(below, panels_at(s, row, panel->column + 1)) || !below->set.no_bar)
                break;
        }
        if (last != panel)
            bead_figure_stretch_bar(panel->figure, last->area.y + last->area.height - (int)last->insets.bottom);
    }
}

static void round_up(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        struct bead_insets *in = &s->panels[p].insets;
        *in = (struct bead_insets){ceil(in->left), ceil(in->top), ceil(in->right), ceil(in->bottom)};
    }
}

enum bead_error panels_arrange(struct bead_still *s, struct bead_message *msg)
{
    struct bead_text_style style = graph_text(&s->look);
    double wrap = s->page.width - 2 * s->look.margin, width;
    if (s->caption)
        bead_text_size_lines(NULL, &style, wrap, s->caption, &width, &s->caption_height);
    style.size = graph_title_size(&s->look);
    style.bold = true;
    if (s->title)
        bead_text_size_lines(NULL, &style, wrap, s->title, &width, &s->title_height);
    share(s);
    guess(s);
    enum bead_error err = panels_divide(s, msg);
    for (int pass = 0; !err && pass < 3; pass++) {
        err = panels_put(s, false, msg);
        align(s);
        round_up(s);
        if (!err)
            err = panels_divide(s, msg);
    }
    if (!err)
        err = panels_put(s, true, msg);
    stretch_bars(s);
    return err;
}
