/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a figure. Axes are measured by drawing them onto a recording surface; plots get the remaining room. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/figure/figure_private.h"
#include "render/view/orientation.h"

/* Lengths in units of the label's font size. */
static const double between_columns = 1.3, between_rows = 0.9, between_views = 0.55;
static const double bar_gap = 0.9, heading_gap = 0.45, line_gap = 0.7, trust_line = 2.1;
/* Part of the line of trust that holds text; the rest is the gap to the plot. */
static const double trust_share = 0.75;
static const int smallest_plot = 12; /* px */
enum { FAR = 8192 };                 /* px */

/* How far axes and labels reach out of a plot, px. */
struct reach {
    double left, top, right, bottom;
};

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static struct reach largest(struct reach a, struct reach b)
{
    return (struct reach){larger(a.left, b.left), larger(a.top, b.top), larger(a.right, b.right), larger(a.bottom, b.bottom)};
}

/* A temporary view draws its axes around a plot of this size, far from any border, onto a surface that only records extents. */
static enum bead_error draw_axes(const struct bead_tile *panel, const struct bead_view_setup *setup, cairo_t *cr, int width,
                                 int height, struct bead_message *msg)
{
    struct bead_view *view = NULL;
    enum bead_error err = panel->type->create(setup, &view, msg);
    if (!err)
        err = panel->type->place(view, (struct bead_rect){FAR, FAR, width, height}, NULL, msg);
    if (!err)
        err = panel->type->decorate(view, cr, msg);
    panel->type->destroy(view);
    return err;
}

/* Stand-ins for ranges that are known only at the end, with labels as wide as they can get. */
static const double ranges[] = {888, 630, 310};

static enum bead_error figure_measure(const struct bead_figure *f, const struct bead_tile *panel, int width, int height,
                                      struct reach *reach, struct bead_message *msg)
{
    bool unknown = !bead_view_has(panel->type, BEAD_SHOWS_COLOURS) && isnan(f->output->colours.range[1]);
    cairo_surface_t *surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cr = cairo_create(surface);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < (unknown ? sizeof ranges / sizeof ranges[0] : 1); i++) {
        struct bead_view_setup setup = panel->setup;
        if (unknown) {
            setup.colours.low *= ranges[i] / setup.colours.high;
            setup.colours.high = ranges[i];
        }
        err = draw_axes(panel, &setup, cr, width, height, msg);
    }
    double x, y, w, h;
    cairo_recording_surface_ink_extents(surface, &x, &y, &w, &h);
    if (!err && cairo_status(cr))
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "layout of a figure: %s", cairo_status_to_string(cairo_status(cr)));
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    int left = 0, right = 0;
    if (panel->type->margins && panel->setup.axes)
        panel->type->margins(panel->setup.look, &left, &right);
    *reach = (struct reach){left, 0, right, 0};
    if (w > 0 && h > 0)
        *reach = largest(*reach, (struct reach){FAR - x, FAR - y, x + w - FAR - width, y + h - FAR - height});
    return err;
}

static bool has_bar(const struct bead_figure *f)
{
    return f->coloured && f->output->views.axes && !f->set.no_bar;
}

/* All lengths of a layout, from which the plots follow. */
struct plan {
    double margin, trust;           /* trust: part of the heading's height */
    double *left, *right;           /* [columns] */
    struct bead_stack_reach *reach; /* [rows * views]: largest in each line of plots */
    double bar_room;                /* bar, gap and labels */
    struct bead_insets least;       /* of all plots together */
    int width;                      /* of plots */
    struct bead_stack stack;
};

static void free_plan(struct plan *plan)
{
    free(plan->left);
    free(plan->right);
    free(plan->reach);
}

