/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws the experiment (thesis, Fig. 4) as planned: striker on its ramp, guide, beads to scale, sensors, wall. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/schematic/schematic_plan.h"
#include "render/schematic/schematic_sketch.h"
#include "sim/base/memory.h"

enum { MOST_ENTRIES = 8, PIECES = MOST_ENTRIES + 1 };
/* In units of the label's font size. */
static const double guide_height = 0.28, brace_gap = 0.25, brace_depth = 0.7, arrow_length = 2.0, arrow_above = 0.45;

static double ramp_angle(void)
{
    return atan(BEAD_PLAN_ANGLE_PERCENT / 100.0);
}

/* Beads smaller than the largest rest on blocks. */
static void draw_block(const struct bead_plan *plan, const struct bead_plan_row *row, double x, double r)
{
    const double largest = plan->scale * row->largest, guide = bead_plan_guide(row, x), top = guide - largest + 0.8 * r;
    if (r > 0.98 * largest)
        return;
    cairo_rectangle(plan->d->sketch->cr, x - 0.55 * r, top, 1.1 * r, guide - top + 0.5 * guide_height * plan->em);
    cairo_fill(plan->d->sketch->cr);
}

/* The guide, with the ramp of a striker that moves. */
static void draw_guide(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_sketch *sketch = plan->d->sketch;
    cairo_t *cr = sketch->cr;
    const double angle = ramp_angle(), thick = guide_height * plan->em, foot = row->first_x - 0.2 * plan->em,
                 left = row->striker_x - row->striker_r * (1 + sin(angle)) - 0.4 * plan->em,
                 end = row->end_x + bead_plan_wall(plan, row);
    bead_sketch_colour(sketch, bead_sketch_mixed(sketch->look, sketch->look->ink, sketch->look->dark ? 0.35 : 0.3));
    if (row->level) {
        cairo_move_to(cr, row->striker_x - row->striker_r, row->guide_y);
    } else {
        cairo_move_to(cr, left, row->foot_y - (foot - left) * tan(angle));
        cairo_line_to(cr, foot, row->foot_y);
        cairo_line_to(cr, foot, row->guide_y);
    }
    cairo_line_to(cr, row->first_x, row->guide_y);
    cairo_line_to(cr, end, bead_plan_guide(row, end));
    cairo_line_to(cr, end, bead_plan_guide(row, end) + thick);
    cairo_line_to(cr, row->first_x, row->guide_y + thick);
    if (row->level) {
        cairo_line_to(cr, row->striker_x - row->striker_r, row->guide_y + thick);
    } else {
        cairo_line_to(cr, foot - thick, row->guide_y + thick);
        cairo_line_to(cr, foot - thick, row->foot_y + thick);
        cairo_line_to(cr, left, row->foot_y - (foot - left) * tan(angle) + thick);
    }
    cairo_close_path(cr);
    cairo_fill(cr);
    if (row->level)
        draw_block(plan, row, row->striker_x, row->striker_r);
    for (size_t i = 0; i < row->strip.count; i++) {
        if (!row->strip.beads[i].left_out)
            draw_block(plan, row, row->strip.beads[i].x, row->strip.beads[i].r);
    }
}

static void setup_draw_wall(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    const struct bead_chain_spec *spec = bead_chain_spec(row->chain);
    const struct bead_scene *scene = plan->d->context->scene;
    double width = bead_plan_wall(plan, row), half = 1.25 * plan->scale * row->largest;
    if (!(width > 0))
        return;
    double y = bead_plan_guide(row, row->end_x) - plan->scale * row->largest;
    struct bead_box box = {row->end_x, y - half, width, bead_plan_guide(row, row->end_x + width) - y + half};
    bead_sketch_hatch(plan->d->sketch, box, spec->wall == BEAD_WALL_MATERIAL ? scene->materials[spec->wall_material].colour : NULL);
    bead_sketch_colour(plan->d->sketch, plan->d->sketch->look->ink);
    cairo_set_line_width(plan->d->sketch->cr, plan->d->sketch->look->line);
    bead_sketch_line(plan->d->sketch, box.x, box.y, box.x, box.y + box.height);
}

static void draw_striker(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_sketch *sketch = plan->d->sketch;
    double angle = ramp_angle(), em = plan->em, out = row->striker_r + arrow_above * em;
    const struct bead_chain_spec *spec = bead_chain_spec(row->chain);
    double x = row->striker_x + out * sin(angle), y = row->striker_y - out * cos(angle), half = 0.5 * arrow_length * em;
    bead_sketch_ball(sketch, row->striker_x, row->striker_y, row->striker_r,
                     plan->d->context->scene->materials[spec->striker_material].colour);
    if (spec->striker_velocity == 0)
        return;
    x = fmin(x, row->first_x - 0.1 * em - half * cos(angle)); /* clear of the first bead */
    half *= spec->striker_velocity < 0 ? -1 : 1;
    bead_sketch_colour(sketch, sketch->look->accent);
    cairo_set_line_width(sketch->cr, 1.6 * sketch->look->line);
    bead_sketch_arrow(sketch, x - half * cos(angle), y - half * sin(angle), x + half * cos(angle), y + half * sin(angle), false);
}

