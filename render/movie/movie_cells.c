/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a movie's frame as a grid: columns of plots, a stack of views in each row. Images get their share first. */
#include "render/movie/movie_cells.h"

/* In units of the label's font size. */
static const double title_line = 1.35, between_columns = 1.2, between_numbers = 0.5, between_rows = 0.9;
/* The part of the whole height that an overlaid profile has, and the least, with titles and without. */
static const double overlay_part = 0.3, overlay_least[] = {1.6, 3.4};
/* An overlaid profile takes the room that no cell can use: any share far below theirs will do. */
static const double last_share = 1e-6;
/* Part of a cell's width for images to the right of other views. */
static const double images_part = 0.64;
/* Part of the margin that numbers may take. */
static const double edge = 0.5;
/* Images have a share for at most this many chains. */
enum { PROMISED = 4 };

/* share, with what rounding to pixels takes; roomy; images, values, headings, titles, facts, axes, words; gaps between views, rows;
 * headings; least of beads, images, others; least px */
const struct bead_level bead_levels[BEAD_LEVELS] = {
    {0.354, true, true, true, true, true, true, true, true, 0.3, 0.9, 1.5, {1.5, 3, 3.2}, 12},
    {0.254, true, true, true, true, true, true, true, true, 0.3, 0.9, 1.5, {1.5, 3, 3.2}, 12},
    {0.154, false, true, true, true, true, true, true, true, 0.3, 0.54, 1.25, {0.9, 3, 2.6}, 12},
    {0, false, true, true, true, true, true, true, true, 0.3, 0.54, 1.25, {0.9, 3, 2.6}, 12},
    {0, false, false, true, true, true, true, true, true, 0.3, 0.54, 1.25, {0.9, 3, 2.6}, 12},
    {0, false, false, true, true, true, true, true, true, 0.3, 0.54, 1.25, {0}, 8},
    {0, false, false, true, true, false, false, true, true, 0.5, 0.54, 1.25, {0}, 8},
    {0, false, false, false, false, false, false, true, true, 0.5, 0.54, 1.25, {0}, 8},
    {0, false, false, false, false, false, false, false, true, 0.5, 0.54, 1.25, {0}, 8},
    {0, false, false, false, false, false, false, false, false, 0, 0, 1.25, {0}, 1},
};

/* The views of one column of plots. */
struct column {
    size_t view[BEAD_MOST_VIEWS], count;
    bool right; /* half of the cells */
};

static bool has(const struct bead_cells *c, size_t view, unsigned trait)
{
    return bead_view_has(c->wants->views[view], trait);
}

static bool moves(const struct bead_cells *c, size_t view)
{
    return c->wants->follow && has(c, view, BEAD_FOLLOWS_FRONT);
}

static bool along_chain(const struct bead_cells *c, size_t view)
{
    return bead_movie_across(c->wants, view) == BEAD_ACROSS_CHAIN;
}

size_t bead_cells_overlay(const struct bead_cells *c)
{
    for (size_t v = 0; c->layout == BEAD_LAYOUT_OVERLAY && v < c->wants->view_count; v++) {
        if (has(c, v, BEAD_OVERLAYS))
            return v;
    }
    return c->wants->view_count;
}

/* Images give way, unless there is nothing else. */
static bool left_out(const struct bead_cells *c, size_t view)
{
    size_t others = 0;
    for (size_t v = 0; v < c->wants->view_count; v++)
        others += !has(c, v, BEAD_SHOWS_IMAGE);
    return !c->level->images && others > 0 && has(c, view, BEAD_SHOWS_IMAGE);
}

/* Plots side by side in a cell. */
static size_t halves(const struct bead_cells *c)
{
    return c->layout == BEAD_LAYOUT_BESIDE && c->level->images ? 2 : 1;
}

static struct column column_of(const struct bead_cells *c, size_t half)
{
    struct column column = {.right = half == 1};
    size_t overlay = bead_cells_overlay(c);
    for (size_t v = 0; v < c->wants->view_count; v++) {
        bool right = halves(c) == 2 && has(c, v, BEAD_SHOWS_IMAGE);
        if (v != overlay && right == (half == 1) && !left_out(c, v))
            column.view[column.count++] = v;
    }
    return column;
}

