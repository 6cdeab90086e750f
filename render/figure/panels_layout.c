/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of panels: each measures how far its axes extend beyond its plots; then the plots of a row get the same width and
 * height, and those of a column the same left border. */

#include "render/figure/panels_private.h"
#include "sim/kinds/output_kinds.h"

/* In units of the label's font size. */
static const double between_columns = 1.1, between_rows = 0.9;
static const int smallest = 24; /* px */

static size_t panels_columns(const struct bead_still *s, size_t row)
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
    if (panel->set.title && *panel->set.title && graph.panel_count == 1)
        panels[0].title = panel->set.title;
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

/* A bar is to the right of the last panel of its group in a row. */
static bool ends_group(const struct bead_still *s, const struct still_panel *panel)
{
    return !one_group(panel, panels_at(s, panel->row, panel->column + 1));
}

/* If the row above has the same bar in the same column, that bar extends down instead. */
static bool has_bar_of_above(const struct bead_still *s, const struct still_panel *panel)
{
    const struct still_panel *above = panel->row > 0 ? panels_at(s, panel->row - 1, panel->column) : NULL;
    return one_group(panel, above) && ends_group(s, panel) && ends_group(s, above) &&
           panels_columns(s, panel->row) == panels_columns(s, above->row);
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

/* Does the row below have the numbers of all axes of this row? They are in the same places, in all panels or in none. */
static bool numbers_below(const struct bead_still *s, size_t row)
{
    bool all = panels_columns(s, row) == panels_columns(s, row + 1);
    for (size_t p = 0; all && p < s->count; p++)
        all = s->panels[p].row != row || same_axis(&s->panels[p], panels_at(s, row + 1, s->panels[p].column), false);
    return all;
}

static void share(struct bead_still *s)
{
    panels_find_groups(s);
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        const struct still_panel *left = panel->column > 0 ? panels_at(s, panel->row, panel->column - 1) : NULL;
        panel->set.no_across = numbers_below(s, panel->row);
        panel->set.no_upwards = panel->figure && left && left->figure && same_axis(panel, left, true);
        panel->set.no_bar = panel->figure && (!ends_group(s, panel) || has_bar_of_above(s, panel));
        if (panel->figure)
            panel->figure->set = panel->set;
    }
}

/* ---- places ---- */

/* Before the run the ends of axes are unknown: assumes the widest numbers, of logarithmic axes, of those with a unit, of others. */
static const double widest[][2] = {{1, 1e3}, {0, 888}, {-0.9112, 0.0888}};

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
        const double *ends = widest[y->scale == BEAD_SCALE_LOG ? 0 : y->unit && *y->unit ? 1 : 2];
        y->low = isnan(y->low) ? ends[0] : y->low;
        y->high = isnan(y->high) ? ends[1] : y->high;
    }
    enum bead_error err = graph_layout_make(&graph, &s->look, panel->area.width, panel->area.height, &frame, &layout, &why);
    BEAD_TRY(bead_output_tell(panel->output, err, &why, msg));
    panel->insets = bead_layout_insets(&layout.grid, (struct bead_rect){0, 0, panel->area.width, panel->area.height});
    graph_layout_free(&layout);
    return BEAD_OK;
}

/* Lays panels out in their areas. `keep`: with their current insets; else the insets are measured. */
static enum bead_error panels_put(struct bead_still *s, bool keep, struct bead_message *msg)
{
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        struct bead_insets kept = keep ? panel->insets : (struct bead_insets){0};
        BEAD_TRY(panel->figure ? bead_figure_put(panel->figure, panel->area, &kept, &panel->insets, msg)
                               : put_plot(s, panel, &kept, msg));
        if (keep)
            panel->insets = kept;
    }
    return BEAD_OK;
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

/* Rows: the title, the rows of panels, the caption. Each row of panels has a line of columns; rows of equal length share the first
 * one's. */
