/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a movie's frame. For every number of columns that the scene allows, levels leave out words, headings and axes one
 * after the other until the cells fit; the arrangement that leaves out least is taken. composer.c asks for it once. */
#include "render/movie/movie_layout.h"

#include <math.h>
#include <stdlib.h>

#include "render/movie/movie_cells.h"
#include "render/view/orientation.h"

/* Frames less wide than this, in heights, have the bar beside the clock. */
static const double wide_frame = 1.5;
/* A cell looks best with this width, in heights; what a level, an empty cell and a wrong shape cost. */
static const double best_shape = 0.8, level_costs = 0.7, hole_costs = 1;
enum { MOST_COLUMNS = 12, MOST_CHAINS = 100000 };

/* What surrounds the cells at one level, px. */
struct frame {
    int margin, header, bottom, right; /* header: below the margin */
    int time_height, line_height, lines, caption;
    int bar_gap, bar_width;
    bool title_beside; /* the clock; else in a line of its own, or nowhere */
    bool lying;        /* the bar */
};

static int whole(double x)
{
    return (int)ceil(x);
}

static bool has_bar(const struct bead_movie_wants *w, enum bead_level level)
{
    return w->axes && level < BEAD_LEVEL_NO_AXES && !w->colourless;
}

static bool lies(const struct bead_movie_wants *w)
{
    return w->width < wide_frame * w->height;
}

/* Room for the title right of the clock, which stands above the first panel. */
static double beside_clock(const struct bead_movie_wants *w, const struct frame *f)
{
    return w->width - 2 * f->margin - f->right - w->left - w->time_width - 2 * w->look->gap;
}

static struct frame measure_frame(const struct bead_movie_wants *w, enum bead_level level)
{
    const struct bead_look *look = w->look;
    struct frame f = {.lying = has_bar(w, level) && lies(w)};
    if (!w->axes || level == BEAD_LEVEL_VIEWS_ONLY) {
        f.caption = w->axes ? whole(w->caption_lines * w->caption_line) : 0;
        f.bottom = f.caption;
        return f;
    }
    f.margin = whole(look->gap);
    f.time_height = whole(1.45 * look->title);
    f.line_height = whole(1.35 * look->label);
    f.bar_width = whole(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE));
    f.bar_gap = whole(0.8 * look->tick);
    if (has_bar(w, level) && !f.lying)
        f.right = f.bar_gap + whole(fmax(f.bar_width + w->bar, w->bar_title));
    bool title = w->title_width > 0 && level < BEAD_LEVEL_FEW_LABELS;
    f.title_beside = title && !f.lying && w->title_width <= beside_clock(w, &f);
    f.lines = (level == BEAD_LEVEL_EVERYTHING ? 1 + (title && !f.title_beside) : 0) + w->trust;
    int first = f.lying ? whole(fmax(f.time_height, f.bar_width + w->bar_below + 0.2 * look->tick)) : f.time_height;
    f.header = first + f.lines * f.line_height + (level < BEAD_LEVEL_FEW_LABELS && !w->headings ? whole(0.5 * look->gap) : 0);
    /* The scene asks for captions: they are never left out. */
    f.caption = whole(w->caption_lines * w->caption_line);
    f.bottom = f.margin + f.caption + (f.caption > 0 ? whole(0.5 * look->gap) : 0);
    return f;
}

static struct bead_cells make_cells(const struct bead_movie_wants *w, const struct frame *f, enum bead_level level,
                                    enum bead_layout layout, size_t columns)
{
    double room = (w->width - 2 * f->margin - f->right - (layout == BEAD_LAYOUT_BESIDE ? 2 : 1) * w->left) / (double)columns;
    room = (layout == BEAD_LAYOUT_BESIDE ? 0.36 : 1) * room - 1.3 * w->look->tick;
    struct bead_cells cells = {.wants = w,
                               .level = level,
                               .layout = layout,
                               .columns = columns,
                               .rows = (w->chain_count + columns - 1) / columns,
                               .axes = w->axes && level < BEAD_LEVEL_NO_AXES,
                               .headings = w->axes && w->headings &&
                                           level<BEAD_LEVEL_NO_HEADINGS, .label_lines = w->heading_width> room &&
                                           level == BEAD_LEVEL_EVERYTHING};
    int top = f->margin + f->header;
    cells.area = (struct bead_rect){f->margin, top, w->width - 2 * f->margin - f->right, w->height - top - f->bottom};
    return cells;
}

enum bead_view_across bead_movie_across(const struct bead_movie_wants *w, size_t view)
{
    return bead_orientation_across(w->orientation, w->views[view]->info);
}

