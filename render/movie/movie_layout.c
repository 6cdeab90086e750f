/* The layout of a movie's frame. Levels leave out words, headings and axes one after the other until the plots fit; composer.c asks
 * for it once. */
#include "render/movie/movie_layout.h"

#include <math.h>
#include <stdlib.h>

/* What is left out, in this order, until the rest fits. */
enum level { EVERYTHING, NO_WORDS, FEW_LABELS, TIGHT, NO_HEADINGS, NO_AXES, VIEWS_ONLY, LEVELS };

/* Lengths of one level, px. */
struct measures {
    enum level level;
    bool axes, headings;
    int margin, left, right, top, bottom; /* around the plots */
    int heading, view_gap, chain_gap;
    int bar_gap, bar_width;
    int width;    /* of the plots */
    bool stacked; /* words below the time, not beside it */
    int time_height, line_height;
    int caption; /* height of captions, between the lowest axis and the margin */
};

static int whole(double x)
{
    return (int)ceil(x);
}

/* Axes and what views draw beside their plots. */
static double left_of_plots(const struct bead_movie_wants *w)
{
    double most = w->left;
    for (size_t i = 0; i < w->view_count; i++) {
        int left = 0, right = 0;
        if (w->views[i]->margins)
            w->views[i]->margins(w->look, &left, &right);
        most = fmax(most, left);
    }
    return most;
}

static struct measures layout_measure(const struct bead_movie_wants *w, enum level level)
{
    const struct bead_look *look = w->look;
    struct measures m = {
        .level = level, .axes = w->axes && level < NO_AXES, .headings = w->axes && w->headings && level < NO_HEADINGS};
    /* Labels at the ends of vertical axes reach out by half their height; tight plots have no labels. */
    m.view_gap = whole(level < FEW_LABELS ? 1.1 * look->tick : m.axes && level != TIGHT ? look->tick : 0.7 * look->gap);
    m.view_gap = level == VIEWS_ONLY ? 0 : m.view_gap;
    m.chain_gap = level == VIEWS_ONLY ? 0 : whole((level < FEW_LABELS ? 1.5 : 0.7) * look->gap);
    if (w->axes && level < VIEWS_ONLY) {
        m.margin = whole(1.3 * look->gap);
        m.time_height = whole(1.45 * look->title);
        m.line_height = whole(1.4 * look->label);
        m.stacked = w->width < w->time_width + 22 * look->label;
    }
    int lines = m.time_height ? (level == EVERYTHING ? 1 + w->title : 0) + w->trust : 0;
    int words = lines * m.line_height;
    int header = m.stacked ? m.time_height + words : words > m.time_height ? words : m.time_height;
    m.top = m.time_height > 0 ? m.margin + header : 0;
    m.heading = m.headings ? whole((level < FEW_LABELS ? 1.7 : level < TIGHT ? 1.5 : 1.15) * look->title) : 0;
    if (m.top > 0 && !m.headings)
        m.top += whole(0.5 * look->gap);
    m.left = m.right = m.margin;
    if (m.axes) {
        m.left += whole(left_of_plots(w));
        m.bar_gap = whole(1.8 * look->gap);
        m.bar_width = whole(bead_colour_bar_width(look, BEAD_BAR_OF_MOVIE));
        m.right += w->colourless ? 0 : m.bar_gap + m.bar_width + whole(w->bar);
    }
    /* The scene asks for captions: they are never left out. */
    m.caption = w->axes ? whole(w->caption_lines * w->caption_line) : 0;
    m.bottom = m.margin + m.caption + (m.caption > 0 ? whole(0.5 * look->gap) : 0);
    m.width = w->width - m.left - m.right;
    return m;
}

static bool moves(const struct bead_movie_wants *w, size_t view)
{
    return w->follow && bead_view_has(w->views[view], BEAD_FOLLOWS_FRONT);
}

static bool shows_beads(const struct bead_movie_wants *w, size_t view)
{
    return bead_view_has(w->views[view], BEAD_SHOWS_BEADS);
}

