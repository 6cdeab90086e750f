/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a movie's frame. For every number of columns that the scene allows, levels leave out words, headings and axes in
 * turn until the cells fit; the arrangement that leaves out least wins. */
#include "render/movie/movie_layout.h"

#include <math.h>
#include <stdlib.h>

#include "render/movie/movie_cells.h"
#include "render/movie/movie_stage.h"
#include "render/movie/movie_words.h"

/* Frames narrower than this, in heights, have the bar beside the clock. */
static const double wide_frame = 1.5;
/* Margin around a stage, and around films with room for it, in units of the usual one. */
static const double wide_margin = 2;
/* Part of the width of a stage that labels behind the dashes of their curves may take. */
static const double label_part = 0.85;
/* The best width of a cell, in heights; the costs of a level, of an empty cell, and of axes without names. */
static const double best_shape = 0.8, level_costs = 0.7, hole_costs = 1, never = 100;
enum { MOST_COLUMNS = 12, MOST_CHAINS = 100000 };

/* From top to bottom. */
enum { CLOCK, BADGE, TITLE, FACTS, KEY, TRUST, BAR, CELLS, CAPTION, ROWS };

/* The surroundings of the cells at one level, px. */
struct frame {
    struct bead_lane row[ROWS];
    int margin, inset; /* inset: of words, at both sides */
    int right;         /* room right of the cells, without the margin */
    int bar_gap, bar_width;
    bool badge_beside, title_beside; /* beside the clock; else in a separate line, or nowhere */
    bool lying;                      /* the bar is horizontal */
    bool bar_beside, bar_below;      /* beside the clock, below all words; neither: no room */
    bool key_beside;                 /* beside the facts */
};

static bool has_bar(const struct bead_movie_wants *w, const struct bead_level *level)
{
    return w->axes && level->axes && !w->colourless;
}

/* In units of the ticks' size: beside a lying bar, for its outer numbers; its least length. */
static const double bar_pad = 1.2, least_bar = 4;

/* The number of views that are rows of coloured beads. */
static size_t rows_of_beads(const struct bead_movie_wants *w)
{
    size_t count = 0;
    for (size_t v = 0; v < w->view_count; v++)
        count += bead_view_has(w->views[v], BEAD_SHOWS_BEADS);
    return count;
}

/* The place of a horizontal bar: beside clock and badge, else in a separate line, until nothing coloured is left. */
static void place_for_bar(const struct bead_movie_wants *w, const struct bead_level *level, double room, double beside,
                          struct frame *f)
{
    const struct bead_look *look = w->look;
    const double most = room - w->bar_title - 2 * bar_pad * look->tick, least = least_bar * look->tick;
    f->bar_beside = f->lying && most - (room - beside) - 1.5 * look->gap >= least;
    f->bar_below = f->lying && !f->bar_beside && (level->images || rows_of_beads(w) > 0) && most >= least;
}

/* Images of several chains need all the room available. */
static bool roomy(const struct bead_movie_wants *w, const struct bead_level *level, bool stage)
{
    bool images = false;
    for (size_t v = 0; v < w->view_count; v++)
        images = images || bead_view_has(w->views[v], BEAD_SHOWS_IMAGE);
    return stage || (level->roomy && (w->chain_count == 1 || !images));
}

/* Clock and badge, the title beside them or below, lines of facts; the bar beside the cells, or lying beside the clock or below
 * them. The clock is above the first panel. */