static void place_words(const struct bead_movie_wants *w, const struct frame *f, enum bead_level level,
                        struct bead_movie_layout *layout)
{
    const struct bead_rect *first = &layout->chains[0].plot[0];
    int left = first->x - (bead_movie_across(w, 0) == BEAD_ACROSS_CHAIN ? layout->beyond[0] : 0),
        right = w->width - f->margin - f->right;
    int gap = whole(w->look->gap);
    int time = whole(w->time_width) < right - left ? whole(w->time_width) : right - left;
    int y = f->margin + f->header - f->lines * f->line_height;
    if (f->time_height == 0 || right <= left)
        return;
    if (level < BEAD_LEVEL_FEW_LABELS && !w->headings)
        y -= whole(0.5 * w->look->gap);
    layout->time = (struct bead_rect){left, f->margin, time, f->time_height};
    layout->words_left = f->lying || w->width < w->time_width + 22 * w->look->label;
    struct bead_rect line = {left, y, right - left, f->line_height};
    if (f->title_beside)
        layout->title = (struct bead_rect){left + time + 2 * gap, f->margin, right - left - time - 2 * gap, f->time_height};
    else if (level == BEAD_LEVEL_EVERYTHING && w->title_width > 0) {
        layout->title = line;
        line.y += line.height;
    }
    if (level == BEAD_LEVEL_EVERYTHING) {
        layout->facts = line;
        line.y += line.height;
    }
    if (w->trust)
        layout->trust = line;
}

static void place_standing_bar(const struct bead_movie_wants *w, const struct frame *f, const struct bead_cells *cells,
                               struct bead_movie_layout *layout)
{
    int top = w->height, bottom = 0, pad = whole(0.6 * w->look->tick), x = w->width - f->margin - f->right + f->bar_gap;
    for (size_t i = 0; i < layout->chain_count * w->view_count; i++) {
        const struct bead_rect *plot = &layout->chains[i / w->view_count].plot[i % w->view_count];
        top = plot->y < top ? plot->y : top;
        bottom = plot->y + plot->height > bottom ? plot->y + plot->height : bottom;
    }
    layout->bar_title = (struct bead_rect){x, cells->area.y, w->width - f->margin - x, f->line_height};
    if (w->headings && cells->headings) /* on one line with these */
        layout->bar_title.height = whole(1.45 * w->look->title);
    int least = layout->bar_title.y + layout->bar_title.height;
    top = (top > least ? top : least) + pad;
    bottom -= pad;
    if (bottom - top >= 8)
        layout->bar = (struct bead_rect){x, top, f->bar_width, bottom - top};
    else
        layout->bar_title = (struct bead_rect){0};
}

/* Right of the clock, as far as there is room. */
static void place_lying_bar(const struct bead_movie_wants *w, const struct frame *f, struct bead_movie_layout *layout)
{
    int pad = whole(1.2 * w->look->tick), title = whole(w->bar_title + 0.5 * w->look->gap), most = (int)(0.4 * w->width);
    int right = w->width - f->margin - pad, left = layout->time.x + layout->time.width + whole(w->look->gap) + title + pad;
    int length = right - left;
    length = length < most ? length : most;
    if (length < 4 * w->look->tick)
        return;
    layout->bar = (struct bead_rect){right - length, f->margin + whole(0.2 * w->look->tick), f->bar_width, 0};
    layout->bar.height = layout->bar.width;
    layout->bar.width = length;
    layout->bar_title = (struct bead_rect){layout->bar.x - pad - title, f->margin, title, f->time_height};
}

/* ---- the choice ---- */

static bool fits(const struct bead_movie_wants *w, enum bead_level level, enum bead_layout layout, size_t columns, bool share,
                 struct bead_stack_reach *reach, struct bead_movie_layout *to)
{
    struct frame f = measure_frame(w, level);
    struct bead_cells cells = make_cells(w, &f, level, layout, columns);
    cells.share = share;
    if (cells.area.height < 1 || !bead_cells_place(&cells, reach, to))
        return false;
    to->layout = layout;
    to->axes = cells.axes;
    to->titles = bead_level_titles(level);
    to->label_lines = cells.label_lines;
    to->overlay = bead_cells_overlay(&cells);
    to->beyond[0] = cells.beyond[0];
    to->beyond[1] = cells.beyond[1];
    place_words(w, &f, level, to);
    if (f.lying)
        place_lying_bar(w, &f, to);
    else if (has_bar(w, level))
        place_standing_bar(w, &f, &cells, to);
    if (f.caption > 0)
        to->caption = (struct bead_rect){f.margin, w->height - f.margin - f.caption, w->width - 2 * f.margin, f.caption};
    return true;
}

