/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arranges the cells of a movie's frame: columns of plots, each a stack of views. Space-time images get their share first. */
#include "render/movie/movie_cells.h"

#include <math.h>

/* In units of the label's font size. */
static const double title_line = 1.35, between_titled = 0.3, between_labelled = 1.1, between_ticks = 0.5;
static const double between_columns = 1.2, between_numbers = 0.5, between_rows = 0.9;
/* Heights that plots need to be read, in the same units: with all labels, with few. */
static const double least_beads[] = {1.5, 0.9}, least_image[] = {3, 1.6}, least_other[] = {3.2, 1.8};
/* An overlaid profile's part of the height of all, and the least. */
static const double overlay_part = 0.3, overlay_least = 3.4;
/* Of a cell's width, for images at the right of other views. */
static const double images_part = 0.64;
/* Most chains whose images have the share that is promised; a little more, for rounding. */
enum { PROMISED = 4 };
static const double share = BEAD_IMAGE_SHARE + 0.004;

/* The views of one column of plots. */
struct column {
    size_t view[BEAD_STACK_VIEWS], count;
    bool right; /* half of the cells */
};

static int whole(double x)
{
    return (int)ceil(x);
}

static bool few(const struct bead_cells *c)
{
    return c->level >= BEAD_LEVEL_FEW_LABELS;
}

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

/* Plots side by side in a cell. */
static size_t halves(const struct bead_cells *c)
{
    return c->layout == BEAD_LAYOUT_BESIDE ? 2 : 1;
}

static struct column column_of(const struct bead_cells *c, size_t half)
{
    struct column column = {.right = half == 1};
    size_t overlay = bead_cells_overlay(c);
    for (size_t v = 0; v < c->wants->view_count; v++) {
        bool right = halves(c) == 2 && has(c, v, BEAD_SHOWS_IMAGE);
        if (v != overlay && right == (half == 1))
            column.view[column.count++] = v;
    }
    return column;
}

/* ---- across ---- */