static bool has_bead_axis(const struct bead_movie_wants *w, size_t view)
{
    return !moves(w, view) && !shows_beads(w, view) && w->views[view]->info->across == BEAD_ACROSS_CHAIN;
}

/* The last of the moving views has the numbers. */
static bool labels_window(const struct bead_movie_wants *w, size_t view)
{
    bool last = moves(w, view);
    for (size_t i = view + 1; i < w->view_count; i++)
        last = last && !moves(w, i);
    return last;
}

/* The lowest view with a bead axis labels it for those above; without one, the row of beads has the numbers. */
static bool labels_beads(const struct bead_movie_wants *w, size_t view)
{
    size_t best = w->view_count;
    for (size_t i = 0; i < w->view_count; i++) {
        if (has_bead_axis(w, i))
            best = i;
    }
    for (size_t i = 0; best == w->view_count && i < w->view_count; i++)
        best = shows_beads(w, i) ? i : best;
    return view == best;
}

static bool labelled(const struct bead_movie_wants *w, const struct measures *m, size_t chain, size_t view)
{
    bool lowest = chain + 1 == w->chain_count;
    if (!m->axes)
        return false;
    if (w->views[view]->info->across != BEAD_ACROSS_CHAIN)
        return lowest;
    if (moves(w, view))
        return labels_window(w, view) && m->level < FEW_LABELS;
    bool one_for_all = w->same_beads ? lowest : m->level < FEW_LABELS;
    return labels_beads(w, view) && (one_for_all || shows_beads(w, view));
}

static int below(const struct bead_movie_wants *w, const struct measures *m, size_t chain, size_t view)
{
    if (!labelled(w, m, chain, view) || shows_beads(w, view))
        return 0;
    if (moves(w, view))
        return whole(w->below_moving);
    return whole(w->views[view]->info->across == BEAD_ACROSS_TIME ? w->below_time : w->below_beads);
}

/* Rows that follow the front show large beads and get the height these need, if there is room. */
static double layout_share_of(const struct bead_movie_wants *w, size_t view)
{
    return (moves(w, view) && shows_beads(w, view) ? 1.5 : 1) * w->views[view]->info->movie_share;
}

static int layout_most_height(const struct bead_movie_wants *w, const struct measures *m, size_t view)
{
    if (moves(w, view) && shows_beads(w, view))
        return whole((w->sensors || labels_window(w, view) ? 1.35 * w->look->tick : 0) +
                     fmax(1.3 * w->bead_height, w->bead_height + w->look->gap));
    return whole(w->views[view]->info->movie_most * m->width);
}

/* The least average height of a view: labels are left out before plots become too low to read. */
static int least_height(const struct bead_movie_wants *w, const struct measures *m)
{
    int least = m->level == VIEWS_ONLY ? 1 : 12, readable = whole(1.6 * w->look->tick);
    return m->level < FEW_LABELS && w->view_count > 1 && readable > least ? readable : least;
}

static struct bead_stack make_stack(const struct bead_movie_wants *w, const struct measures *m, struct bead_stack_reach *reach)
{
    struct bead_stack stack = {.rows = w->chain_count,
                               .views = w->view_count,
                               .heading = m->heading,
                               .between_rows = m->chain_gap,
                               .between_views = m->view_gap,
                               .reach = reach};
    for (size_t i = 0; i < w->chain_count * w->view_count; i++)
        reach[i] = (struct bead_stack_reach){0, below(w, m, i / w->view_count, i % w->view_count)};
    for (size_t v = 0; v < w->view_count; v++) {
        int most = layout_most_height(w, m, v);
        stack.share[v] = layout_share_of(w, v);
        stack.most[v] = m->level < VIEWS_ONLY && most > 0 ? most : INFINITY;
    }
    return stack;
}