static enum bead_error make_plan(const struct bead_figure *f, const struct bead_insets *least, struct plan *plan,
                                 struct bead_message *msg)
{
    double em = f->look.label;
    bool headings = false;
    for (size_t c = 0; c < f->cell_count; c++)
        headings = headings || bead_figure_heading(f, &f->cells[c], NULL);
    *plan = (struct plan){.margin = f->margin, .least = *least, .trust = f->output->shown.trust ? round(trust_line * em) : 0};
    plan->left = calloc(f->columns, sizeof *plan->left);
    plan->right = calloc(f->columns, sizeof *plan->right);
    plan->reach = calloc(f->rows * f->view_count, sizeof *plan->reach);
    plan->stack = (struct bead_stack){.rows = f->rows,
                                      .views = f->view_count,
                                      .heading = plan->trust + (headings ? round(1.15 * f->look.title + heading_gap * em) : 0),
                                      .between_rows = round(between_rows * em),
                                      .between_views = round(between_views * em),
                                      .reach = plan->reach};
    if (!plan->left || !plan->right || !plan->reach) {
        free_plan(plan);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the layout of a figure");
    }
    return BEAD_OK;
}

/* The greatest width of the bar's labels, for any range unless the scene gives it. */
static double bar_labels(const struct bead_figure *f, int height)
{
    struct bead_rect bar = {0, 0, (int)bead_colour_bar_width(&f->look, BEAD_BAR_OF_FIGURE), height};
    const struct bead_field_info *field = bead_chain_field(f->context.chains[0], f->output->shown.field);
    struct bead_colours colours = f->colours;
    double widest = 0;
    char title[64];
    bead_figure_bar_title(f, title, sizeof title);
    static const double sizes[] = {1, 9.9, 999};
    bool given = !isnan(f->output->colours.range[0]) && !isnan(f->output->colours.range[1]);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        if (!given) {
            colours.high = sizes[i];
            colours.low = colours.scale == BEAD_SCALE_LOG ? 1e-4 * sizes[i] : f->colours.low < 0 ? -sizes[i] : 0;
        }
        widest = larger(widest, bead_colour_bar_draw(NULL, &f->look, &colours, field->unit, title, bar, true, true));
    }
    return widest;
}

/* All that is not plots: margins, title, headings, axes. */
static double fixed_height(const struct bead_figure *f, const struct plan *plan)
{
    return 2 * plan->margin + f->line.height + bead_stack_fixed(&plan->stack);
}

static double fixed_width(const struct bead_figure *f, const struct plan *plan)
{
    double width = 2 * plan->margin + plan->bar_room + (double)(f->columns - 1) * round(between_columns * f->look.label);
    for (size_t c = 0; c < f->columns; c++)
        width += ceil(plan->left[c]) + (c + 1 == f->columns && has_bar(f) ? 0 : ceil(plan->right[c]));
    return width;
}

static enum bead_error too_small(const struct bead_figure *f, struct bead_message *msg)
{
    const struct bead_output *output = f->output;
    char size[BEAD_SIZE_WORDS];
    return bead_fail(msg, BEAD_ERROR_SCENE,
                     "%s:%zu:%zu: size: %s leave no room for %zu plots and their labels; use a larger picture, fewer views or "
                     "`axes: false`",
                     f->context.scene->file, output->place.line, output->place.column, bead_page_size(&f->page, size),
                     f->cell_count * f->view_count);
}

/* The greatest height that a view can use, px. */
static double figure_most_height(const struct bead_figure *f, const struct plan *plan, size_t view)
{
    double most = 0;
    const struct bead_view_type *type = f->cells[0].panel[view].type;
    if (f->view_count == 1 || !type->most_height)
        return INFINITY;
    for (size_t c = 0; c < f->cell_count; c++)
        most = larger(most, type->most_height(&f->cells[c].panel[view].setup, plan->width));
    return most;
}

