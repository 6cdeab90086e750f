/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes in a grid: sizes and places of rows and columns. */
#include "render/draw/layout.h"

#include <math.h>
#include <stdlib.h>

/* Rounding errors may lower a whole number of pixels by this much. */
static const double rounding = 1e-6;

static double down(double px)
{
    return floor(px + rounding);
}

/* ---- one direction ---- */

void bead_lanes_want(struct bead_lane *lanes, size_t count, struct bead_lane want)
{
    for (size_t i = 0; i < count; i++) {
        lanes[i] = want;
        lanes[i].gap = i > 0 ? want.gap : 0;
    }
}

void bead_lanes_within(struct bead_lanes *lanes, double from, double length)
{
    lanes->from = from;
    lanes->length = length;
}

double bead_lanes_fixed(const struct bead_lanes *l)
{
    double px = 0;
    for (size_t i = 0; i < l->count; i++) {
        const struct bead_lane *lane = &l->lane[i];
        px += lane->gap + ceil(lane->reach[0]) + ceil(lane->reach[1]) + (lane->share > 0 ? 0 : ceil(lane->least));
    }
    return px;
}

double bead_lanes_least(const struct bead_lanes *l)
{
    double px = bead_lanes_fixed(l);
    for (size_t i = 0; i < l->count; i++)
        px += l->lane[i].share > 0 ? ceil(l->lane[i].least) : 0;
    return px;
}

/* Is the size of a lane still undecided? */
static bool is_open(const struct bead_lane *lane)
{
    return isnan(lane->size);
}

/* px for each unit of the open lanes' shares. */
static double px_of_share(const struct bead_lanes *l, double room)
{
    double shares = 0;
    for (size_t i = 0; i < l->count; i++) {
        const struct bead_lane *lane = &l->lane[i];
        shares += is_open(lane) ? lane->share : 0;
        room -= is_open(lane) || !(lane->share > 0) ? 0 : lane->size;
    }
    return shares > 0 ? fmax(0, room) / shares : 0;
}

/* The pixels of `part` that a lane gets. */
static double within(const struct bead_lane *lane, double part)
{
    return part < lane->least ? ceil(lane->least) : lane->most > 0 && down(part) > lane->most ? down(lane->most) : part;
}

/* Closes open lanes that would get less than their least, or those that would get more than their most, at that size: first the
 * kind that differs more in total (as in lines of CSS's flexible boxes). True: there was one. */
static bool close_some(struct bead_lanes *l, double room)
{
    const double px = px_of_share(l, room);
    double over = 0;
    bool any = false;
    for (size_t i = 0; i < l->count; i++)
        over += is_open(&l->lane[i]) ? within(&l->lane[i], px * l->lane[i].share) - px * l->lane[i].share : 0;
    for (size_t i = 0; i < l->count; i++) {
        struct bead_lane *lane = &l->lane[i];
        const double part = px * lane->share, size = is_open(lane) ? within(lane, part) : part;
        if (size == part || (over > 0) == (size < part))
            continue;
        lane->size = size;
        any = true;
    }
    return any;
}

/* Returns the px that no lane uses; < 0: that many are missing. */
static double size_lanes(struct bead_lanes *l)
{
    double room = l->length - bead_lanes_fixed(l), px;
    for (size_t i = 0; i < l->count; i++)
        l->lane[i].size = l->lane[i].share > 0 ? NAN : ceil(l->lane[i].least);
    while (close_some(l, room))
        ;
    px = px_of_share(l, room);
    for (size_t i = 0; i < l->count; i++) {
        struct bead_lane *lane = &l->lane[i];
        lane->size = is_open(lane) ? down(px * lane->share) : lane->size;
        room -= lane->share > 0 ? lane->size : 0;
    }
    return room;
}

static void place_lanes(struct bead_lanes *l, double spare)
{
    double at = l->from, springs = l->spring;
    for (size_t i = 0; i < l->count; i++)
        springs += l->lane[i].spring;
    double stretch = springs > 0 && spare > 0 ? down(spare / springs) : 0;
    for (size_t i = 0; i < l->count; i++) {
        struct bead_lane *lane = &l->lane[i];
        for (int side = 0; side < 2; side++)
            lane->reach[side] = ceil(lane->reach[side]);
        lane->at = at + lane->gap + down(stretch * lane->spring) + lane->reach[0];
        at = lane->at + lane->size + lane->reach[1];
    }
}

bool bead_lanes_divide(struct bead_lanes *lanes)
{
    bool fits = true;
    for (size_t first = 0, next; first < lanes->count; first = next) {
        for (next = first; next < lanes->count && lanes->lane[next].line == lanes->lane[first].line;)
            next++;
        struct bead_lanes line = *lanes;
        line.lane += first;
        line.count = next - first;
        double spare = size_lanes(&line);
        place_lanes(&line, spare);
        fits = fits && spare >= -rounding;
    }
    return fits;
}

/* ---- both ---- */