static enum bead_error make_grid(struct bead_still *s, struct bead_message *msg)
{
    BEAD_TRY(bead_layout_make(s->count, s->rows + 2, s->count, &s->layout, msg));
    struct bead_lane *rows = s->layout.rows.lane;
    double em = s->look.label, margin = s->look.margin;
    rows[0].least = s->words.above;
    bead_lanes_want(rows + 1, s->rows, (struct bead_lane){.gap = round(between_rows * em), .least = smallest, .share = 1});
    rows[1 + s->rows].least = s->words.below;
    for (size_t p = 0; p < s->count; p++) {
        size_t row = s->panels[p].row, column = s->panels[p].column, like = 0;
        while (panels_columns(s, like) != panels_columns(s, row))
            like++;
        rows[1 + row].share = panels_weight_of(s, row);
        s->layout.columns.lane[p] =
            (struct bead_lane){.line = row, .gap = column > 0 ? round(between_columns * em) : 0, .least = smallest, .share = 1};
        s->layout.boxes[p] =
            (struct bead_layout_box){.column = (size_t)(panels_at(s, like, column) - s->panels),
                                     .row = 1 + row,
                                     .reach = {round(3 * em), round(1.5 * em), round(em), round(2 * em)}}; /* a guess */
    }
    bead_lanes_within(&s->layout.columns, margin, s->page.width - 2 * margin);
    bead_lanes_within(&s->layout.rows, margin, s->page.height - 2 * margin);
    bead_layout_reach(&s->layout, false);
    return BEAD_OK;
}

static void take_areas(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        const struct bead_layout_box *box = &s->layout.boxes[p];
        const struct bead_rect *plot = &box->at;
        const double *x = s->layout.columns.lane[box->column].reach, *y = s->layout.rows.lane[box->row].reach;
        s->panels[p].insets = (struct bead_insets){x[0], y[0], x[1], y[1]};
        s->panels[p].area = (struct bead_rect){plot->x - (int)x[0], plot->y - (int)y[0], plot->width + (int)(x[0] + x[1]),
                                               plot->height + (int)(y[0] + y[1])};
    }
}

static enum bead_error measure(void *still, struct bead_message *msg)
{
    struct bead_still *s = still;
    double left = 0; /* of the first panels, which begin below each other even if rows differ */
    take_areas(s);
    BEAD_TRY(panels_put(s, false, msg));
    for (size_t p = 0; p < s->count; p++)
        left = s->panels[p].column == 0 ? fmax(left, s->panels[p].insets.left) : left;
    for (size_t p = 0; p < s->count; p++) {
        s->layout.boxes[p].reach = s->panels[p].insets;
        s->layout.boxes[p].reach.left = s->panels[p].column == 0 ? left : s->panels[p].insets.left;
    }
    return BEAD_OK;
}

static enum bead_error no_room(void *still, struct bead_message *msg)
{
    const struct bead_still *s = still;
    char words[BEAD_SIZE_WORDS];
    return bead_output_wrong(s->output, msg, "size: %s leave no room for %zu panel%s and their labels",
                             bead_page_size(&s->page, words), s->count, s->count == 1 ? "" : "s");
}

/* A bar for several rows extends down to the last one. */
static void stretch_bars(struct bead_still *s)
{
    for (size_t p = 0; p < s->count; p++) {
        struct still_panel *panel = &s->panels[p];
        size_t row = panel->row;
        if (!panel->figure || panel->set.no_bar)
            continue;
        const struct still_panel *last = panel, *below;
        while ((below = panels_at(s, ++row, panel->column)) && has_bar_of_above(s, below))
            last = below;
        struct bead_rect *bar = &panel->figure->bar;
        if (last != panel && bar->width > 0)
            bar->height = last->area.y + last->area.height - (int)last->insets.bottom - bar->y;
    }
}

enum bead_error panels_arrange(struct bead_still *s, struct bead_message *msg)
{
    if (s->alone)
        return bead_figure_put(s->panels[0].figure, (struct bead_rect){0, 0, s->page.width, s->page.height},
                               &(struct bead_insets){0}, &s->panels[0].insets, msg);
    graph_page_measure(&s->words, &s->look, s->page.width, s->page.height);
    share(s);
    enum bead_error err = make_grid(s, msg);
    if (!err)
        err = bead_layout_settle(&s->layout, 3, false,
                                 &(struct bead_layout_owner){.user = s, .measure = measure, .no_room = no_room}, msg);
    if (!err) {
        take_areas(s);
        err = panels_put(s, true, msg);
        stretch_bars(s);
    }
    bead_layout_free(&s->layout);
    return err;
}
