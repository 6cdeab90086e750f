/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a figure. Axes are measured by drawing them onto a recording surface; plots get the remaining room. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/layout.h"
#include "render/figure/figure.h"
#include "render/stage/along.h"
#include "render/view/orientation.h"

/* Lengths in units of the label's font size. */
static const double between_columns = 1.3, between_rows = 0.9, between_views = 0.55;
static const double bar_gap = 0.9, heading_gap = 0.45, line_gap = 0.7, trust_line = 2.1;
/* Part of the line of trust that holds text; the rest is the gap to the plot. */
static const double trust_share = 0.75;
/* A curve of this height has room for "force (N)" beside its axis in the usual size; but at most this part of an equal row's
 * height. Empirical, from a few stills with beads, a profile and an image, in the font of pictures: quantities with longer names,
 * or low pictures of many views, still have a smaller name there. */
static const double curve_height = 4.8, curve_share = 0.65;
static const int smallest_plot = 12; /* px */
enum { FAR = 8192 };                 /* px */

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

/* Stand-ins for ranges known only at the end: these largest values, and parts by which waves move a static force. Labels of smaller
 * waves have a digit more for each decade, and extend into the margin. */
enum { SIZES = 3, PARTS = 3 };
static const double axis_sizes[SIZES] = {888, 630, 310}, bar_sizes[SIZES] = {1, 9.9, 999}, moved[PARTS] = {.5, .05, .0005};

/* Returns their number; 1 if the scene gives the range. */
static size_t stand_ins(const struct bead_figure *f, bool given, const double sizes[SIZES], struct bead_colours ins[SIZES + PARTS])
{
    const double rest = bead_colour_range_rest(f->context.chains, f->context.chain_count, f->output->shown.field);
    size_t count = 0;
    for (int i = 0; i < SIZES; i++) {
        ins[i] = f->colours;
        if (given)
            return 1;
        ins[i].high = sizes[i];
        ins[i].low = ins[i].scale == BEAD_SCALE_LOG ? 1e-4 * sizes[i] : f->colours.low < 0 ? -sizes[i] : 0;
        count++;
    }
    for (int i = 0; rest > 0 && i < PARTS; i++)
        ins[count++] = (struct bead_colours){f->colours.map, BEAD_SCALE_LINEAR, (1 - moved[i]) * rest, (1 + moved[i]) * rest, rest};
    return count;
}

