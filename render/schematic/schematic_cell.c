/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a scene's chains (thesis, Fig. 3): N_1 beads of one material, N_2 of the next, ...; in both orientations if the
 * chain has both. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/schematic/schematic.h"
#include "render/schematic/schematic_sketch.h"
#include "render/schematic/schematic_strip.h"

enum { MOST_CELLS = 16, MOST_GROUPS = 24, FIRST_SHOWN = 4, LAST_SHOWN = 2 };
/* A cell with more groups than this may get a single brace, with this many of its beads at each end. */
enum { FEW_GROUPS = 6, PLAIN_FIRST = 10, PLAIN_LAST = 5 };
/* In units of the label's font size. */
static const double title_row = 2.0, brace_depth = 0.75, brace_gap = 0.3, line = 1.35, row_gap = 1.2, gap = 2.2, side_column = 3.6,
                    aside = 0.7; /* labels farther than this from their brace get a line */
/* A bead's radius, in units of the label's font size. */
static const double largest_ball = 5.5, smallest_ball = 0.35;

struct cell {
    const struct bead_segment *segment;
    bool both; /* orientations */
};

struct drawing {
    const struct bead_drafting *d;
    struct cell cells[MOST_CELLS];
    size_t count, rows;
    bool plain;       /* cells of many groups get a single brace */
    bool names, both; /* a second line under the braces; some row is marked up or down */
    double scale, largest;
};

/* Beads of one material that follow each other in a cell. */
struct group {
    size_t material, beads;
};

/* Groups of a cell, left to right; 0: too many. */
static size_t split_groups(const struct bead_segment *segment, struct group *groups, size_t room)
{
    size_t count = 0;
    for (size_t i = 0; i < segment->cell_beads; i++) {
        if (count > 0 && groups[count - 1].material == segment->cell[i]) {
            groups[count - 1].beads++;
            continue;
        }
        if (count == room)
            return 0;
        groups[count++] = (struct group){segment->cell[i], 1};
    }
    return count;
}

/* Is the cell its own mirror image? */
static bool mirrored(const struct bead_segment *segment)
{
    for (size_t i = 0, j = segment->cell_beads - 1; i < j; i++, j--) {
        if (segment->cell[i] != segment->cell[j])
            return false;
    }
    return true;
}

static bool same_cell(const struct bead_segment *a, const struct bead_segment *b)
{
    return a->cell_beads == b->cell_beads && memcmp(a->cell, b->cell, a->cell_beads * sizeof *a->cell) == 0;
}

static bool find_cells(struct drawing *g)
{
    for (size_t c = 0; c < g->d->context->chain_count; c++) {
        const struct bead_chain_spec *spec = bead_chain_spec(g->d->context->chains[c]);
        for (size_t s = 0; s < spec->segment_count; s++) {
            const struct bead_segment *segment = &spec->segments[s];
            if (segment->cell_beads < 2)
                continue;
            size_t i = 0;
            while (i < g->count && !same_cell(g->cells[i].segment, segment))
                i++;
            if (i == MOST_CELLS)
                return false;
            if (i == g->count)
                g->cells[g->count++] = (struct cell){segment, false};
            g->cells[i].both = g->cells[i].both || (!g->d->once && segment->spins_given && !mirrored(segment));
        }
    }
    for (size_t i = 0; i < g->count; i++) {
        g->rows += g->cells[i].both ? 2 : 1;
        g->both = g->both || g->cells[i].both;
    }
    return g->count > 0;
}

static bool make_strip(const struct group *groups, size_t count, bool down, struct bead_strip *strip)
{
    for (size_t k = 0; k < count; k++) {
        size_t i = down ? count - 1 - k : k;
        if (!bead_strip_add(strip, &groups[i].material, 0, groups[i].beads, FIRST_SHOWN, LAST_SHOWN, i))
            return false;
    }
    return true;
}

/* Adds all beads of a long cell as one group. */
static bool make_plain(const struct bead_segment *segment, bool down, struct bead_strip *strip)
{
    const size_t *first = segment->cell + (down ? segment->cell_beads - 1 : 0);
    return bead_strip_add(strip, first, down ? -1 : 1, segment->cell_beads, PLAIN_FIRST, PLAIN_LAST, 0);
}