static void draw_beads(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_sketch *sketch = plan->d->sketch;
    for (size_t i = 0; i < row->strip.count; i++) {
        const struct bead_strip_bead *b = &row->strip.beads[i];
        double y = bead_plan_guide(row, b->x) - plan->scale * row->largest;
        const struct bead_segment *segment = row->parts[b->mark].segment;
        if (b->left_out) {
            bead_sketch_dots(sketch, b->x, y, 2 * b->r);
            continue;
        }
        bead_sketch_ball(sketch, b->x, y, b->r, plan->d->context->scene->materials[b->material].colour);
        if (segment && segment->sensor) {
            bead_sketch_colour(sketch, sketch->look->accent);
            cairo_set_line_width(sketch->cr, 1.6 * sketch->look->line);
            cairo_new_path(sketch->cr);
            cairo_arc(sketch->cr, b->x, y, fmax(0.55 * b->r, 0.5 * sketch->look->line), 0, 2 * M_PI);
            cairo_stroke(sketch->cr);
        }
    }
}

/* A line from an object to its label: straight up, then to the middle of the label. */
static void draw_leader(struct bead_sketch *sketch, const struct bead_label *label, double y0, double bend, double y1)
{
    double inset = fmin(0.4 * sketch->look->label, 0.5 * label->width);
    double x = fmin(fmax(label->anchor, label->x + inset), label->x + label->width - inset);
    bead_sketch_colour(sketch, sketch->look->faint);
    cairo_set_line_width(sketch->cr, sketch->look->line);
    cairo_move_to(sketch->cr, label->anchor, y0);
    cairo_line_to(sketch->cr, label->anchor, bend);
    cairo_line_to(sketch->cr, x, y1);
    cairo_stroke(sketch->cr);
}

static void draw_above(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_sketch *sketch = plan->d->sketch;
    double em = plan->em, y = bead_plan_above_y(plan, row), angle = ramp_angle();
    struct bead_text_style style = bead_sketch_style(sketch, em);
    for (size_t i = 0; i < row->above.count; i++) {
        const struct bead_label *label = &row->above.label[i];
        const bool striker = row->above.part[i] == SIZE_MAX, arrow = striker && !row->level;
        double top = arrow ? row->striker_y - (row->striker_r + arrow_above * em) * cos(angle) - 0.3 * em
                           : row->striker_y - row->striker_r - 0.15 * em,
               largest = plan->scale * row->largest;
        if (!striker)
            for (size_t b = 0; b < row->strip.count; b++)
                if (row->strip.beads[b].mark == row->above.part[i])
                    top = bead_plan_guide(row, label->anchor) - largest - row->strip.beads[b].r - 0.15 * em;
        double bend = y + 0.62 * em + 0.75 * em;
        if (!arrow || top > bend)
            draw_leader(sketch, label, top, fmin(bend, top), y + 0.62 * em);
        bead_sketch_text(sketch, &style, label->x, y, row->above.words[i][0]);
    }
}

static void draw_below(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_sketch *sketch = plan->d->sketch;
    double em = plan->em, y = bead_plan_below_y(plan, row), low, high;
    struct bead_text_style style = bead_sketch_style(sketch, em);
    style.across = BEAD_ALIGN_MIDDLE;
    for (size_t i = 0; i < row->below.count; i++) {
        const struct bead_label *label = &row->below.label[i];
        double top = bead_plan_guide(row, label->anchor) + guide_height * em + 0.1 * em;
        if (row->below.part[i] != SIZE_MAX && bead_strip_extent(&row->strip, row->below.part[i], &low, &high)) {
            double from = bead_plan_guide(row, high) + (guide_height + brace_gap) * em, inset = fmin(0.1 * em, 0.1 * (high - low));
            bead_sketch_colour(sketch, sketch->look->ink);
            cairo_set_line_width(sketch->cr, sketch->look->line);
            bead_sketch_brace(sketch, low + inset, high - inset, from, brace_depth * em);
            top = from + brace_depth * em;
        }
        draw_leader(sketch, label, top, fmax(top, y - 1.5 * em), y - 0.7 * em);
        bead_sketch_text(sketch, &style, label->x + 0.5 * label->width, y, row->below.words[i][0]);
        bead_sketch_text(sketch, &style, label->x + 0.5 * label->width, y + 1.3 * em, row->below.words[i][1]);
    }
}

static void setup_draw_row(const struct bead_plan *plan, const struct bead_plan_row *row)
{
    struct bead_text_style style = bead_sketch_style(plan->d->sketch, plan->em);
    bead_sketch_text(plan->d->sketch, &style, plan->area.x, bead_plan_header_y(plan, row), row->header);
    draw_guide(plan, row);
    setup_draw_wall(plan, row);
    draw_striker(plan, row);
    draw_beads(plan, row);
    draw_above(plan, row);
    draw_below(plan, row);
}