enum bead_error bead_layout_make(size_t columns, size_t rows, size_t boxes, struct bead_layout_grid *grid, struct bead_message *msg)
{
    struct bead_lane *lanes = calloc(columns + rows + 1, sizeof *lanes);
    *grid = (struct bead_layout_grid){.columns = {.lane = lanes, .count = columns},
                                      .rows = {.lane = lanes ? lanes + columns : NULL, .count = rows},
                                      .boxes = calloc(boxes + 1, sizeof *grid->boxes),
                                      .count = boxes};
    if (lanes && grid->boxes)
        return BEAD_OK;
    bead_layout_free(grid);
    return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for a layout");
}

void bead_layout_free(struct bead_layout_grid *grid)
{
    free(grid->columns.lane);
    free(grid->boxes);
    *grid = (struct bead_layout_grid){.count = 0};
}

static size_t last_of(size_t first, size_t count)
{
    return first + (count > 0 ? count - 1 : 0);
}

static void forget_reach(struct bead_lanes *l, bool grow)
{
    for (size_t i = 0; i < l->count; i++) {
        struct bead_lane *lane = &l->lane[i];
        for (int side = 0; side < 2; side++)
            lane->reach[side] = grow ? fmax(lane->reach[side], lane->keep[side]) : lane->keep[side];
    }
}

static void reach_out(struct bead_lanes *l, size_t first, size_t count, double before, double after)
{
    double *reach[2] = {&l->lane[first].reach[0], &l->lane[last_of(first, count)].reach[1]};
    *reach[0] = fmax(*reach[0], before);
    *reach[1] = fmax(*reach[1], after);
}

void bead_layout_reach(struct bead_layout_grid *g, bool grow)
{
    forget_reach(&g->columns, grow);
    forget_reach(&g->rows, grow);
    for (size_t i = 0; i < g->count; i++) {
        const struct bead_layout_box *box = &g->boxes[i];
        reach_out(&g->columns, box->column, box->columns, box->reach.left, box->reach.right);
        reach_out(&g->rows, box->row, box->rows, box->reach.top, box->reach.bottom);
    }
}

static void place_box(const struct bead_lanes *l, size_t first, size_t count, int *at, int *size)
{
    const struct bead_lane *last = &l->lane[last_of(first, count)];
    *at = (int)round(l->lane[first].at);
    *size = (int)round(last->at + last->size) - *at;
}

bool bead_layout_divide(struct bead_layout_grid *g, const struct bead_layout_owner *owner)
{
    bool wide = bead_lanes_divide(&g->columns);
    if (owner && owner->heights)
        owner->heights(owner->user);
    bool high = bead_lanes_divide(&g->rows);
    for (size_t i = 0; i < g->count; i++) {
        struct bead_layout_box *box = &g->boxes[i];
        place_box(&g->columns, box->column, box->columns, &box->at.x, &box->at.width);
        place_box(&g->rows, box->row, box->rows, &box->at.y, &box->at.height);
    }
    return wide && high;
}

struct bead_insets bead_layout_insets(const struct bead_layout_grid *g, struct bead_rect area)
{
    double right = area.x + area.width, bottom = area.y + area.height;
    struct bead_insets in = {INFINITY, INFINITY, INFINITY, INFINITY};
    for (size_t i = 0; i < g->count; i++) {
        const struct bead_rect *at = &g->boxes[i].at;
        in.left = fmin(in.left, at->x - area.x);
        in.top = fmin(in.top, at->y - area.y);
        in.right = fmin(in.right, right - at->x - at->width);
        in.bottom = fmin(in.bottom, bottom - at->y - at->height);
    }
    return in;
}

enum bead_error bead_layout_settle(struct bead_layout_grid *grid, int passes, bool grow, const struct bead_layout_owner *owner,
                                   struct bead_message *msg)
{
    double before = -1;
    for (int pass = 0;; pass++) {
        if (!bead_layout_divide(grid, owner))
            return owner->no_room(owner->user, msg);
        double fixed = bead_lanes_fixed(&grid->columns) + bead_lanes_fixed(&grid->rows);
        if (pass >= passes && !(grow && (pass == passes || fixed > before)))
            return BEAD_OK;
        before = fixed;
        BEAD_TRY(owner->measure(owner->user, msg));
        bead_layout_reach(grid, pass >= passes);
    }
}

/* ---- choices ---- */

double bead_layout_misfit(double width, double height, double shape)
{
    return fabs(log(width / height / shape));
}

size_t bead_layout_columns(size_t count, const struct bead_layout_area *area)
{
    double best = INFINITY;
    size_t found = 1;
    for (size_t columns = 1; columns <= count; columns++) {
        size_t rows = (count + columns - 1) / columns;
        double width = area->width / (double)columns - area->around[0], height = area->height / (double)rows - area->around[1];
        double empty = (double)(columns * rows - count) / (double)(columns * rows);
        double cost = width > 0 && height > 0 ? bead_layout_misfit(width, height, area->shape) + area->empty * empty : INFINITY;
        if (cost < best) {
            best = cost;
            found = columns;
        }
    }
    return found;
}