/* How far an arrangement is from what one would like; lower is better. */
static double cost_of(const struct bead_movie_wants *w, enum bead_level level, enum bead_layout layout, size_t columns)
{
    struct frame f = measure_frame(w, level);
    struct bead_cells cells = make_cells(w, &f, level, layout, columns);
    double width = (double)cells.area.width / (double)columns, height = fmax(1, (double)cells.area.height / (double)cells.rows);
    double holes = (double)(cells.rows * columns - w->chain_count) / (double)w->chain_count;
    return level_costs * level + fabs(log(width / (height * best_shape))) + hole_costs * holes;
}

/* Least and most columns of cells. */
static void column_range(const struct bead_movie_wants *w, enum bead_layout layout, size_t range[2])
{
    size_t n = w->chain_count, most = n < MOST_COLUMNS ? n : MOST_COLUMNS, square = (size_t)ceil(sqrt((double)n) - 1e-9);
    range[0] = 1;
    range[1] = most;
    if (layout == BEAD_LAYOUT_STACKED || layout == BEAD_LAYOUT_BESIDE)
        range[1] = 1;
    else if (layout == BEAD_LAYOUT_COLUMNS)
        range[0] = range[1] = n;
    else if (layout == BEAD_LAYOUT_GRID)
        range[0] = range[1] = square;
}

/* A profile alone tells several chains apart only on one axis. */
static enum bead_layout resolved(const struct bead_movie_wants *w)
{
    bool overlays = w->chain_count > 1 && w->chain_count <= 6 && !w->follow;
    for (size_t v = 0; v < w->view_count; v++)
        overlays = overlays && bead_view_has(w->views[v], BEAD_OVERLAYS);
    return w->layout == BEAD_LAYOUT_AUTO && overlays ? BEAD_LAYOUT_OVERLAY : w->layout;
}

/* What a layout is called that has so many columns. */
static enum bead_layout named(const struct bead_movie_wants *w, enum bead_layout layout, size_t columns)
{
    if (layout != BEAD_LAYOUT_AUTO)
        return layout;
    return columns == 1 ? BEAD_LAYOUT_STACKED : columns == w->chain_count ? BEAD_LAYOUT_COLUMNS : BEAD_LAYOUT_GRID;
}

static void forget(struct bead_movie_layout *layout)
{
    struct bead_movie_chain *chains = layout->chains;
    size_t count = layout->chain_count;
    for (size_t i = 0; i < count; i++)
        chains[i] = (struct bead_movie_chain){.heading = {0}};
    *layout = (struct bead_movie_layout){.chains = chains, .chain_count = count};
}

/* The best of all levels and numbers of columns. False: the frame is too small. */
static bool choose(const struct bead_movie_wants *w, bool share, struct bead_stack_reach *reach, struct bead_movie_layout *layout)
{
    enum bead_layout asked = resolved(w);
    size_t range[2], best = 0;
    enum bead_level at = BEAD_LEVELS;
    double least = INFINITY;
    column_range(w, asked, range);
    for (size_t columns = range[0]; columns <= range[1]; columns++) {
        enum bead_layout name = named(w, asked, columns);
        for (enum bead_level level = w->axes ? BEAD_LEVEL_EVERYTHING : BEAD_LEVEL_VIEWS_ONLY; level < BEAD_LEVELS; level++) {
            forget(layout);
            if (!fits(w, level, name, columns, share, reach, layout))
                continue;
            double cost = cost_of(w, level, name, columns);
            best = cost < least ? columns : best;
            at = cost < least ? level : at;
            least = fmin(least, cost);
            break;
        }
    }
    forget(layout);
    return best > 0 && fits(w, at, named(w, asked, best), best, share, reach, layout);
}

enum bead_error bead_movie_arrange(const struct bead_movie_wants *wants, struct bead_movie_layout *layout, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    /* Grids may have empty cells. */
    struct bead_stack_reach *reach = calloc((2 * wants->chain_count + MOST_COLUMNS) * (wants->view_count + 1), sizeof *reach);
    *layout = (struct bead_movie_layout){.chain_count = wants->chain_count};
    layout->chains = calloc(wants->chain_count + 1, sizeof *layout->chains);
    if (!layout->chains || !reach)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a layout");
    else if (wants->chain_count > MOST_CHAINS || (!choose(wants, true, reach, layout) && !choose(wants, false, reach, layout)))
        err = bead_fail(msg, BEAD_ERROR_SCENE, "size: %d x %d pixels are too small for %zu views of %zu chains", wants->width,
                        wants->height, wants->view_count, wants->chain_count);
    if (err)
        bead_movie_layout_free(layout);
    free(reach);
    return err;
}

void bead_movie_layout_free(struct bead_movie_layout *layout)
{
    free(layout->chains);
    *layout = (struct bead_movie_layout){.chains = NULL};
}