static void measure_words(const struct bead_movie_wants *w, const struct bead_level *level, bool bar, bool stage, struct frame *f)
{
    const struct bead_look *look = w->look;
    int line = bead_cells_whole(1.35 * look->label), clock = bead_cells_whole(1.45 * look->title);
    f->margin = bead_cells_whole(roomy(w, level, stage) ? wide_margin * look->gap : look->gap);
    f->inset = stage ? bead_stage_inset(w) : 0;
    f->bar_width = bead_cells_whole(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE));
    f->bar_gap = bead_cells_whole(0.8 * look->tick);
    if (bar && !f->lying)
        f->right = f->bar_gap + bead_cells_whole(fmax(f->bar_width + w->bar, w->bar_title));
    double room = w->width - 2.0 * (f->margin + f->inset) - f->right - (stage ? 0 : w->left + fmax(w->along_end, w->time_end)),
           beside = room - w->time_width - 2 * look->gap;
    const double bar_beside = f->lying ? w->bar_title + 8 * look->tick : 0;
    bool title = w->title_width > 0 && level->titles;
    f->badge_beside = w->badge_width > 0 && w->badge_width + bar_beside <= beside;
    beside -= f->badge_beside ? w->badge_width + 2 * look->gap : 0;
    f->title_beside = title && !f->lying && w->title_width <= beside;
    const int lying = bead_cells_whole(fmax(clock, 0.5 * (clock + f->bar_width) + w->bar_below));
    place_for_bar(w, level, room, beside, f);
    f->row[CLOCK].least = f->bar_beside ? lying : clock;
    f->row[BAR].least = f->bar_below ? lying : 0;
    f->row[BADGE].least = w->badge_width > 0 && !f->badge_beside ? bead_cells_whole(1.5 * look->label) : 0;
    f->row[BADGE].gap =
        f->bar_beside && f->row[BADGE].least > 0 ? bead_cells_whole(0.5 * look->gap) : 0; /* numbers of the bar are above it */
    f->row[TITLE].least = title && !f->title_beside ? (w->title_width > room ? 2 : 1) * line : 0;
    f->row[FACTS].least = level->facts ? (w->facts ? (int)bead_facts_lines(look, w->facts, room) : 1) * line : 0;
    /* One key for all stages: left of facts that end at the right, else in separate lines. */
    const int key = stage ? bead_stage_key_lines(w) : 0;
    f->key_beside =
        key == 1 && f->title_beside && w->facts && bead_facts_lines(look, w->facts, room - w->key_width - 2 * look->gap) == 1;
    f->row[KEY].least = f->key_beside ? 0 : key * line;
    f->row[TRUST].least = w->trust ? line : 0;
    f->row[CELLS].gap = level->titles && !w->headings ? bead_cells_whole(0.5 * look->gap) : 0;
}

static struct frame measure_frame(const struct bead_movie_wants *w, const struct bead_level *level, bool stage)
{
    bool bar = has_bar(w, level) && !stage;
    struct frame f = {.lying = bar && w->width < wide_frame * w->height};
    bool words = w->axes && level->words;
    if (words)
        measure_words(w, level, bar, stage, &f);
    /* Captions are never left out: the scene asks for them. */
    f.row[CAPTION].least = w->axes ? bead_cells_whole(w->caption_lines * w->caption_line) : 0;
    f.row[CAPTION].gap = words && f.row[CAPTION].least > 0 ? bead_cells_whole(0.5 * w->look->gap) : 0;
    f.row[CELLS].share = f.row[CELLS].least = 1;
    return f;
}

/* False: there is no room for cells. */
static bool divide_frame(const struct bead_movie_wants *w, struct frame *f)
{
    struct bead_lanes rows = {.lane = f->row, .count = ROWS, .from = f->margin, .length = w->height - 2 * f->margin};
    return bead_lanes_divide(&rows);
}

static struct bead_rect row_of(const struct frame *f, size_t row, int left, int right)
{
    return (struct bead_rect){left, (int)f->row[row].at, right - left, (int)f->row[row].size};
}

/* Does the label, or M, need a line below the name in `room` px? */
static bool needs_label_line(const struct bead_movie_wants *w, double room, bool roomy)
{
    room -= BEAD_HEADING_AIR * w->look->tick;
    return w->heading_least > room || (roomy && w->heading_width > room);
}

/* Derives the rest from the level, the columns and the frame. */
static void complete(struct bead_cells *c, const struct frame *f)
{
    const struct bead_movie_wants *w = c->wants;
    bool beside = c->layout == BEAD_LAYOUT_BESIDE, overlay = c->layout == BEAD_LAYOUT_OVERLAY && w->view_count == 1;
    double room = (w->width - 2 * f->margin - f->right - (beside ? 2 : 1) * w->left) /
                  (double)(overlay ? w->chain_count : c->columns); /* names share a line above the one plot */
    c->rows = (w->chain_count + c->columns - 1) / c->columns;
    c->axes = w->axes && c->level->axes;
    c->headings = w->axes && w->headings && c->level->headings;
    c->label_lines = needs_label_line(w, (beside ? 0.36 : 1) * room, c->level->roomy);
    c->area = row_of(f, CELLS, f->margin, w->width - f->margin - f->right);
}