/* ---- across ---- */

/* Columns of plots whose vertical axes are labelled: all chains have the same values, so the first of a kind is enough. */
static bool labelled_column(const struct bead_cells *c, size_t plot)
{
    return c->axes && c->level->values && plot < halves(c);
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* Room within the panels beside the beads: for a striker that flies back, the wall, or a last bead that flies on. */
static void choose_beyond(struct bead_cells *c, double width)
{
    const struct bead_movie_wants *w = c->wants;
    double em = w->look->tick, pitch = width / (double)w->beads;
    bool beads = false;
    for (size_t v = 0; v < w->view_count; v++)
        beads = beads || has(c, v, BEAD_SHOWS_BEADS);
    c->beyond[0] = c->beyond[1] = 0;
    if (!c->axes || !beads || w->follow)
        return;
    double right = clamp(0.7 * pitch, w->wall ? 0.6 * em : 0.3 * em, 1.6 * em);
    c->beyond[0] = bead_cells_whole(w->striker ? clamp(1.6 * pitch, 0.9 * em, 2.6 * em) : clamp(0.7 * pitch, 0.3 * em, 1.6 * em));
    c->beyond[1] = bead_cells_whole(w->wall ? fmax(right, fmax(4, w->look->gap)) : right);
}

/* px by which numbers extend beyond the left or the right of a plot: times on both sides, places along the chain on the right. */
static double number_ends(const struct bead_cells *c, size_t plot, bool right)
{
    struct column column = column_of(c, plot % halves(c));
    double along = right ? fmax(0, c->wants->along_end - c->beyond[1]) : 0,
           most = bead_cells_overlay(c) < c->wants->view_count ? along : 0;
    for (size_t i = 0; i < column.count; i++) {
        const enum bead_view_across across = bead_movie_across(c->wants, column.view[i]);
        most = fmax(most, across == BEAD_ACROSS_TIME ? c->wants->time_end : across == BEAD_ACROSS_CHAIN ? along : 0);
    }
    return c->axes ? most : 0;
}

/* Room left of a plot, for labels; the first also has the frame's margin. */
static int room_left(const struct bead_cells *c, size_t plot)
{
    double ends = number_ends(c, plot, false) - (plot == 0 ? c->wants->look->gap : 0);
    return bead_cells_whole(fmax(labelled_column(c, plot) ? c->wants->left : 0, ends));
}

/* Room right of a plot, before that of the next; the last has the margin, which may be too small for its numbers. */
static int room_right(const struct bead_cells *c, size_t plot)
{
    double ends = number_ends(c, plot, true), em = c->wants->look->tick;
    if (plot + 1 == c->columns * halves(c))
        return bead_cells_whole(fmax(0, ends - edge * c->wants->look->gap));
    return c->level->words ? bead_cells_whole(fmax(between_columns * em, ends > 0 ? ends + between_numbers * em : 0)) : 0;
}

/* Widths of plots; false: too narrow. */
static bool divide_across(struct bead_cells *c)
{
    struct bead_lanes *columns = &c->grid->columns;
    size_t plots = columns->count = c->columns * halves(c);
    double least = !c->level->words ? 1 : plots > 1 ? fmax(60, 5 * c->wants->look->label) : 60;
    bead_lanes_within(columns, c->area.x, c->area.width);
    choose_beyond(c, c->area.width / (double)plots);
    for (size_t p = 0; p < plots; p++) {
        double left = room_left(c, p) + c->beyond[0], right = c->beyond[1] + room_right(c, p);
        columns->lane[p] = (struct bead_lane){.keep = {left, right}, .reach = {left, right}, .share = 1, .least = least};
    }
    double cell = floor((c->area.width - bead_lanes_fixed(columns)) / (double)c->columns);
    for (size_t p = 1; halves(c) == 2 && p < plots; p += 2) {
        columns->lane[p].share = 0;
        columns->lane[p].least = fmax(0, floor(images_part * cell));
    }
    return bead_lanes_divide(columns);
}

static double width_of(const struct bead_cells *c, size_t half)
{
    return c->grid->columns.lane[half].size;
}

/* ---- which axes are labelled ---- */

static bool lowest_of_column(const struct bead_cells *c, size_t chain)
{
    return chain + c->columns >= c->wants->chain_count;
}

static bool has_bead_axis(const struct bead_cells *c, size_t view)
{
    return !moves(c, view) && !has(c, view, BEAD_SHOWS_BEADS) && along_chain(c, view);
}

/* The last moving view has the numbers. */
static bool labels_window(const struct bead_cells *c, const struct column *column, size_t view)
{
    size_t last = c->wants->view_count;
    for (size_t i = 0; i < column->count; i++)
        last = moves(c, column->view[i]) ? column->view[i] : last;
    return view == last;
}

/* The lowest view with a bead axis labels it for those above; without one, the row of beads has the numbers. */
static bool labels_beads(const struct bead_cells *c, const struct column *column, size_t view)
{
    size_t axis = c->wants->view_count, row = axis;
    for (size_t i = 0; i < column->count; i++) {
        axis = has_bead_axis(c, column->view[i]) ? column->view[i] : axis;
        row = row == c->wants->view_count && has(c, column->view[i], BEAD_SHOWS_BEADS) ? column->view[i] : row;
    }
    return view == (axis < c->wants->view_count ? axis : row);
}

/* The lowest view with time across labels it; so does any view of modes. */
static bool labels_time(const struct bead_cells *c, const struct column *column, size_t view)
{
    size_t last = view;
    for (size_t i = 0; bead_movie_across(c->wants, view) == BEAD_ACROSS_TIME && i < column->count; i++)
        last = bead_movie_across(c->wants, column->view[i]) == BEAD_ACROSS_TIME ? column->view[i] : last;
    return view == last;
}

static bool labelled(const struct bead_cells *c, const struct column *column, size_t chain, size_t view)
{
    bool lowest = lowest_of_column(c, chain);
    if (!c->axes)
        return false;
    if (!along_chain(c, view))
        return lowest && labels_time(c, column, view);
    if (moves(c, view))
        return labels_window(c, column, view) && c->level->titles;
    bool wanted = c->wants->same_beads ? lowest : c->level->titles;
    return labels_beads(c, column, view) && (wanted || has(c, view, BEAD_SHOWS_BEADS));
}

static int below(const struct bead_cells *c, const struct column *column, size_t chain, size_t view)
{
    const struct bead_movie_wants *w = c->wants;
    if (!labelled(c, column, chain, view) || has(c, view, BEAD_SHOWS_BEADS))
        return 0;
    if (moves(c, view))
        return bead_cells_whole(w->below_numbers);
    if (bead_movie_across(w, view) == BEAD_ACROSS_TIME)
        return bead_cells_whole(c->level->titles ? w->below_time : w->below_numbers);
    return bead_cells_whole(w->below_beads);
}

/* ---- down ---- */

/* Titles of vertical axes are above their panels. */
static int above(const struct bead_cells *c, size_t view)
{
    bool titled = c->axes && c->level->titles && !has(c, view, BEAD_SHOWS_BEADS);
    return titled ? bead_cells_whole(title_line * c->wants->look->label) : 0;
}

static int heading_height(const struct bead_cells *c)
{
    const struct bead_look *look = c->wants->look;
    if (!c->headings)
        return 0;
    return bead_cells_whole(c->level->heading * look->title + (c->label_lines ? title_line * look->label : 0));
}

size_t bead_cells_promised(const struct bead_cells *c)
{
    size_t images = 0;
    for (size_t v = 0; v < c->wants->view_count; v++)
        images += has(c, v, BEAD_SHOWS_IMAGE);
    return c->wants->chain_count > PROMISED ? 0 : images;
}

/* The height that each image needs for all to have their share of the frame. */
static double image_height(const struct bead_cells *c)
{
    const struct bead_movie_wants *w = c->wants;
    const size_t images = bead_cells_promised(c);
    if (images == 0)
        return 0;
    return ceil(c->level->share * w->width * w->height / ((double)(images * w->chain_count) * width_of(c, halves(c) - 1)));
}

static double least_height(const struct bead_cells *c, size_t view)
{
    const double em = c->wants->look->tick, *least = c->level->least;
    if (has(c, view, BEAD_SHOWS_IMAGE))
        return fmax(1, fmax(least[1] * em, image_height(c)));
    return fmax(c->level->least_px, least[has(c, view, BEAD_SHOWS_BEADS) ? 0 : 2] * em);
}

/* The greatest height of curves and bars. On phones, if no image takes the rest of the room, they may be as high as the frame is
 * wide. */
static double most_of_curve(const struct bead_cells *c, const struct column *column, size_t view)
{
    bool image = false;
    for (size_t i = 0; i < column->count; i++)
        image = image || has(c, column->view[i], BEAD_SHOWS_IMAGE);
    const double most = c->wants->views[view]->info->movie_most * width_of(c, 0);
    return !image && c->wants->height > c->wants->width ? fmax(c->wants->width, most) : most;
}

static double most_height(const struct bead_cells *c, const struct column *column, size_t view)
{
    const struct bead_movie_wants *w = c->wants;
    const struct bead_view_info *info = w->views[view]->info;
    double em = w->look->tick;
    if (!c->level->words || has(c, view, BEAD_SHOWS_IMAGE))
        return INFINITY;
    if (!has(c, view, BEAD_SHOWS_BEADS))
        return fmax(most_of_curve(c, column, view), least_height(c, view));
    double bead = w->bead_height * width_of(c, 0) / w->width, names = w->sensors || labels_window(c, column, view) ? 1.35 * em : 0;
    double most = moves(c, view) ? names + fmax(1.3 * bead, bead + w->look->gap) : info->movie_most * width_of(c, 0) + 1.6 * em;
    return fmax(bead_cells_whole(most), least_height(c, view));
}

static void add_view(const struct bead_cells *c, const struct column *column, size_t row, size_t k,
                     struct bead_movie_layout *layout)
{
    size_t view = column->view[k], half = column->right, lane = c->grid->rows.count++;
    double em = c->wants->look->tick;
    int numbers = column->right && c->axes ? bead_cells_whole(0.6 * em) : 0;           /* nothing else is above these */
    int heading = above(c, view) + (k == 0 && !column->right ? heading_height(c) : 0); /* headings are above the left half */
    double gap = k > 0 ? c->level->views : row > 0 ? c->level->rows : 0;
    c->grid->rows.lane[lane] = (struct bead_lane){.line = half,
                                                  .gap = bead_cells_whole(gap * em),
                                                  .least = least_height(c, view),
                                                  .most = most_height(c, column, view),
                                                  .share = c->wants->views[view]->info->movie_share};
    if (k == 0) /* room that no view can use goes around the cells */
        c->grid->rows.lane[lane].spring = row > 0 ? 1 : 0.5;
    for (size_t chain = row * c->columns; chain < (row + 1) * c->columns && chain < layout->chain_count; chain++) {
        size_t plot = chain % c->columns * halves(c) + half;
        struct bead_insets reach = {.top = fmax(numbers, heading), .bottom = below(c, column, chain, view)};
        c->grid->boxes[chain * c->wants->view_count + view] = (struct bead_layout_box){.column = plot, .row = lane, .reach = reach};
        layout->chains[chain].labels[view] = labelled(c, column, chain, view);
        layout->chains[chain].values[view] = labelled_column(c, plot);
    }
}

/* ---- an overlay above the cells ---- */

/* Has no view below the overlay, in the same column, the numbers of beads? */
static bool labels_own(const struct bead_cells *c)
{
    const struct column column = column_of(c, 0);
    bool axis = false;
    for (size_t i = 0; i < column.count; i++)
        axis = axis || has_bead_axis(c, column.view[i]);
    return c->axes && (c->columns > 1 || !axis);
}

/* One profile for all chains, in the first row; headings in a line above it if they have no cells. */
static void add_overlay(const struct bead_cells *c, bool alone, struct bead_movie_layout *layout)
{
    size_t view = bead_cells_overlay(c);
    bool labels = labels_own(c);
    struct bead_insets reach = {.top = above(c, view) + (alone ? heading_height(c) : 0),
                                .bottom = (labels ? bead_cells_whole(c->wants->below_beads) : 0) +
                                          (alone ? 0 : bead_cells_whole(between_rows * c->wants->look->tick))};
    const double most = c->wants->views[view]->info->movie_most * c->area.width;
    c->grid->rows.lane[c->grid->rows.count++] = (struct bead_lane){.share = last_share, .most = alone ? 0 : most};
    for (size_t i = 0; i < layout->chain_count; i++) {
        c->grid->boxes[i * c->wants->view_count + view] = (struct bead_layout_box){.columns = c->columns, .reach = reach};
        layout->chains[i].labels[view] = labels && i == 0;
        layout->chains[i].values[view] = labelled_column(c, 0) && i == 0;
    }
}

/* The overlay shrinks in favour of the cells, down to its least height. False: there is no room. */
static bool size_overlay(const struct bead_cells *c, bool alone)
{
    struct bead_lane *overlay = c->grid->rows.lane;
    double least = ceil(fmax(12, overlay_least[c->level->titles] * c->wants->look->tick));
    double part = overlay_part * (c->area.height - overlay->reach[0] - overlay->reach[1]);
    double room = c->area.height - ceil(bead_lanes_least(&c->grid->rows));
    overlay->least = floor(alone ? room : fmin(room, fmax(least, part)));
    return overlay->least >= least;
}

/* ---- places ---- */

static void place_headings(const struct bead_cells *c, bool above_all, struct bead_movie_layout *layout)
{
    const struct bead_layout_box *boxes = c->grid->boxes;
    struct column first = column_of(c, 0);
    size_t view = above_all ? bead_cells_overlay(c) : first.view[0];
    if (!c->headings || (!above_all && first.count == 0))
        return;
    for (size_t i = 0; i < layout->chain_count; i++) {
        const struct bead_layout_box *box = &boxes[i * c->wants->view_count + view];
        const struct bead_lane *row = &c->grid->rows.lane[box->row];
        int each = box->at.width / (int)layout->chain_count, top = (int)(row->at - row->reach[0]);
        layout->chains[i].heading =
            (struct bead_rect){box->at.x - c->beyond[0], top, box->at.width + c->beyond[0], heading_height(c)};
        if (above_all) {
            layout->chains[i].heading.x = box->at.x + (int)i * each;
            layout->chains[i].heading.width = each - bead_cells_whole(c->wants->look->tick);
        }
    }
}

static void place_plots(const struct bead_cells *c, struct bead_movie_layout *layout)
{
    for (size_t i = 0; i < c->grid->count; i++) {
        size_t view = i % c->wants->view_count;
        struct bead_rect *plot = &layout->chains[i / c->wants->view_count].plot[view];
        if (left_out(c, view))
            continue;
        *plot = c->grid->boxes[i].at;
        if (along_chain(c, view))
            continue;
        plot->x -= c->beyond[0];
        plot->width += c->beyond[0] + c->beyond[1];
    }
}

bool bead_cells_place(struct bead_cells *c, struct bead_movie_layout *layout)
{
    struct bead_lanes *rows = &c->grid->rows;
    bool overlaid = bead_cells_overlay(c) < c->wants->view_count, alone = overlaid && c->wants->view_count == 1;
    if (!divide_across(c))
        return false;
    rows->count = 0;
    for (size_t i = 0; i < c->grid->count; i++) /* views that are left out have none */
        c->grid->boxes[i] = (struct bead_layout_box){.column = 0};
    rows->spring = 0.5;
    bead_lanes_within(rows, c->area.y, c->area.height);
    if (overlaid)
        add_overlay(c, alone, layout);
    for (size_t h = 0; h < halves(c); h++) {
        struct column column = column_of(c, h);
        for (size_t i = 0; i < c->rows * column.count; i++)
            add_view(c, &column, i / column.count, i % column.count, layout);
    }
    bead_layout_reach(c->grid, false);
    if ((overlaid && !size_overlay(c, alone)) || !bead_layout_divide(c->grid, NULL))
        return false;
    place_headings(c, alone, layout);
    place_plots(c, layout);
    return true;
}