/* Divides the remaining room among the plots. Rows of beads leave what they cannot use to the other views. */
static enum bead_error figure_divide(const struct bead_figure *f, struct plan *plan, struct bead_message *msg)
{
    plan->width = (int)floor((f->area.width - fixed_width(f, plan)) / (double)f->columns);
    if (plan->width < smallest_plot)
        return too_small(f, msg);
    for (size_t v = 0; v < f->view_count; v++) {
        plan->stack.share[v] = f->cells[0].panel[v].type->info->still_share;
        plan->stack.most[v] = figure_most_height(f, plan, v);
    }
    bead_stack_divide(&plan->stack, (f->area.height - fixed_height(f, plan)) / (double)f->rows);
    for (size_t v = 0; v < f->view_count; v++) {
        if (plan->stack.height[v] < smallest_plot)
            return too_small(f, msg);
    }
    return BEAD_OK;
}

static void keep_least(const struct bead_figure *f, struct plan *plan)
{
    struct bead_stack_reach *first = &plan->reach[0], *last = &plan->reach[f->rows * f->view_count - 1];
    double *right = &plan->right[f->columns - 1];
    plan->left[0] = larger(plan->left[0], plan->least.left);
    first->above = larger(first->above, plan->least.top);
    last->below = larger(last->below, plan->least.bottom);
    if (!has_bar(f))
        *right = larger(*right, plan->least.right);
}

static enum bead_error measure_all(const struct bead_figure *f, struct plan *plan, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    memset(plan->left, 0, f->columns * sizeof *plan->left);
    memset(plan->right, 0, f->columns * sizeof *plan->right);
    memset(plan->reach, 0, f->rows * f->view_count * sizeof *plan->reach);
    for (size_t c = 0; c < f->cell_count; c++) {
        const struct bead_cell *cell = &f->cells[c];
        for (size_t v = 0; !err && v < f->view_count; v++) {
            struct bead_stack_reach *row = &plan->reach[cell->row * f->view_count + v];
            struct reach reach;
            err = figure_measure(f, &cell->panel[v], plan->width, plan->stack.height[v], &reach, msg);
            plan->left[cell->column] = larger(plan->left[cell->column], reach.left);
            plan->right[cell->column] = larger(plan->right[cell->column], reach.right);
            *row = (struct bead_stack_reach){larger(row->above, reach.top), larger(row->below, reach.bottom)};
        }
    }
    keep_least(f, plan);
    return err;
}

static void put_cell(const struct bead_figure *f, const struct plan *plan, const struct bead_stack_places *places,
                     struct bead_cell *cell)
{
    bool last = cell->column + 1 == f->columns; /* to the border of the page */
    int width = last ? f->area.x + f->area.width - (int)plan->margin - cell->heading.x : cell->heading.width;
    int trust = (int)plan->trust, above = places->plot[0] - trust;
    for (size_t v = 0; v < f->view_count; v++) {
        cell->panel[v].plot.y = places->plot[v];
        cell->panel[v].plot.height = plan->stack.height[v];
    }
    cell->heading.y = places->heading;
    cell->heading.height = above - places->heading;
    cell->trust = (struct bead_rect){cell->heading.x, above, width, (int)round(trust_share * trust)};
}

static void figure_put_rows(struct bead_figure *f, const struct plan *plan, int *bottom)
{
    double y = f->area.y + plan->margin + f->line.height;
    for (size_t r = 0; r < f->rows; r++) {
        struct bead_stack_places places;
        y = bead_stack_row(&plan->stack, r, y, &places) + plan->stack.between_rows;
        for (size_t c = 0; c < f->cell_count; c++) {
            if (f->cells[c].row == r)
                put_cell(f, plan, &places, &f->cells[c]);
        }
        *bottom = places.plot[f->view_count - 1] + plan->stack.height[f->view_count - 1];
    }
}

static void figure_put_columns(struct bead_figure *f, const struct plan *plan, int *right)
{
    double x = f->area.x + plan->margin;
    for (size_t k = 0; k < f->columns; k++) {
        x += ceil(plan->left[k]) + (k > 0 ? round(between_columns * f->look.label) : 0);
        for (size_t c = 0; c < f->cell_count; c++) {
            struct bead_cell *cell = &f->cells[c];
            if (cell->column != k)
                continue;
            cell->heading.x = (int)x;
            cell->heading.width = plan->width;
            for (size_t v = 0; v < f->view_count; v++) {
                cell->panel[v].plot.x = (int)x;
                cell->panel[v].plot.width = plan->width;
            }
        }
        *right = (int)x + plan->width;
        x += plan->width + ceil(plan->right[k]);
    }
}