static void place_words(const struct bead_movie_wants *w, const struct frame *f, int left, int right,
                        struct bead_movie_layout *layout)
{
    int gap = bead_cells_whole(w->look->gap), height = bead_cells_whole(1.45 * w->look->title);
    int time = bead_cells_whole(w->time_width) < right - left ? bead_cells_whole(w->time_width) : right - left, x = left + time;
    if (f->row[CLOCK].size == 0 || right <= left)
        return;
    layout->time = (struct bead_rect){left, f->margin, time, height};
    layout->words_left = f->lying || !(f->title_beside || (w->title_width == 0 && w->width > 1.2 * w->height));
    if (f->badge_beside) {
        layout->badge = (struct bead_rect){x + 2 * gap, f->margin, bead_cells_whole(w->badge_width), height};
        x = layout->badge.x + layout->badge.width;
    }
    if (f->title_beside)
        layout->title = (struct bead_rect){x + 2 * gap, f->margin, right - x - 2 * gap, height};
    struct bead_rect *lines[ROWS] = {[BADGE] = &layout->badge,
                                     [TITLE] = &layout->title,
                                     [FACTS] = &layout->facts,
                                     [KEY] = &layout->key,
                                     [TRUST] = &layout->trust};
    for (size_t row = BADGE; row <= TRUST; row++) {
        if (f->row[row].size > 0)
            *lines[row] = row_of(f, row, left, right);
    }
    const int key = f->key_beside ? bead_cells_whole(w->key_width) : 0;
    if (key > 0) {
        layout->key = row_of(f, FACTS, left, left + key);
        layout->facts = row_of(f, FACTS, left + key + gap, right);
    }
}

static void place_standing_bar(const struct bead_movie_wants *w, const struct frame *f, const struct bead_cells *cells,
                               struct bead_movie_layout *layout)
{
    int pad = bead_cells_whole(0.6 * w->look->tick), x = w->width - f->margin - f->right + f->bar_gap;
    struct bead_insets in = bead_layout_insets(cells->grid, (struct bead_rect){0, 0, w->width, w->height});
    int top = (int)in.top, bottom = w->height - (int)in.bottom;
    const struct bead_lane *first = cells->grid->rows.lane;
    layout->bar_title = (struct bead_rect){x, (int)(first->at - first->reach[0]), w->width - f->margin - x,
                                           bead_cells_whole(1.35 * w->look->label)};
    if (w->headings && cells->headings) /* on one line with these */
        layout->bar_title.height = bead_cells_whole(1.45 * w->look->title);
    int least = layout->bar_title.y + layout->bar_title.height;
    top = (top > least ? top : least) + pad;
    bottom -= pad;
    if (bottom - top >= 8)
        layout->bar = (struct bead_rect){x, top, f->bar_width, bottom - top};
    else
        layout->bar_title = (struct bead_rect){0};
}

/* Right of the clock, level with it, as far as there is room; or in its own line, below the words. */
static void place_lying_bar(const struct bead_movie_wants *w, const struct frame *f, struct bead_movie_layout *layout)
{
    const bool below = f->bar_below;
    int pad = bead_cells_whole(bar_pad * w->look->tick), title = bead_cells_whole(w->bar_title + (below ? 0 : 0.5 * w->look->gap)),
        most = (int)(0.4 * w->width);
    int right = w->width - f->margin - pad,
        left = layout->time.x + layout->time.width + bead_cells_whole(w->look->gap) + title + pad;
    if (f->badge_beside)
        left = layout->badge.x + layout->badge.width + bead_cells_whole(w->look->gap) + title + pad;
    if (below)
        left = layout->time.x + title + pad;
    int length = right - left, top = below ? (int)f->row[BAR].at : f->margin;
    length = length < most || below ? length : most;
    if (length < least_bar * w->look->tick)
        return;
    layout->bar = (struct bead_rect){right - length, top + (layout->time.height - f->bar_width) / 2, length, f->bar_width};
    layout->bar_title = (struct bead_rect){layout->bar.x - pad - title, top, title, layout->time.height};
}

/* ---- the choice ---- */

/* Rows of beads alone need no more height: fewer columns make them larger. Other cells have a best shape. */
static double shape_cost(const struct bead_cells *c)
{
    const double width = (double)c->area.width / (double)c->columns, height = (double)c->area.height / (double)c->rows;
    return rows_of_beads(c->wants) == c->wants->view_count ? log((double)c->columns)
                                                           : bead_layout_misfit(width, height, best_shape);
}