/* Columns of plots whose vertical axes are labelled: all chains have the same values, so the first of a kind is enough. */
static bool labelled_column(const struct bead_cells *c, size_t plot)
{
    return c->axes && c->level < BEAD_LEVEL_TIGHT && plot < halves(c);
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* Room within the panels for what is beside the beads: a striker that flies back, the wall, a last bead that moves on. */
static void choose_beyond(struct bead_cells *c, double width)
{
    const struct bead_movie_wants *w = c->wants;
    double em = w->look->tick, pitch = width / fmax(1, (double)w->beads);
    bool beads = false;
    for (size_t v = 0; v < w->view_count; v++)
        beads = beads || has(c, v, BEAD_SHOWS_BEADS);
    c->beyond[0] = c->beyond[1] = 0;
    if (!c->axes || !beads || w->follow)
        return;
    double right = clamp(0.7 * pitch, w->wall ? 0.6 * em : 0.3 * em, 1.6 * em);
    c->beyond[0] = whole(w->striker ? clamp(1.6 * pitch, 0.9 * em, 2.6 * em) : clamp(0.7 * pitch, 0.3 * em, 1.6 * em));
    c->beyond[1] = whole(w->wall ? fmax(right, fmax(4, w->look->gap)) : right);
}

/* How far the numbers of an axis of time reach beyond the sides of a plot. */
static double time_ends(const struct bead_cells *c, size_t plot)
{
    struct column column = column_of(c, plot % halves(c));
    for (size_t i = 0; c->axes && i < column.count; i++) {
        if (bead_movie_across(c->wants, column.view[i]) == BEAD_ACROSS_TIME)
            return c->wants->time_end;
    }
    return 0;
}

/* Left of a plot, for labels; the first has the frame's margin besides. */
static int room_left(const struct bead_cells *c, size_t plot)
{
    double ends = time_ends(c, plot) - (plot == 0 ? c->wants->look->gap : 0);
    return whole(fmax(labelled_column(c, plot) ? c->wants->left : 0, ends));
}

/* Right of a plot, before the room of the next; the last has the margin, which may be too small for its numbers. */
static int room_right(const struct bead_cells *c, size_t plot)
{
    double ends = time_ends(c, plot), em = c->wants->look->tick;
    if (plot + 1 == c->columns * halves(c))
        return whole(fmax(0, ends - c->wants->look->gap));
    return c->level == BEAD_LEVEL_VIEWS_ONLY ? 0 : whole(fmax(between_columns * em, ends > 0 ? ends + between_numbers * em : 0));
}

/* px that are not plots: labels, gaps, what is beyond. */
static int across_fixed(const struct bead_cells *c)
{
    int plots = (int)(c->columns * halves(c)), fixed = plots * (c->beyond[0] + c->beyond[1]);
    for (int p = 0; p < plots; p++)
        fixed += room_left(c, (size_t)p) + room_right(c, (size_t)p);
    return fixed;
}

static bool choose_width(struct bead_cells *c)
{
    int plots = (int)(c->columns * halves(c));
    choose_beyond(c, (double)c->area.width / plots);
    int cell = (c->area.width - across_fixed(c)) / (int)c->columns;
    c->width[1] = halves(c) == 2 ? (int)(images_part * cell) : 0;
    c->width[0] = cell - c->width[1];
    double least = c->level == BEAD_LEVEL_VIEWS_ONLY ? 1 : plots > 1 ? fmax(60, 5 * c->wants->look->label) : 60;
    return c->width[0] >= least;
}

/* The left edge of a plot, px. */
static int left_of(const struct bead_cells *c, size_t plot)
{
    int x = c->area.x;
    for (size_t p = 0;; p++) {
        x += room_left(c, p) + c->beyond[0];
        if (p == plot)
            return x;
        x += c->width[p % halves(c)] + c->beyond[1] + room_right(c, p);
    }
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

/* The last of the moving views has the numbers. */
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

/* The lowest of the views with time across; any view of modes. */
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
        return labels_window(c, column, view) && !few(c);
    bool wanted = c->wants->same_beads ? lowest : !few(c);
    return labels_beads(c, column, view) && (wanted || has(c, view, BEAD_SHOWS_BEADS));
}

static int below(const struct bead_cells *c, const struct column *column, size_t chain, size_t view)
{
    const struct bead_movie_wants *w = c->wants;
    if (chain >= w->chain_count || !labelled(c, column, chain, view) || has(c, view, BEAD_SHOWS_BEADS))
        return 0;
    if (moves(c, view))
        return whole(w->below_numbers);
    if (bead_movie_across(w, view) == BEAD_ACROSS_TIME)
        return whole(bead_level_titles(c->level) ? w->below_time : w->below_numbers);
    return whole(w->below_beads);
}

/* ---- down ---- */

/* Titles of vertical axes stand above their panels. */
static int above(const struct bead_cells *c, size_t view)
{
    bool titled = c->axes && bead_level_titles(c->level) && !has(c, view, BEAD_SHOWS_BEADS);
    return titled ? whole(title_line * c->wants->look->label) : 0;
}

static int heading_height(const struct bead_cells *c)
{
    const struct bead_look *look = c->wants->look;
    if (!c->headings)
        return 0;
    double line = (few(c) ? 1.25 : 1.5) * look->title;
    return whole(line + (c->label_lines ? title_line * look->label : 0));
}

/* The height that an image must have so that all have the share of the frame. */
static double image_height(const struct bead_cells *c)
{
    const struct bead_movie_wants *w = c->wants;
    size_t images = 0;
    for (size_t v = 0; v < w->view_count; v++)
        images += has(c, v, BEAD_SHOWS_IMAGE);
    if (!c->share || images == 0 || w->chain_count > PROMISED)
        return 0;
    return ceil(share * w->width * w->height / ((double)(images * w->chain_count) * c->width[halves(c) - 1]));
}

static double least_height(const struct bead_cells *c, size_t view)
{
    double em = c->wants->look->tick;
    int size = few(c);
    if (c->level >= BEAD_LEVEL_TIGHT)
        return has(c, view, BEAD_SHOWS_IMAGE) ? fmax(1, image_height(c)) : c->level == BEAD_LEVEL_VIEWS_ONLY ? 1 : 8;
    if (has(c, view, BEAD_SHOWS_IMAGE))
        return fmax(least_image[size] * em, image_height(c));
    return fmax(12, (has(c, view, BEAD_SHOWS_BEADS) ? least_beads : least_other)[size] * em);
}

static double most_height(const struct bead_cells *c, const struct column *column, size_t view)
{
    const struct bead_movie_wants *w = c->wants;
    const struct bead_view_info *info = w->views[view]->info;
    double em = w->look->tick;
    if (c->level == BEAD_LEVEL_VIEWS_ONLY || has(c, view, BEAD_SHOWS_IMAGE))
        return INFINITY;
    if (!has(c, view, BEAD_SHOWS_BEADS))
        return fmax(info->movie_most * c->width[0], least_height(c, view));
    double bead = w->bead_height * c->width[0] / w->width, names = w->sensors || labels_window(c, column, view) ? 1.35 * em : 0;
    double most = moves(c, view) ? names + fmax(1.3 * bead, bead + w->look->gap) : info->movie_most * c->width[0] + 1.6 * em;
    return fmax(whole(most), least_height(c, view));
}

static double view_share(const struct bead_cells *c, size_t view)
{
    return c->wants->views[view]->info->movie_share;
}

static struct bead_stack make_stack(const struct bead_cells *c, const struct column *column, struct bead_stack_reach *reach)
{
    double em = c->wants->look->tick;
    bool gaps = c->level < BEAD_LEVEL_VIEWS_ONLY;
    double views = bead_level_titles(c->level)              ? between_titled
                   : c->axes && c->level < BEAD_LEVEL_TIGHT ? between_labelled
                                                            : between_ticks;
    struct bead_stack stack = {.rows = c->rows,
                               .views = column->count,
                               .between_rows = gaps ? whole((few(c) ? 0.6 : 1) * between_rows * em) : 0,
                               .between_views = gaps ? whole(views * em) : 0,
                               .reach = reach};
    for (size_t i = 0; i < c->rows * column->count; i++) {
        size_t view = column->view[i % column->count], first = i / column->count * c->columns;
        bool headed = i % column->count == 0 && !column->right;       /* headings stand above the left half */
        int numbers = column->right && c->axes ? whole(0.6 * em) : 0; /* and nothing else above these */
        reach[i] = (struct bead_stack_reach){fmax(numbers, above(c, view) + (headed ? heading_height(c) : 0)), 0};
        for (size_t k = 0; k < c->columns; k++)
            reach[i].below = fmax(reach[i].below, below(c, column, first + k, view));
    }
    for (size_t k = 0; k < column->count; k++) {
        stack.share[k] = view_share(c, column->view[k]);
        stack.least[k] = least_height(c, column->view[k]);
        stack.most[k] = most_height(c, column, column->view[k]);
    }
    return stack;
}

/* The plots of one half of all cells, within rows from `top` on that have `height` px together. */
static bool place_stacks(const struct bead_cells *c, size_t half, int top, int height, struct bead_stack_reach *reach,
                         struct bead_movie_layout *layout)
{
    struct column column = column_of(c, half);
    if (column.count == 0)
        return true;
    struct bead_stack stack = make_stack(c, &column, reach);
    int rows = (int)c->rows, room = (int)floor((height - bead_stack_fixed(&stack)) / rows);
    int used = room > 0 ? bead_stack_divide(&stack, room) : room + 1;
    if (used > room)
        return false;
    double y = top + (room - used) / 2.0;
    stack.between_rows += room - used;
    for (size_t r = 0; r < c->rows; r++) {
        struct bead_stack_places places;
        y = bead_stack_row(&stack, r, y, &places) + stack.between_rows;
        for (size_t chain = r * c->columns; chain < (r + 1) * c->columns && chain < layout->chain_count; chain++) {
            struct bead_movie_chain *to = &layout->chains[chain];
            size_t plot = chain % c->columns * halves(c) + half;
            int x = left_of(c, plot);
            if (half == 0 && c->headings)
                to->heading = (struct bead_rect){x - c->beyond[0], places.heading, c->width[0] + c->beyond[0], heading_height(c)};
            for (size_t k = 0; k < column.count; k++) {
                size_t v = column.view[k];
                bool chained = along_chain(c, v);
                to->plot[v] = (struct bead_rect){x - (chained ? 0 : c->beyond[0]), places.plot[k],
                                                 c->width[half] + (chained ? 0 : c->beyond[0] + c->beyond[1]), stack.height[k]};
                to->labels[v] = labelled(c, &column, chain, v);
                to->values[v] = labelled_column(c, plot);
            }
        }
    }
    return true;
}

/* ---- an overlay above the cells ---- */

/* px that the cells' stacks need at least; 0: there are none. */
static int cells_least(const struct bead_cells *c, struct bead_stack_reach *reach)
{
    struct column column = column_of(c, 0);
    if (column.count == 0)
        return 0;
    struct bead_stack stack = make_stack(c, &column, reach);
    double least = bead_stack_fixed(&stack);
    for (size_t k = 0; k < column.count; k++)
        least += (double)c->rows * stack.least[k];
    return whole(least);
}

/* One profile for all chains; headings in a row above it where there are no cells to stand in. Returns the px taken; < 0: there is
 * no room. */
static int place_overlay(const struct bead_cells *c, struct bead_stack_reach *reach, struct bead_movie_layout *layout)
{
    size_t view = bead_cells_overlay(c), chains = layout->chain_count;
    const double em = c->wants->look->tick;
    int cells = cells_least(c, reach), top = c->area.y, last = left_of(c, c->columns - 1) + c->width[0];
    int first = left_of(c, 0), names = cells == 0 ? heading_height(c) : 0, head = names + above(c, view);
    bool labels = c->axes && (cells == 0 || c->columns > 1);
    int tail = (labels ? whole(c->wants->below_beads) : 0) + (cells > 0 ? whole(between_rows * em) : 0);
    int most = c->area.height - cells - head - tail, least = whole(fmax(12, few(c) ? 1.6 * em : overlay_least * em));
    int height = cells == 0 ? most : (int)fmin(most, fmax(least, overlay_part * (c->area.height - head - tail)));
    if (height < least)
        return -1;
    for (size_t i = 0; i < chains; i++) {
        struct bead_movie_chain *chain = &layout->chains[i];
        int each = (last - first) / (int)chains, x = first + (int)i * each;
        if (names > 0)
            chain->heading = (struct bead_rect){x, top, each - whole(em), names};
        chain->plot[view] = (struct bead_rect){first, top + head, last - first, height};
        chain->labels[view] = labels && i == 0;
        chain->values[view] = labelled_column(c, 0) && i == 0;
    }
    return head + height + tail;
}

bool bead_cells_place(struct bead_cells *c, struct bead_stack_reach *reach, struct bead_movie_layout *layout)
{
    int taken = 0;
    if (!choose_width(c))
        return false;
    if (bead_cells_overlay(c) < c->wants->view_count)
        taken = place_overlay(c, reach, layout);
    bool placed = taken >= 0;
    for (size_t h = 0; placed && h < halves(c); h++)
        placed = place_stacks(c, h, c->area.y + taken, c->area.height - taken, reach, layout);
    return placed;
}
