/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plans the drawing of an experiment: tries fewer beads of each chain, and smaller ones, until everything fits. schematic_setup.c
 * draws it. */
#include "render/schematic/schematic_plan.h"

#include <math.h>
#include <stdlib.h>

#include "render/draw/words.h"

/* In units of the label's font size. */
static const double header_height = 1.7, label_line = 1.3, leader = 1.0, arrow_room = 0.95, guide_height = 0.28,
                    brace_height = 1.05, wall_width = 1.3, gap_width = 2.0, between_rows = 1.1, lowest_row = 8, most_drop = 5.5;
/* Radius of the largest bead, in units of the label's font size: preferred sizes in this order, and the smallest acceptable one. */
static const double largest_ball = 2.2, least_ball[][2] = {{0.9, 0.5}, {0.22, 0}};
/* Choices, best first: entries of `beads` shown, and beads shown of each. */
static const size_t entries[] = {BEAD_PLAN_PARTS - 2, 24, 16, 12, 9, 7, 5, 4, 3, 2};
static const size_t shown[] = {400, 60, 40, 30, 24, 18, 14, 10, 8, 6, 4, 3, 2};

static void free_strip(const struct bead_plan *plan, struct bead_strip *strip)
{
    plan->d->sketch->failed = plan->d->sketch->failed || strip->failed;
    bead_strip_free(strip);
}

void bead_plan_free(struct bead_plan *plan)
{
    for (size_t i = 0; plan->rows && i < plan->row_count; i++)
        free_strip(plan, &plan->rows[i].strip);
    free(plan->rows);
    free(plan->lanes.lane);
    plan->rows = NULL;
    plan->lanes.lane = NULL;
}

double bead_plan_wall(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    return bead_chain_spec(row->chain)->wall == BEAD_WALL_NONE ? 0 : wall_width * plan->em;
}

double bead_plan_header_y(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    return row->y + 0.6 * plan->em;
}

double bead_plan_above_y(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    return row->y + (header_height + 0.5 * label_line) * plan->em;
}

double bead_plan_below_y(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    return row->y + row->height - (plan->details ? 1.5 : 0.5) * label_line * plan->em;
}

double bead_plan_guide(const struct bead_plan_row *row, double x)
{
    return row->guide_y + row->slope * fmax(x - row->first_x, 0);
}

/* Places the striker on the ramp just before the chain, or beside it if it does not move; returns px from its left end to bead 1,
 * and its height above the guide. */
static void place_striker(const struct bead_plan *plan, struct bead_plan_row *row, double *width, double *top)
{
    const double r = row->striker_r = plan->scale * bead_chain_radius(row->chain)[0];
    if (row->level) {
        row->striker_x = row->first_x - r;
        row->striker_y = row->guide_y - plan->scale * row->largest;
        *width = 2 * r;
        *top = 2 * plan->scale * row->largest;
        return;
    }
    double angle = atan(BEAD_PLAN_ANGLE_PERCENT / 100.0), em = plan->em;
    double along = (r * (1 + sin(angle)) + 0.5 * em) / cos(angle);
    *width = fmax((along + r + 0.6 * em) * cos(angle) + 0.2 * em, 2.3 * em);
    row->foot_y = row->guide_y - fmax(plan->scale * row->largest - r, 0);
    row->striker_x = row->first_x - 0.2 * em - along * cos(angle) + r * sin(angle);
    double lift = along * sin(angle) + r * cos(angle);
    row->striker_y = row->foot_y - lift;
    *top = fmax(row->guide_y - row->striker_y + r + arrow_room * em, 2 * plan->scale * row->largest);
}

static bool anchor_labels(const struct bead_plan *plan, struct bead_plan_row *row)
{
    double low, high, em = plan->em, left = plan->area.x, right = plan->area.x + plan->area.width;
    struct bead_plan_labels *both[2] = {&row->above, &row->below};
    for (size_t k = 0; k < 2; k++) {
        for (size_t i = 0; i < both[k]->count; i++) {
            double at = k == 0 ? row->striker_x : row->end_x + 0.5 * bead_plan_wall(plan, row);
            if (both[k]->part[i] != SIZE_MAX && bead_strip_extent(&row->strip, both[k]->part[i], &low, &high))
                at = 0.5 * (low + high);
            both[k]->label[i].anchor = at;
        }
        if (!bead_labels_spread(both[k]->label, both[k]->count, 0.8 * em, left, right))
            return false;
    }
    return true;
}

/* Finds all positions in a row whose top is at 0; false: too wide. */
static bool place_row(const struct bead_plan *plan, struct bead_plan_row *row)
{
    const struct bead_scene *scene = plan->d->context->scene;
    double em = plan->em, width = bead_strip_width(&row->strip, scene, plan->scale, gap_width * plan->em), ramp, top;
    row->y = row->first_x = row->guide_y = 0;
    row->level = bead_chain_spec(row->chain)->striker_velocity == 0;
    place_striker(plan, row, &ramp, &top);
    double used = ramp + width + bead_plan_wall(plan, row), spare = plan->area.width - used;
    if (spare < 0)
        return false;
    row->slope = fmin(tan(bead_chain_spec(row->chain)->tilt), plan->drop * em / (width + bead_plan_wall(plan, row)));
    row->first_x = plan->area.x + 0.5 * spare + ramp;
    row->guide_y = (header_height + label_line + leader) * em + top;
    place_striker(plan, row, &ramp, &top);
    bead_strip_place(&row->strip, scene, plan->scale, gap_width * plan->em, row->first_x);
    row->end_x = row->first_x + width;
    double drop = row->slope * (width + bead_plan_wall(plan, row));
    double below = guide_height + brace_height + leader + (plan->details ? 2 : 1) * label_line;
    row->height = row->guide_y + drop + below * em;
    return anchor_labels(plan, row);
}