/* The distance of an arrangement of cells from the ideal. */
static double cost_of(const struct bead_cells *c)
{
    double holes = (double)(c->rows * c->columns - c->wants->chain_count) / (double)c->wants->chain_count;
    double names = c->label_lines && c->level->roomy ? level_costs : 0; /* two lines of names also leave less room */
    names += c->level->titles ? 0 : never;
    return names + level_costs * (double)(c->level - bead_levels) + shape_cost(c) + hole_costs * holes;
}

static bool fits(struct bead_cells *c, struct bead_movie_layout *to)
{
    const struct bead_movie_wants *w = c->wants;
    struct frame f = measure_frame(w, c->level, false);
    if (!divide_frame(w, &f))
        return false;
    complete(c, &f);
    if (!bead_cells_place(c, to))
        return false;
    to->layout = c->layout;
    to->axes = c->axes;
    to->titles = c->level->titles;
    to->label_lines = c->label_lines;
    to->overlay = bead_cells_overlay(c);
    to->beyond[0] = c->beyond[0];
    to->beyond[1] = c->beyond[1];
    const struct bead_lane *last = &c->grid->columns.lane[c->grid->columns.count - 1];
    place_words(w, &f, to->chains[0].plot[0].x - (bead_movie_across(w, 0) == BEAD_ACROSS_CHAIN ? to->beyond[0] : 0),
                (int)(last->at + last->size) + to->beyond[1], to);
    if (f.bar_beside || f.bar_below)
        place_lying_bar(w, &f, to);
    else if (has_bar(w, c->level) && !f.lying)
        place_standing_bar(w, &f, c, to);
    if (f.row[CAPTION].size > 0)
        to->caption = row_of(&f, CAPTION, f.margin, w->width - f.margin);
    const bool promised = w->layout == BEAD_LAYOUT_IMAGES && bead_cells_promised(c) > 0;
    const bool coloured = has_bar(w, c->level) && (c->level->images || rows_of_beads(w) > 0);
    to->lacks = w->axes && (!c->level->facts || (coloured && to->bar.width == 0)) ? BEAD_LACKS_WORDS
                : w->axes && c->level->least[2] == 0                              ? BEAD_LACKS_NUMBERS
                : promised && !c->level->images                                   ? BEAD_LACKS_IMAGES
                                                                                  : BEAD_LACKS_NOTHING;
    return true;
}

/* The least and the greatest number of columns of cells. */
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

/* Without other views, profiles tell several chains apart only on one axis. */
static enum bead_layout resolved(const struct bead_movie_wants *w)
{
    bool overlays = w->chain_count > 1 && w->chain_count <= 6 && !w->follow;
    for (size_t v = 0; v < w->view_count; v++)
        overlays = overlays && bead_view_has(w->views[v], BEAD_OVERLAYS);
    if (w->layout == BEAD_LAYOUT_AUTO && overlays)
        return BEAD_LAYOUT_OVERLAY;
    return w->layout == BEAD_LAYOUT_IMAGES || w->layout == BEAD_LAYOUT_STAGE ? BEAD_LAYOUT_AUTO : w->layout;
}

/* The name of a layout with this number of columns. */
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

/* Plans from number `first`, with or without a line for labels, whose images are no smaller, and beads no larger, than those of
 * `least`. */
struct plans {
    size_t first;
    bool label_lines;
    const struct bead_stage_plan *least; /* NULL: any */
};

/* Places a stage by the first plan with enough room. Returns its number; BEAD_STAGE_PLANS: none. */
static size_t place_from(const struct bead_movie_wants *w, struct bead_rect area, struct plans plans, struct bead_movie_layout *to)
{
    for (size_t i = plans.first; i < BEAD_STAGE_PLANS; i++) {
        const struct bead_stage_plan *plan = &bead_stage_plans[i];
        if (plans.least &&
            (plan->images < plans.least->images || plan->beads > plans.least->beads || plan->curve != plans.least->curve))
            continue;
        forget(to);
        to->label_lines = plans.label_lines;
        if (bead_stage_place(w, plan, area, to))
            return i;
    }
    return BEAD_STAGE_PLANS;
}

/* Would labels fit below names, if not beside them? Dashes before names stay, and so does a key on the stage. */
static bool labels_below(const struct bead_movie_wants *w, double room)
{
    return !bead_stage_keyed(w) && needs_label_line(w, room, true) && BEAD_SMALLER_LABEL * w->label_width <= label_part * room;
}