/* Finds the groups that each get a brace; false: too many. */
static bool cell_find_groups(const struct drawing *g, const struct bead_segment *segment, struct group *groups, size_t *count)
{
    *count = split_groups(segment, groups, MOST_GROUPS);
    if (g->plain && (*count == 0 || *count > FEW_GROUPS)) {
        groups[0] = (struct group){SIZE_MAX, segment->cell_beads};
        *count = 1;
    }
    return *count > 0;
}

static void group_words(const struct drawing *g, const struct group *groups, size_t count, size_t i, char number[200],
                        char name[200])
{
    char symbol[160];
    bead_symbol_words("N", count > 1 ? (int)i + 1 : 0, symbol, sizeof symbol);
    snprintf(number, 200, "%s = %zu", symbol, groups[i].beads);
    name[0] = '\0';
    if (groups[i].material != SIZE_MAX)
        bead_text_escape(g->d->context->scene->materials[groups[i].material].label, name, 200);
}

/* Lays out the labels of the braces; false: they do not fit. Draws them if y is given. */
static bool label_groups(const struct drawing *g, const struct bead_strip *strip, const struct group *groups, size_t count,
                         bool down, double low, double high, const double *y)
{
    struct bead_sketch *sketch = g->d->sketch;
    double em = sketch->look->label;
    struct bead_text_style style = bead_sketch_style(sketch, em);
    struct bead_label labels[MOST_GROUPS];
    char number[200], name[200];
    for (size_t k = 0; k < count; k++) {
        double x0, x1;
        size_t i = down ? count - 1 - k : k;
        group_words(g, groups, count, i, number, name);
        bead_strip_extent(strip, i, &x0, &x1);
        double width = fmax(bead_sketch_width(&style, number), g->names ? bead_sketch_width(&style, name) : 0);
        labels[k] = (struct bead_label){0.5 * (x0 + x1), width, 0};
    }
    if (!bead_labels_spread(labels, count, 0.9 * em, low, high))
        return false;
    style.across = BEAD_ALIGN_MIDDLE;
    for (size_t k = 0; y && k < count; k++) {
        double x0, x1, middle = labels[k].x + 0.5 * labels[k].width, below = *y + (brace_gap + brace_depth) * em;
        size_t i = down ? count - 1 - k : k;
        group_words(g, groups, count, i, number, name);
        bead_strip_extent(strip, i, &x0, &x1);
        bead_sketch_colour(sketch, sketch->look->ink);
        cairo_set_line_width(sketch->cr, sketch->look->line);
        bead_sketch_brace(sketch, x0 + 0.1 * em, x1 - 0.1 * em, *y + brace_gap * em, brace_depth * em);
        if (fabs(middle - labels[k].anchor) > aside * em)
            bead_sketch_line(sketch, labels[k].anchor, below, middle, below + 0.35 * em);
        bead_sketch_text(sketch, &style, middle, below + 1.05 * em, number);
        if (g->names)
            bead_sketch_text(sketch, &style, middle, below + (1.05 + line) * em, name);
    }
    return true;
}

/* "2 : 1 large steel : aluminium dimer cell": named after its groups, not its beads. */
static void title_words(const struct drawing *g, const struct group *groups, size_t count, char *out, size_t size)
{
    size_t used = 0;
    char name[96];
    for (size_t i = 0; i < 2 * count && used < size; i++) {
        const struct group *group = &groups[i % count];
        const char *mark = i % count > 0 ? " : " : i > 0 ? "  " : "";
        bead_text_escape(g->d->context->scene->materials[group->material].label, name, sizeof name);
        if (i < count)
            used += (size_t)snprintf(out + used, size - used, "%s%zu", mark, group->beads);
        else
            used += (size_t)snprintf(out + used, size - used, "%s%s", mark, name);
    }
    if (used < size)
        snprintf(out + used, size - used, " %s%s", bead_cell_word(count, false),
                 strcmp(bead_cell_word(count, false), "cell") == 0 ? "" : " cell");
}

static double row_height(const struct drawing *g)
{
    return 2 * g->largest * g->scale + (brace_gap + brace_depth + 1.05 + 0.7 + (g->names ? line : 0)) * g->d->sketch->look->label;
}