static bool near(double a, double b)
{
    return fabs(a - b) <= 1e-3 * fabs(a);
}

static bool differ_in_size_only(const struct bead_material *a, const struct bead_material *b)
{
    return near(a->modulus, b->modulus) && near(a->poisson, b->poisson) &&
           near(a->mass / pow(a->radius, 3), b->mass / pow(b->radius, 3)) && memcmp(a->colour, b->colour, sizeof a->colour) == 0;
}

/* The last material that differs from `first` only in size. All but `first` are marked as not used; if there are several, *listed
 * counts them all. */
static size_t last_alike(const struct bead_scene *scene, bool *used, size_t first, size_t *listed)
{
    size_t last = first;
    for (size_t m = first + 1; m < scene->material_count; m++) {
        if (!used[m] || !differ_in_size_only(&scene->materials[first], &scene->materials[m]))
            continue;
        *listed += last == first ? 2 : 1;
        used[m] = false;
        last = m;
    }
    return last;
}

/* The largest and the smallest bead of a material, if tapers and the like make them differ. True: they differ. */
static bool find_sizes(const struct bead_drafting *d, size_t material, struct bead_material ends[2])
{
    const struct bead_scene *scene = d->context->scene;
    bool any = false;
    for (size_t c = 0; c < d->context->chain_count; c++) {
        const struct bead_chain *chain = d->context->chains[c];
        for (size_t j = 1; j < bead_chain_beads(chain); j++) {
            const double radius = bead_chain_radius(chain)[j];
            if (scene->materials[bead_chain_material(chain)[j]].of != material)
                continue;
            for (int k = 0; k < 2; k++) {
                if (any && (k == 0 ? radius <= ends[0].radius : radius >= ends[1].radius))
                    continue;
                ends[k].radius = radius;
                ends[k].mass = bead_chain_mass(chain)[j];
            }
            any = true;
        }
    }
    return any && !near(ends[0].radius, ends[1].radius);
}

/* Lists the materials of beads in the order of the scene; if there are many, those that differ only in size are one entry. */
static size_t list_materials(const struct bead_drafting *d, struct bead_piece *pieces)
{
    const struct bead_scene *scene = d->context->scene;
    BEAD_FREED bool *used = calloc(scene->material_count, sizeof *used);
    size_t count = 0;
    d->sketch->failed = d->sketch->failed || !used;
    for (size_t c = 0; used && c < d->context->chain_count; c++) {
        for (size_t j = 0; j < bead_chain_beads(d->context->chains[c]); j++)
            used[scene->materials[bead_chain_material(d->context->chains[c])[j]].of] = true;
    }
    size_t all = 0, listed = 0;
    for (size_t m = 0; used && m < scene->material_count; m++)
        all += used[m];
    for (size_t m = 0; used && m < scene->material_count && count < MOST_ENTRIES; m++) {
        if (!used[m])
            continue;
        const size_t last = all > MOST_ENTRIES ? last_alike(scene, used, m, &listed) : m;
        listed += last == m;
        struct bead_material ends[2] = {scene->materials[m], scene->materials[last]};
        const bool varied = last == m && find_sizes(d, m, ends);
        bead_materials_words(&ends[0], last == m && !varied ? &ends[0] : &ends[1], pieces[count].markup,
                             sizeof pieces[count].markup);
        pieces[count++].colour = scene->materials[m].colour;
    }
    if (listed < all)
        snprintf(pieces[count++].markup, sizeof pieces->markup, "and %zu more", all - listed);
    return count;
}

/* Adds a line about the chains left out. */
static bool say_rest(const struct bead_drafting *d, struct bead_box *area, size_t rest)
{
    struct bead_piece piece = {{0}, NULL};
    snprintf(piece.markup, sizeof piece.markup, "and %zu more chain%s", rest, rest == 1 ? "" : "s");
    return bead_sketch_pieces(d->sketch, area, &piece, 1, false);
}

bool bead_schematic_setup(const struct bead_drafting *d)
{
    BEAD_FREED struct bead_piece *pieces = calloc(PIECES, sizeof *pieces);
    BEAD_LEFT_TO(bead_plan_free) struct bead_plan plan = {0};
    struct bead_box area = d->area;
    d->sketch->failed = d->sketch->failed || !pieces;
    bool room =
        pieces && bead_sketch_pieces(d->sketch, &area, pieces, list_materials(d, pieces), true) && bead_plan_make(d, area, &plan);
    if (room && plan.row_count < d->context->chain_count) { /* again, with a line about the chains left out */
        struct bead_box less = area;
        less.height -= 2 * d->sketch->look->label;
        bead_plan_free(&plan);
        room = bead_plan_make(d, less, &plan) && say_rest(d, &area, d->context->chain_count - plan.row_count);
    }
    for (size_t i = 0; room && i < plan.row_count; i++)
        setup_draw_row(&plan, &plan.rows[i]);
    return room;
}