/* A stage with all words. On upright frames, labels that do not fit beside names are below them, if no image is given up for
 * that. */
static bool stage_by_plan(const struct bead_movie_wants *w, struct bead_movie_layout *to)
{
    const struct bead_level *level = &bead_levels[w->axes ? 0 : BEAD_LEVELS - 1];
    struct frame f = measure_frame(w, level, true);
    bool asked = w->layout == BEAD_LAYOUT_AUTO || w->layout == BEAD_LAYOUT_STAGE;
    if (!asked || bead_stage_view(w) == w->view_count || !divide_frame(w, &f))
        return false;
    struct bead_rect area = row_of(&f, CELLS, f.margin, w->width - f.margin);
    const double room = (double)area.width / (double)bead_stage_columns(w);
    const bool needed = needs_label_line(w, room, false), wanted = w->height > w->width && !needed && labels_below(w, room);
    size_t plan = place_from(w, area, (struct plans){0, needed, NULL}, to);
    if (plan == BEAD_STAGE_PLANS)
        return false;
    if (wanted && place_from(w, area, (struct plans){0, true, &bead_stage_plans[plan]}, to) == BEAD_STAGE_PLANS)
        plan = place_from(w, area, (struct plans){plan, false, NULL}, to);
    to->layout = BEAD_LAYOUT_STAGE;
    to->axes = to->titles = w->axes;
    to->curve = bead_stage_plans[plan].curve;
    place_words(w, &f, area.x + f.inset, area.x + area.width - f.inset, to);
    if (f.row[CAPTION].size > 0)
        to->caption = row_of(&f, CAPTION, f.margin, w->width - f.margin);
    return true;
}

/* A key above all stages is given up before the curve. */
static bool stage(const struct bead_movie_wants *w, struct bead_movie_layout *to)
{
    const bool placed = stage_by_plan(w, to);
    if ((placed && to->curve) || bead_stage_key_lines(w) == 0 || bead_stage_columns(w) > 1)
        return placed;
    struct bead_movie_wants keyless = *w;
    keyless.key_width = 0;
    return stage_by_plan(&keyless, to);
}

/* Chooses the best of all levels and numbers of columns. False: the frame is too small. */
static bool choose(const struct bead_movie_wants *w, struct bead_layout_grid *grid, struct bead_movie_layout *layout)
{
    enum bead_layout asked = resolved(w);
    struct bead_cells best = {.level = NULL};
    const struct bead_level *end = bead_levels + BEAD_LEVELS;
    size_t range[2];
    double least = INFINITY;
    column_range(w, asked, range);
    for (size_t columns = range[0]; columns <= range[1]; columns++) {
        struct bead_cells cells = {.wants = w, .layout = named(w, asked, columns), .columns = columns, .grid = grid};
        for (cells.level = w->axes ? bead_levels : end - 1; cells.level < end; cells.level++) {
            forget(layout);
            if (fits(&cells, layout))
                break;
        }
        if (cells.level < end && cost_of(&cells) < least) {
            best = cells;
            least = cost_of(&cells);
        }
    }
    forget(layout);
    return best.level && fits(&best, layout);
}

enum bead_error bead_movie_arrange(const struct bead_movie_wants *wants, struct bead_movie_layout *layout, struct bead_message *msg)
{
    size_t chains = wants->chain_count, views = wants->view_count;
    struct bead_layout_grid grid;
    *layout = (struct bead_movie_layout){.chain_count = chains, .chains = calloc(chains + 1, sizeof *layout->chains)};
    /* Grids may have empty cells, and cells may have two plots side by side. */
    enum bead_error err =
        bead_layout_make(2 * (chains + MOST_COLUMNS), (2 * chains + MOST_COLUMNS) * (views + 1), chains * views, &grid, msg);
    if (!err && !layout->chains)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a layout");
    if (!err && (chains > MOST_CHAINS || (!stage(wants, layout) && !choose(wants, &grid, layout))))
        err = bead_fail(msg, BEAD_ERROR_SCENE, "size: %d x %d pixels are too small for %zu views of %zu chains", wants->width,
                        wants->height, views, chains);
    if (err)
        bead_movie_layout_free(layout);
    bead_layout_free(&grid);
    return err;
}

void bead_movie_layout_free(struct bead_movie_layout *layout)
{
    free(layout->chains);
    *layout = (struct bead_movie_layout){.chains = NULL};
}