static void place_header(const struct bead_movie_wants *w, const struct measures *m, struct bead_movie_layout *layout)
{
    int right = m->left + m->width, top = m->margin, gap = whole(w->look->gap);
    if (m->time_height == 0)
        return;
    int time_width = whole(w->time_width) < m->width ? whole(w->time_width) : m->width;
    layout->time = (struct bead_rect){m->left, top, time_width, m->time_height};
    int x = m->stacked ? m->left : m->left + time_width + 2 * gap;
    int y = m->stacked ? top + m->time_height : top;
    if (right <= x)
        return;
    struct bead_rect line = {x, y, right - x, m->line_height};
    if (w->title && m->level == EVERYTHING) {
        layout->title = line;
        line.y += line.height;
    }
    if (m->level == EVERYTHING) {
        layout->facts = line;
        line.y += line.height;
    }
    if (w->trust)
        layout->trust = line;
}

/* False: there is no room. */
static bool place_chains(const struct bead_movie_wants *w, const struct measures *m, struct bead_stack_reach *reach,
                         struct bead_movie_layout *layout)
{
    struct bead_stack stack = make_stack(w, m, reach);
    int chains = (int)w->chain_count, room = (w->height - m->top - m->bottom - (int)bead_stack_fixed(&stack)) / chains;
    if (room < least_height(w, m) * (int)w->view_count || m->width < (m->level == VIEWS_ONLY ? 1 : 80))
        return false;
    int spare = (room - bead_stack_divide(&stack, room)) * chains;
    double y = m->top + spare / (2 * chains);
    stack.between_rows += spare / chains;
    for (size_t c = 0; c < w->chain_count; c++) {
        struct bead_movie_chain *chain = &layout->chains[c];
        struct bead_stack_places places;
        y = bead_stack_row(&stack, c, y, &places) + stack.between_rows;
        if (m->heading)
            chain->heading = (struct bead_rect){m->left, places.heading, m->width, m->heading};
        for (size_t v = 0; v < w->view_count; v++) {
            if (stack.height[v] < 1)
                return false;
            chain->plot[v] = (struct bead_rect){m->left, places.plot[v], m->width, stack.height[v]};
            chain->labels[v] = labelled(w, m, c, v);
        }
    }
    return true;
}

static void place_bar(const struct bead_movie_wants *w, const struct measures *m, struct bead_movie_layout *layout)
{
    if (!m->axes || w->colourless)
        return;
    const struct bead_rect *first = &layout->chains[0].plot[0];
    const struct bead_rect *last = &layout->chains[w->chain_count - 1].plot[w->view_count - 1];
    int pad = whole(0.5 * w->look->tick); /* half a label at both ends */
    int from = first->y + pad, to = last->y + last->height - pad;
    if (to - from >= 8)
        layout->bar = (struct bead_rect){m->left + m->width + m->bar_gap, from, m->bar_width, to - from};
}

/* Leaves out as little as possible. False: the frame is too small. */
static bool layout_arrange(const struct bead_movie_wants *wants, struct bead_stack_reach *reach, struct bead_movie_layout *layout)
{
    for (enum level level = wants->axes ? EVERYTHING : VIEWS_ONLY; level < LEVELS; level++) {
        struct measures m = layout_measure(wants, level);
        if (wants->chain_count > 100000 || !place_chains(wants, &m, reach, layout))
            continue;
        layout->axes = m.axes;
        layout->ticks_only = level == TIGHT;
        place_header(wants, &m, layout);
        place_bar(wants, &m, layout);
        if (m.caption > 0)
            layout->caption =
                (struct bead_rect){m.margin, wants->height - m.margin - m.caption, wants->width - 2 * m.margin, m.caption};
        return true;
    }
    return false;
}

enum bead_error bead_movie_arrange(const struct bead_movie_wants *wants, struct bead_movie_layout *layout, struct bead_message *msg)
{
    enum bead_error err = BEAD_OK;
    struct bead_stack_reach *reach = calloc(wants->chain_count * wants->view_count + 1, sizeof *reach);
    *layout = (struct bead_movie_layout){.chain_count = wants->chain_count};
    layout->chains = calloc(wants->chain_count + 1, sizeof *layout->chains);
    if (!layout->chains || !reach)
        err = bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a layout");
    else if (!layout_arrange(wants, reach, layout))
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