static void put_everything(struct bead_figure *f, const struct plan *plan)
{
    int right = 0, bottom = 0;
    figure_put_columns(f, plan, &right);
    figure_put_rows(f, plan, &bottom);
    f->line.x = f->cells[0].heading.x;
    f->line.y = f->area.y + (int)plan->margin;
    f->line.width = right - f->line.x;
    f->bar = (struct bead_rect){0};
    if (!has_bar(f))
        return;
    double em = f->look.label, reach = plan->right[f->columns - 1];
    int width = (int)fmax(4, round(bead_colour_bar_width(&f->look, BEAD_BAR_OF_FIGURE)));
    int top = f->cells[0].panel[0].plot.y;
    f->bar = (struct bead_rect){right + (int)fmax(ceil(reach) + round(0.3 * em), round(bar_gap * em)), top, width, bottom - top};
}

/* Of the bar beside all rows. */
static int bar_height(struct bead_figure *f, const struct plan *plan)
{
    put_everything(f, plan);
    return f->bar.height;
}

/* Two passes: the room for axes depends on the size of plots, and the reverse. */
static enum bead_error figure_settle(struct bead_figure *f, struct plan *plan, struct bead_message *msg)
{
    double em = f->look.label;
    for (size_t c = 0; c < f->columns; c++)
        plan->left[c] = f->output->views.axes ? 4 * em : 0;
    enum bead_error err = figure_divide(f, plan, msg);
    for (int pass = 0; !err && pass < 2; pass++) {
        err = measure_all(f, plan, msg);
        if (!err && has_bar(f)) {
            double reach = plan->right[f->columns - 1], gap = fmax(ceil(reach) + round(0.3 * em), round(bar_gap * em));
            double width = round(bead_colour_bar_width(&f->look, BEAD_BAR_OF_FIGURE));
            plan->bar_room = larger(plan->least.right, gap + width + ceil(bar_labels(f, bar_height(f, plan))));
        }
        if (!err)
            err = figure_divide(f, plan, msg);
    }
    return err;
}

/* Arranges chains in columns and rows so that plots get the best shape. */
static void figure_choose_columns(struct bead_figure *f)
{
    double em = f->look.label, best = INFINITY, wanted = f->view_count > 1 ? 1.9 : f->cells[0].panel[0].type->info->shape;
    for (size_t columns = 1; columns <= f->cell_count; columns++) {
        size_t rows = (f->cell_count + columns - 1) / columns;
        double width = (f->area.width - 10 * em) / (double)columns - 2 * em;
        double height = (f->area.height - 5 * em) / (double)rows - 2.5 * em;
        double empty = (double)(columns * rows - f->cell_count) / (double)(columns * rows);
        double badness = width > 0 && height > 0 ? fabs(log(width / height / wanted)) + 2 * empty : 1e6 + (double)columns;
        if (badness < best) {
            best = badness;
            f->columns = columns;
            f->rows = rows;
        }
    }
    for (size_t c = 0; c < f->cell_count; c++) {
        f->cells[c].column = c % f->columns;
        f->cells[c].row = c / f->columns;
    }
}

static bool same_beads(const struct bead_figure *f)
{
    const struct bead_span *first = &f->cells[0].panel[0].setup.beads;
    for (size_t c = 1; c < f->cell_count; c++) {
        const struct bead_span *span = &f->cells[c].panel[0].setup.beads;
        if (span->first != first->first || span->last != first->last)
            return false;
    }
    return true;
}

/* What a panel's horizontal axis counts. */
static enum bead_view_across across(const struct bead_tile *panel)
{
    return bead_orientation_across(panel->setup.orientation, panel->type->info);
}