static enum bead_error figure_measure(const struct bead_figure *f, const struct bead_tile *panel, int width, int height,
                                      struct bead_insets *reach, struct bead_message *msg)
{
    const bool unknown = !bead_view_has(panel->type, BEAD_SHOWS_COLOURS) && isnan(f->output->colours.range[1]);
    struct bead_colours ins[SIZES + PARTS];
    const size_t count = stand_ins(f, !unknown, f->colours.scale == BEAD_SCALE_LOG ? bar_sizes : axis_sizes, ins);
    cairo_surface_t *surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cr = cairo_create(surface);
    enum bead_error err = BEAD_OK;
    for (size_t i = 0; !err && i < count; i++) {
        struct bead_view_setup setup = panel->setup;
        setup.colours = ins[i];
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
    *reach = (struct bead_insets){left, 0, right, 0};
    if (w > 0 && h > 0)
        *reach = (struct bead_insets){fmax(left, FAR - x), fmax(0, FAR - y), fmax(right, x + w - FAR - width),
                                      fmax(0, y + h - FAR - height)};
    return err;
}

static bool has_bar(const struct bead_figure *f)
{
    return f->coloured && f->output->views.axes && !f->set.no_bar;
}

static double bar_width(const struct bead_figure *f)
{
    return round(bead_colour_bar_width(&f->look, BEAD_BAR_OF_FIGURE));
}

/* A line of title and time, and below it rows of chains with their views; a bar at the right of all columns. */
struct plan {
    struct bead_figure *f;
    struct bead_layout_grid grid;
    double trust;     /* px: part of the heading's height */
    double bar_gap;   /* px: between the plots and the bar */
    double bar_least; /* px that panels leave at the right border for bars */
};

/* The greatest width of the bar's labels, for any range unless the scene gives one. */
static double bar_labels(const struct bead_figure *f, int height)
{
    struct bead_rect bar = {0, 0, (int)bead_colour_bar_width(&f->look, BEAD_BAR_OF_FIGURE), height};
    const struct bead_field_info *field = bead_chain_field(f->context.chains[0], f->output->shown.field);
    const bool given = !isnan(f->output->colours.range[0]) && !isnan(f->output->colours.range[1]);
    struct bead_colours ins[SIZES + PARTS];
    const size_t count = stand_ins(f, given, bar_sizes, ins);
    double widest = 0;
    char title[64];
    bead_figure_bar_title(f, title, sizeof title);
    for (size_t i = 0; i < count; i++)
        widest = fmax(widest, bead_colour_bar_draw(NULL, &f->look, &ins[i], field->unit, title, bar, true, true));
    return widest;
}

static enum bead_error too_small(void *plan, struct bead_message *msg)
{
    const struct bead_figure *f = ((const struct plan *)plan)->f;
    const struct bead_output *output = f->output;
    const size_t plots = f->cell_count * f->view_count;
    char size[BEAD_SIZE_WORDS];
    return bead_output_wrong(output, msg,
                             "size: %s leave no room for %zu plot%s and their labels; use a larger picture, fewer views or "
                             "`axes: false`",
                             bead_page_size(&f->page, size), plots, plots == 1 ? "" : "s");
}

/* The greatest height that a view can use, px; 0: any. */
static double figure_most_height(const struct bead_figure *f, double width, size_t view)
{
    double most = 0;
    const struct bead_view_type *type = f->cells[0].panel[view].type;
    for (size_t c = 0; f->view_count > 1 && type->most_height && c < f->cell_count; c++)
        most = fmax(most, type->most_height(&f->cells[c].panel[view].setup, (int)width));
    return most;
}

static void heights(void *user)
{
    struct plan *plan = user;
    const struct bead_figure *f = plan->f;
    struct bead_lane *rows = plan->grid.rows.lane;
    for (size_t i = 1; i < plan->grid.rows.count; i++)
        rows[i].most = figure_most_height(f, plan->grid.columns.lane[0].size, (i - 1) % f->view_count);
}

static void place_cell(const struct plan *plan, struct bead_cell *cell, const struct bead_layout_box *boxes)
{
    const struct bead_figure *f = plan->f;
    const struct bead_lane *top = &plan->grid.rows.lane[boxes->row];
    const struct bead_rect *first = &boxes->at;
    bool free = cell->column + 1 == f->columns && !(cell->row > 0 && has_bar(f)); /* to the border of the page */
    int width = free ? f->area.x + f->area.width - (int)f->margin - first->x : first->width, trust = (int)plan->trust;
    int y = (int)(top->at - top->reach[0]), above = first->y - trust;
    cell->heading = (struct bead_rect){first->x, y, first->width, above - y};
    cell->trust = (struct bead_rect){first->x, above, width, (int)round(trust_share * trust)};
    for (size_t v = 0; v < f->view_count; v++)
        cell->panel[v].plot = boxes[v].at;
}

static void place_all(const struct plan *plan)
{
    struct bead_figure *f = plan->f;
    const struct bead_lane *line = plan->grid.rows.lane, *lowest = line + plan->grid.rows.count - 1;
    const struct bead_lane *column = &plan->grid.columns.lane[f->columns - 1];
    const struct bead_rect *first = &plan->grid.boxes[0].at;
    int right = (int)(column->at + column->size), bottom = (int)(lowest->at + lowest->size);
    for (size_t c = 0; c < f->cell_count; c++)
        place_cell(plan, &f->cells[c], &plan->grid.boxes[c * f->view_count]);
    f->line = (struct bead_rect){first->x, (int)line->at, right - first->x, (int)line->size};
    f->bar = (struct bead_rect){0};
    if (has_bar(f))
        f->bar = (struct bead_rect){right + (int)plan->bar_gap, first->y, (int)fmax(4, bar_width(f)), bottom - first->y};
}

/* The labels of the last column are part of the gap between it and the bar, whose lowest one reaches below its end. */
static void measure_bar(struct plan *plan)
{
    struct bead_figure *f = plan->f;
    struct bead_lane *bar = &plan->grid.columns.lane[f->columns];
    if (!has_bar(f))
        return;
    double em = f->look.label, reach = 0;
    for (size_t i = 0; i < plan->grid.count; i++) {
        struct bead_layout_box *box = &plan->grid.boxes[i];
        reach = box->column + 1 == f->columns ? fmax(reach, ceil(box->reach.right)) : reach;
        box->reach.right = box->column + 1 == f->columns ? 0 : box->reach.right;
        box->reach.bottom = fmax(box->reach.bottom, box->row + 1 == plan->grid.rows.count ? 0.45 * f->look.tick : 0);
    }
    plan->bar_gap = fmax(reach + round(0.5 * em), round(bar_gap * em));
    bar->least = fmax(plan->bar_least, plan->bar_gap + bar_width(f) + ceil(bar_labels(f, f->bar.height)));
}

static enum bead_error measure_all(void *user, struct bead_message *msg)
{
    struct plan *plan = user;
    struct bead_figure *f = plan->f;
    place_all(plan);
    for (size_t i = 0; i < plan->grid.count; i++) {
        struct bead_layout_box *box = &plan->grid.boxes[i];
        BEAD_TRY(figure_measure(f, &f->tiles[i], box->at.width, box->at.height, &box->reach, msg));
    }
    measure_bar(plan);
    return BEAD_OK;
}

/* Arranges chains in columns and rows so that plots get the best shape; an empty quarter of the page is as bad as plots twice as
 * wide, or half as wide, as the best. That weight, 3 (`empty`), is a choice: from 2.6 to 3.2 pages of 2 to 7 chains in five styles
 * are full; with 2 three chains leave a quarter of a screen empty. */
static void figure_choose_columns(struct bead_figure *f)
{
    double em = f->look.label;
    f->columns = bead_layout_columns(
        f->cell_count, &(struct bead_layout_area){.width = f->area.width - 10 * em,
                                                  .height = f->area.height - 5 * em,
                                                  .around = {2 * em, 2.5 * em},
                                                  .shape = f->view_count > 1 ? 1.9 : f->cells[0].panel[0].type->info->shape,
                                                  .empty = 3});
    f->rows = (f->cell_count + f->columns - 1) / f->columns;
    for (size_t c = 0; c < f->cell_count; c++) {
        f->cells[c].column = c % f->columns;
        f->cells[c].row = c / f->columns;
    }
}

static bool same_beads(const struct bead_figure *f)
{
    bool same = true;
    for (size_t c = 1; c < f->cell_count; c++)
        same = same && bead_along_alike(&f->cells[0].panel[0].setup, &f->cells[c].panel[0].setup);
    return same;
}

/* The quantity along a panel's horizontal axis. */
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
            if (f->set.no_across && v + 1 == f->view_count)
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

/* The sizes of rows: the line above everything, then views; plots stay at least `least` away from the borders. */
static void want_rows(struct plan *plan, const struct bead_insets *least)
{
    const struct bead_figure *f = plan->f;
    struct bead_lane *rows = plan->grid.rows.lane;
    double em = f->look.label;
    bool headings = false;
    for (size_t c = 0; c < f->cell_count; c++)
        headings = headings || bead_figure_heading(f, &f->cells[c], NULL);
    const double curve = fmax(smallest_plot, fmin(curve_height * em, curve_share * f->area.height / (double)plan->grid.rows.count));
    double heading = plan->trust + (headings ? round(1.15 * f->look.title + heading_gap * em) : 0);
    rows[0].least = bead_figure_line(f, NULL) ? round(1.35 * f->look.title + line_gap * em) : 0;
    for (size_t i = 1; i < plan->grid.rows.count; i++) {
        size_t view = (i - 1) % f->view_count;
        double gap = view > 0 ? between_views : i > 1 ? between_rows : 0;
        rows[i] =
            (struct bead_lane){.gap = round(gap * em),
                               .keep = {view > 0 ? 0 : heading, 0},
                               .least = bead_view_has(f->cells[0].panel[view].type, BEAD_SHOWS_COLOURS) ? smallest_plot : curve,
                               .share = f->cells[0].panel[view].type->info->still_share};
    }
    rows[1].keep[0] = fmax(rows[1].keep[0], least->top);
    rows[plan->grid.rows.count - 1].keep[1] = least->bottom;
}

static void want_columns(struct plan *plan, const struct bead_insets *least)
{
    const struct bead_figure *f = plan->f;
    struct bead_lane *columns = plan->grid.columns.lane;
    double em = f->look.label;
    bead_lanes_want(columns, f->columns,
                    (struct bead_lane){.gap = round(between_columns * em), .least = smallest_plot, .share = 1});
    columns[0].keep[0] = least->left;
    columns[f->columns - 1].keep[1] = has_bar(f) ? 0 : least->right;
    plan->bar_least = least->right;
    for (size_t c = 0; c < f->columns; c++)
        columns[c].reach[0] = f->output->views.axes ? 4 * em : 0; /* a first guess */
}

/* Few beads, as large as their row allows, do not fill its width: then columns become as wide as their widest row of beads, so that
 * axes end where the beads do. True: they have become narrower. */
static bool narrow(struct plan *plan)
{
    struct bead_figure *f = plan->f;
    double most = 0;
    for (size_t t = 0; t < f->tile_count; t++) {
        const struct bead_layout_box *box = &plan->grid.boxes[t];
        if (f->view_count > 1 && f->tiles[t].type->most_width)
            most = fmax(most, f->tiles[t].type->most_width(&f->tiles[t].setup, box->at.height));
    }
    if (!(most > smallest_plot && most < plan->grid.columns.lane[0].size))
        return false;
    for (size_t c = 0; c < f->columns; c++)
        plan->grid.columns.lane[c].most = most;
    return true;
}

enum bead_error bead_figure_put(struct bead_figure *f, struct bead_rect area, const struct bead_insets *least,
                                struct bead_insets *insets, struct bead_message *msg)
{
    f->area = area;
    figure_choose_columns(f);
    share_axes(f);
    struct plan plan = {.f = f, .trust = f->output->shown.trust ? round(trust_line * f->look.label) : 0};
    struct bead_layout_grid *grid = &plan.grid;
    BEAD_TRY(bead_layout_make(f->columns + has_bar(f), 1 + f->rows * f->view_count, f->tile_count, grid, msg));
    for (size_t i = 0; i < grid->count; i++) {
        const struct bead_cell *cell = f->tiles[i].cell;
        grid->boxes[i].column = cell->column;
        grid->boxes[i].row = 1 + cell->row * f->view_count + i % f->view_count;
    }
    want_rows(&plan, least);
    want_columns(&plan, least);
    bead_lanes_within(&grid->columns, area.x + f->margin, area.width - 2 * f->margin);
    const double above = f->output->views.axes ? f->margin : 0;
    bead_lanes_within(&grid->rows, area.y + above, area.height - 2 * above);
    const struct bead_layout_owner owner = {&plan, heights, measure_all, too_small};
    enum bead_error err = bead_layout_settle(grid, 2, false, &owner, msg);
    if (!err && narrow(&plan))
        err = bead_layout_settle(grid, 2, false, &owner, msg);
    if (!err)
        place_all(&plan);
    *insets = bead_layout_insets(grid, area);
    bead_layout_free(grid);
    return err;
}
