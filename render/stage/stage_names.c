/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts below the stage: sensors, numbers of beads, the wall; and rings around beads with a sensor in the row of all. */
#include <math.h>
#include <stdio.h>

#include "render/draw/words.h"
#include "render/stage/panel.h"
#include "render/stage/stage_view.h"
#include "sim/chain/chain_internal.h"

/* In units of the type's size: between words; half a pointer's width. */
static const double between = 0.5, pointer = 0.25;
enum { MOST_WORDS = 60 };

struct words {
    cairo_t *cr;
    const struct bead_view *v;
    double baseline;
    double taken[MOST_WORDS][2]; /* px of the frame */
    size_t count;
};

/* The place of a bead's name, px of the frame: below it in the row, or on the stage. */
static double name_x(const struct bead_view *v, size_t i)
{
    const double on_stage = v->place[i] * v->scale - v->left,
                 in_row = v->row_left + (v->position[i] - v->position[0]) * v->row_scale;
    return v->strip.x + (v->row.height > 0 ? in_row : on_stage);
}

/* Writes a word with its middle, or its end, at x, unless it would touch another, or a word of the stage to the right in a grid. */
static bool add_word(struct words *w, double x, const char *markup, enum bead_align across, struct bead_rgb colour)
{
    const struct bead_look *look = &w->v->look;
    const struct bead_text_style style = {
        .family = look->family, .size = look->tick, .colour = colour, .across = across, .down = BEAD_ALIGN_BASELINE};
    double width, height, gap = between * look->tick;
    bead_text_size(w->cr, &style, markup, &width, &height);
    const double from = x - (across == BEAD_ALIGN_END ? width : 0.5 * width), to = from + width;
    bool free = w->count < MOST_WORDS && !(w->v->setup.small && to > w->v->strip.x + w->v->strip.width + 0.5);
    for (size_t i = 0; i < w->count; i++)
        free = free && (to + gap < w->taken[i][0] || from - gap > w->taken[i][1]);
    if (!free)
        return false;
    w->taken[w->count][0] = from;
    w->taken[w->count++][1] = to;
    bead_text_draw(w->cr, &style, x, w->baseline, markup);
    return true;
}

static void add_sensors(struct words *w)
{
    const struct bead_view *v = w->v;
    const double size = pointer * v->look.tick, top = v->row.y + v->row.height;
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(v->setup.chain, &count);
    for (size_t i = 0; i < count; i++) {
        const size_t bead = sensors[i].bead - v->first; /* huge if it is before the first */
        char plain[64], markup[160];
        snprintf(plain, sizeof plain, "%.40s", sensors[i].name);
        bead_text_escape(plain, markup, sizeof markup);
        if (bead >= v->count || !add_word(w, name_x(v, bead), markup, BEAD_ALIGN_MIDDLE, v->look.ink))
            continue;
        cairo_set_source_rgb(w->cr, v->look.ink.r, v->look.ink.g, v->look.ink.b);
        cairo_move_to(w->cr, name_x(v, bead) - size, top + size);
        cairo_line_to(w->cr, name_x(v, bead) + size, top + size);
        cairo_line_to(w->cr, name_x(v, bead), top);
        cairo_fill(w->cr);
    }
}

static void add_numbers(struct words *w)
{
    const struct bead_view *v = w->v;
    const struct bead_chain_axis along = bead_chain_axis(v->setup.chain, false);
    struct bead_axis axis;
    bead_axis_along_chain(&axis, v->setup.chain, false, v->first, v->first + v->count - 1, v->plot.width, v->look.tick, true);
    for (size_t k = 0; k < axis.count; k++) {
        const double bead = (axis.ticks[k].value - along.first) / along.spacing - (double)v->first;
        if (bead >= 0 && bead < (double)v->count)
            add_word(w, name_x(v, (size_t)bead), axis.ticks[k].label, BEAD_ALIGN_MIDDLE, v->look.faint);
    }
}

static void add_wall(struct words *w)
{
    const struct bead_view *v = w->v;
    char plain[96], markup[200];
    if (!v->wall)
        return;
    bead_wall_name(v->setup.chain, plain, sizeof plain);
    bead_text_escape(plain, markup, sizeof markup);
    add_word(w, v->strip.x + v->strip.width, markup, BEAD_ALIGN_END, v->look.faint);
}

/* Draws rings, which are visible around the beads painted over them. */
static void draw_rings(const struct bead_view *v, cairo_t *cr)
{
    const double line = v->look.line, middle = v->row.y + 0.5 * v->row.height;
    size_t count;
    const struct bead_sensor *sensors = bead_chain_sensors(v->setup.chain, &count);
    cairo_set_source_rgb(cr, v->look.ink.r, v->look.ink.g, v->look.ink.b);
    cairo_set_line_width(cr, line);
    for (size_t i = 0; v->row.height > 0 && i < count; i++) {
        const size_t bead = sensors[i].bead - v->first;
        if (bead >= v->count)
            continue;
        const double r = fmin(v->radius[bead] * v->row_scale + 2 * line, 0.5 * v->row.height - line);
        cairo_arc(cr, name_x(v, bead), middle, r, 0, 2 * M_PI);
        cairo_stroke(cr);
    }
}

void bead_stage_draw_names(const struct bead_view *v, cairo_t *cr)
{
    const double bottom = v->row.y + v->row.height, em = v->look.tick;
    struct words words = {.cr = cr, .v = v, .baseline = bottom + 1.1 * em};
    if (!v->setup.axes)
        return;
    draw_rings(v, cr);
    if (!v->setup.bead_labels || bottom + em > v->plot.y + v->plot.height)
        return;
    add_sensors(&words);
    add_numbers(&words);
    add_wall(&words);
}