/* An axis is labelled unless the plot below, or to the left, labels the same axis. */
static void share_axes(struct bead_figure *f)
{
    bool same = same_beads(f);
    for (size_t c = 0; c < f->cell_count; c++) {
        struct bead_cell *cell = &f->cells[c];
        bool lowest = c + f->columns >= f->cell_count;
        for (size_t v = 0; v < f->view_count; v++) {
            struct bead_tile *panel = &cell->panel[v];
            bool beads = across(panel) == BEAD_ACROSS_CHAIN, last = v + 1 == f->view_count || across(panel + 1) != across(panel);
            bool lowest_of_all = lowest || f->view_count > 1;
            panel->setup.time_shared = !beads && !(last && lowest_of_all);
            panel->setup.bead_labels = beads ? last && (lowest || !same) : cell->column == 0 || !same;
            if (f->set.no_across && last && v + 1 == f->view_count)
                *(beads ? &panel->setup.bead_labels : &panel->setup.time_shared) = !beads;
            if (f->set.no_upwards && bead_view_has(panel->type, BEAD_SHOWS_IMAGE))
                *(beads ? &panel->setup.time_shared : &panel->setup.bead_labels) = beads;
            if (!beads && bead_view_has(panel->type, BEAD_SHOWS_IMAGE))
                panel->setup.ticks_only = !panel->setup.bead_labels;
        }
    }
}

struct bead_axis_kind bead_figure_axis(const struct bead_figure *f, bool upright)
{
    const struct bead_tile *tile = &f->cells[0].panel[f->view_count - 1];
    bool beads = (across(tile) == BEAD_ACROSS_CHAIN) != upright, contacts = bead_field_info(f->output->shown.field)->of_contacts;
    const struct bead_span *span = &tile->setup.beads;
    if ((beads && !same_beads(f)) || (upright && (f->view_count > 1 || !bead_view_has(tile->type, BEAD_SHOWS_IMAGE))))
        return (struct bead_axis_kind){NULL, 0, 0};
    if (beads)
        return (struct bead_axis_kind){contacts ? "contact" : "bead", (double)span->first, (double)span->last};
    return (struct bead_axis_kind){"time", f->time[0], f->time[1]};
}

enum bead_error bead_figure_put(struct bead_figure *f, struct bead_rect area, const struct bead_insets *least,
                                struct bead_insets *insets, struct bead_message *msg)
{
    f->area = area;
    enum bead_error err = bead_figure_arrange(f, least, msg);
    int right = 0, bottom = 0;
    for (size_t c = 0; !err && c < f->cell_count; c++) {
        const struct bead_rect *plot = &f->cells[c].panel[f->view_count - 1].plot;
        right = right > plot->x + plot->width ? right : plot->x + plot->width;
        bottom = bottom > plot->y + plot->height ? bottom : plot->y + plot->height;
    }
    const struct bead_rect *first = &f->cells[0].panel[0].plot;
    *insets =
        (struct bead_insets){first->x - area.x, first->y - area.y, area.x + area.width - right, area.y + area.height - bottom};
    return err;
}

void bead_figure_stretch_bar(struct bead_figure *f, int bottom)
{
    if (f->bar.width > 0)
        f->bar.height = bottom - f->bar.y;
}

enum bead_error bead_figure_arrange(struct bead_figure *f, const struct bead_insets *least, struct bead_message *msg)
{
    struct plan plan;
    figure_choose_columns(f);
    share_axes(f);
    f->line = (struct bead_rect){0};
    if (bead_figure_line(f, NULL))
        f->line.height = (int)round(1.35 * f->look.title + line_gap * f->look.label);
    enum bead_error err = make_plan(f, least, &plan, msg);
    if (err)
        return err;
    err = figure_settle(f, &plan, msg);
    if (!err)
        put_everything(f, &plan);
    free_plan(&plan);
    return err;
}