/* One cell in one orientation, its top at y; draw false: only checks the room. */
static bool cell_draw_row(const struct drawing *g, const struct cell *cell, bool down, double y, bool draw)
{
    struct bead_sketch *sketch = g->d->sketch;
    const struct bead_scene *scene = g->d->context->scene;
    double em = sketch->look->label, column = g->both ? side_column * em : 0, left = g->d->area.x + column;
    double width = g->d->area.width - column, middle = y + g->largest * g->scale, bottom = middle + g->largest * g->scale;
    struct group groups[MOST_GROUPS];
    struct bead_strip strip = {0};
    size_t count;
    bool room = cell_find_groups(g, cell->segment, groups, &count);
    room = room &&
           (groups[0].material == SIZE_MAX ? make_plain(cell->segment, down, &strip) : make_strip(groups, count, down, &strip));
    double needed = room ? bead_strip_width(&strip, scene, g->scale, gap * em) : 0;
    room = room && needed <= width;
    if (room) {
        bead_strip_place(&strip, scene, g->scale, gap * em, left + 0.5 * (width - needed));
        room = label_groups(g, &strip, groups, count, down, left, left + width, draw ? &bottom : NULL);
    }
    for (size_t i = 0; room && draw && i < strip.count; i++) {
        const struct bead_strip_bead *b = &strip.beads[i];
        if (b->left_out)
            bead_sketch_dots(sketch, b->x, middle, 2 * b->r);
        else
            bead_sketch_ball(sketch, b->x, middle, b->r, scene->materials[b->material].colour);
    }
    if (room && draw && cell->both) {
        struct bead_text_style style = bead_sketch_style(sketch, em);
        style.across = BEAD_ALIGN_END;
        bead_sketch_text(sketch, &style, left + 0.5 * (width - needed) - 0.9 * em, middle, down ? "down" : "up");
    }
    sketch->failed = sketch->failed || strip.failed;
    bead_strip_free(&strip);
    return room;
}

/* All cells from y on; draw false: only checks the room. */
static bool draw_cells(const struct drawing *g, double y, bool draw)
{
    double em = g->d->sketch->look->label;
    struct bead_text_style style = bead_sketch_style(g->d->sketch, em);
    struct group groups[MOST_GROUPS];
    char title[512];
    style.bold = true;
    style.across = BEAD_ALIGN_MIDDLE;
    double column = g->both ? side_column * em : 0, middle = g->d->area.x + 0.5 * (g->d->area.width + column);
    for (size_t i = 0; i < g->count; i++) {
        const struct bead_segment *segment = g->cells[i].segment;
        size_t count;
        bool grouped = cell_find_groups(g, segment, groups, &count) && groups[0].material != SIZE_MAX;
        if (grouped)
            title_words(g, groups, count, title, sizeof title);
        if (!grouped || bead_sketch_width(&style, title) > g->d->area.width - column)
            snprintf(title, sizeof title, "cell of %zu beads", segment->cell_beads);
        if (draw)
            bead_sketch_text(g->d->sketch, &style, middle, y + 0.6 * em, title);
        y += title_row * em;
        for (int down = 0; down < (g->cells[i].both ? 2 : 1); down++) {
            if (!cell_draw_row(g, &g->cells[i], down, y, draw))
                return false;
            y += row_height(g) + row_gap * em;
        }
    }
    return y - row_gap * em <= g->d->area.y + g->d->area.height;
}

bool bead_schematic_cell(const struct bead_drafting *d)
{
    struct drawing g = {.d = d};
    double em = d->sketch->look->label;
    if (!find_cells(&g))
        return false;
    for (size_t i = 0; i < g.count; i++) {
        const struct bead_segment *segment = g.cells[i].segment;
        for (size_t b = 0; b < segment->cell_beads; b++)
            g.largest = fmax(g.largest, d->context->scene->materials[segment->cell[b]].radius);
    }
    for (int way = 0; way < 4; way++) { /* with names, without, then both in the plain form */
        g.names = way % 2 == 0;
        g.plain = way >= 2;
        for (double ball = largest_ball; ball >= smallest_ball; ball *= 0.9) {
            g.scale = ball * em / g.largest;
            if (!draw_cells(&g, d->area.y, false))
                continue;
            double used = title_row * em * (double)g.count + (row_height(&g) + row_gap * em) * (double)g.rows - row_gap * em;
            return draw_cells(&g, d->area.y + 0.5 * (d->area.height - used), true);
        }
    }
    return false;
}