/* The spaces above, between and below rows share the remaining room. */
static bool place_rows(struct bead_plan *plan, size_t count)
{
    plan->drop = most_drop / (double)count;
    plan->lanes = (struct bead_lanes){.lane = plan->lanes.lane, .count = count, .spring = 1};
    bead_lanes_within(&plan->lanes, plan->area.y, plan->area.height);
    for (size_t i = 0; i < count; i++) {
        if (!place_row(plan, &plan->rows[i]))
            return false;
        plan->lanes.lane[i] =
            (struct bead_lane){.least = plan->rows[i].height, .gap = i > 0 ? between_rows * plan->em : 0, .spring = 1};
    }
    if (!bead_lanes_divide(&plan->lanes))
        return false;
    for (size_t i = 0; i < count; i++) {
        struct bead_plan_row *row = &plan->rows[i];
        row->y = plan->lanes.lane[i].at;
        row->guide_y += row->y;
        row->striker_y += row->y;
        row->foot_y += row->y;
    }
    return true;
}

/* Finds the largest scale at which everything fits. */
static bool find_scale(struct bead_plan *plan, size_t count, double least)
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, plan->rows[i].largest);
    for (double ball = largest_ball; ball >= least; ball *= 0.93) {
        plan->scale = ball * plan->em / largest;
        if (place_rows(plan, count))
            return true;
    }
    return false;
}

/* Tries a plan with this many entries of `beads`, and fewer and fewer beads of each. */
static bool try_rows(struct bead_plan *plan, size_t count, size_t parts, double least)
{
    struct bead_text_style style = bead_sketch_style(plan->d->sketch, plan->em);
    for (size_t i = 0; i < count; i++)
        plan->rows[i].part_count = bead_parts_make(plan->rows[i].chain, parts, plan->rows[i].parts);
    for (int details = 1; details >= 0; details--) {
        plan->details = details;
        for (size_t i = 0; i < count; i++)
            bead_parts_labels(&plan->rows[i], &style, details);
        for (size_t k = 0; k < sizeof shown / sizeof *shown; k++) {
            bool made = true;
            for (size_t i = 0; made && i < count; i++)
                made = bead_parts_strip(plan->rows[i].chain, plan->rows[i].parts, plan->rows[i].part_count, shown[k],
                                        &plan->rows[i].strip);
            if (made && find_scale(plan, count, least))
                return true;
        }
    }
    return false;
}

/* Prefers more entries to larger beads. */
static bool try_entries(struct bead_plan *plan, size_t count, const double least[2])
{
    for (size_t e = 0; e < sizeof entries / sizeof *entries; e++) {
        for (size_t l = 0; l < 2 && least[l] > 0; l++) {
            if (try_rows(plan, count, entries[e], least[l]))
                return true;
        }
    }
    return false;
}

static void find_largest(struct bead_plan *plan)
{
    for (size_t i = 0; i < plan->row_count; i++) {
        struct bead_plan_row *row = &plan->rows[i];
        row->chain = plan->d->context->chains[i];
        for (size_t j = 0; j < bead_chain_beads(row->chain); j++)
            row->largest = fmax(row->largest, bead_chain_radius(row->chain)[j]);
    }
}

bool bead_plan_make(const struct bead_drafting *d, struct bead_box area, struct bead_plan *plan)
{
    size_t count = d->context->chain_count;
    double row = lowest_row * d->sketch->look->label, gap = between_rows * d->sketch->look->label;
    size_t wanted = (size_t)fmax(0, fmin((double)count, floor((area.height + gap) / (row + gap))));
    *plan = (struct bead_plan){.d = d, .area = area, .em = d->sketch->look->label};
    plan->rows = calloc(count, sizeof *plan->rows);
    plan->lanes.lane = calloc(count, sizeof *plan->lanes.lane);
    if (!plan->rows || !plan->lanes.lane) {
        d->sketch->failed = true;
        return false; /* whatever is drawn is then refused */
    }
    plan->row_count = count;
    find_largest(plan);
    bool found = false;
    for (; wanted > 0 && !found; wanted -= !found) {
        for (size_t l = 0; l < sizeof least_ball / sizeof *least_ball && !found; l++)
            found = try_entries(plan, wanted, least_ball[l]);
    }
    for (size_t i = wanted; i < count; i++)
        free_strip(plan, &plan->rows[i].strip);
    plan->row_count = wanted;
    if (found) {
        struct bead_text_style style = bead_sketch_style(d->sketch, plan->em);
        const int decimals = bead_magnetism_decimals(d->context->chains, count);
        for (size_t i = 0; i < wanted; i++)
            bead_parts_header(&plan->rows[i], &style, decimals, area.width);
    }
    return found;
}
