/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strokes, texts and labels of schematic drawings, and a check that all texts can be read. */
#include "render/schematic/schematic_sketch.h"

#include <math.h>
#include <stdlib.h>

#include "render/draw/looks.h"
#include "sim/base/memory.h"

/* Half the height of a line's box, in units of the font size. */
static const double half_line = 0.55;
/* Head of an arrow, in units of the label's font size: length, half the width. */
static const double head_length = 0.42, head_half = 0.15;

void bead_sketch_free(struct bead_sketch *sketch)
{
    free(sketch->boxes);
    sketch->boxes = NULL;
    sketch->count = sketch->room = 0;
}

bool bead_sketch_crowded(const struct bead_sketch *sketch, double width, double height)
{
    for (size_t i = 0; i < sketch->count; i++) {
        const struct bead_box *a = &sketch->boxes[i];
        if (a->x < 0 || a->y < 0 || a->x + a->width > width || a->y + a->height > height)
            return true;
        for (size_t j = 0; j < i; j++) {
            const struct bead_box *b = &sketch->boxes[j];
            if (a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height)
                return true;
        }
    }
    return false;
}

struct bead_text_style bead_sketch_style(const struct bead_sketch *sketch, double size)
{
    return (struct bead_text_style){.family = sketch->look->family,
                                    .size = size,
                                    .colour = sketch->look->ink,
                                    .across = BEAD_ALIGN_START,
                                    .down = BEAD_ALIGN_MIDDLE};
}

double bead_sketch_width(const struct bead_text_style *style, const char *markup)
{
    double width = 0, height;
    if (*markup)
        bead_text_size(NULL, style, markup, &width, &height);
    return width;
}

static void keep_box(struct bead_sketch *sketch, struct bead_box box)
{
    if (bead_memory_grow((void **)&sketch->boxes, &sketch->room, sketch->count + 1, sizeof box))
        sketch->boxes[sketch->count++] = box;
    else
        sketch->failed = true;
}

void bead_sketch_text(struct bead_sketch *sketch, const struct bead_text_style *style, double x, double y, const char *markup)
{
    if (!*markup)
        return;
    double width = bead_sketch_width(style, markup);
    double left = x - (style->across == BEAD_ALIGN_MIDDLE ? width / 2 : style->across == BEAD_ALIGN_END ? width : 0);
    keep_box(sketch, (struct bead_box){left, y - half_line * style->size, width, 2 * half_line * style->size});
    bead_text_draw(sketch->cr, style, x, y, markup);
}

void bead_sketch_colour(struct bead_sketch *sketch, struct bead_rgb colour)
{
    bead_rgb_set(sketch->cr, colour);
}

struct bead_rgb bead_sketch_mixed(const struct bead_look *look, struct bead_rgb colour, double part)
{
    return bead_rgb_mix(look->background, colour, part);
}

void bead_sketch_line(struct bead_sketch *sketch, double x0, double y0, double x1, double y1)
{
    cairo_move_to(sketch->cr, x0, y0);
    cairo_line_to(sketch->cr, x1, y1);
    cairo_stroke(sketch->cr);
}

void bead_sketch_dashed(struct bead_sketch *sketch, bool dashed)
{
    double dash = 0.3 * sketch->look->label;
    cairo_set_dash(sketch->cr, &dash, dashed, 0);
}

static void sketch_draw_head(struct bead_sketch *sketch, double x, double y, double along_x, double along_y)
{
    double length = head_length * sketch->look->label, half = head_half * sketch->look->label;
    cairo_move_to(sketch->cr, x, y);
    cairo_line_to(sketch->cr, x - length * along_x + half * along_y, y - length * along_y - half * along_x);
    cairo_line_to(sketch->cr, x - length * along_x - half * along_y, y - length * along_y + half * along_x);
    cairo_close_path(sketch->cr);
    cairo_fill(sketch->cr);
}

void bead_sketch_arrow(struct bead_sketch *sketch, double x0, double y0, double x1, double y1, bool both)
{
    double length = hypot(x1 - x0, y1 - y0), back = 0.8 * head_length * sketch->look->label;
    if (!(length > 0))
        return;
    double ax = (x1 - x0) / length, ay = (y1 - y0) / length, cut = fmin(back, 0.5 * length);
    bead_sketch_line(sketch, x0 + (both ? cut * ax : 0), y0 + (both ? cut * ay : 0), x1 - cut * ax, y1 - cut * ay);
    sketch_draw_head(sketch, x1, y1, ax, ay);
    if (both)
        sketch_draw_head(sketch, x0, y0, -ax, -ay);
}

void bead_sketch_brace(struct bead_sketch *sketch, double x0, double x1, double y, double depth)
{
    double middle = 0.5 * (x0 + x1), half = depth / 2, bend = fmin(depth, (x1 - x0) / 4);
    cairo_t *cr = sketch->cr;
    cairo_move_to(cr, x0, y);
    cairo_curve_to(cr, x0, y + half, x0 + bend / 2, y + half, x0 + bend, y + half);
    cairo_line_to(cr, middle - bend, y + half);
    cairo_curve_to(cr, middle - bend / 2, y + half, middle, y + half, middle, y + depth);
    cairo_curve_to(cr, middle, y + half, middle + bend / 2, y + half, middle + bend, y + half);
    cairo_line_to(cr, x1 - bend, y + half);
    cairo_curve_to(cr, x1 - bend / 2, y + half, x1, y + half, x1, y);
    cairo_stroke(cr);
}

static void sketch_shade(cairo_pattern_t *pattern, double at, const double colour[3], double light)
{
    double c[3];
    for (int i = 0; i < 3; i++)
        c[i] = light <= 1 ? light * colour[i] : 1 - (2 - light) * (1 - colour[i]);
    cairo_pattern_add_color_stop_rgb(pattern, at, c[0], c[1], c[2]);
}

void bead_sketch_ball(struct bead_sketch *sketch, double x, double y, double r, const double colour[3])
{
    cairo_pattern_t *pattern = cairo_pattern_create_radial(x - 0.3 * r, y - 0.35 * r, 0, x, y, r);
    sketch_shade(pattern, 0, colour, 1.35);
    sketch_shade(pattern, 0.55, colour, 0.97);
    sketch_shade(pattern, 1, colour, 0.62);
    cairo_set_source(sketch->cr, pattern);
    cairo_pattern_destroy(pattern);
    cairo_new_path(sketch->cr);
    cairo_arc(sketch->cr, x, y, r, 0, 2 * M_PI);
    cairo_fill(sketch->cr);
}

void bead_sketch_dots(struct bead_sketch *sketch, double x, double y, double width)
{
    double r = 0.085 * sketch->look->label;
    bead_sketch_colour(sketch, sketch->look->ink);
    for (int i = -1; i <= 1; i++) {
        cairo_new_path(sketch->cr);
        cairo_arc(sketch->cr, x + 0.27 * i * width, y, r, 0, 2 * M_PI);
        cairo_fill(sketch->cr);
    }
}

void bead_sketch_hatch(struct bead_sketch *sketch, struct bead_box box, const double colour[3])
{
    cairo_t *cr = sketch->cr;
    double step = 0.42 * sketch->look->label;
    cairo_save(cr);
    cairo_rectangle(cr, box.x, box.y, box.width, box.height);
    if (colour) {
        cairo_set_source_rgb(cr, colour[0], colour[1], colour[2]);
        cairo_fill_preserve(cr);
    }
    cairo_clip(cr);
    bead_sketch_colour(sketch, sketch->look->ink);
    cairo_set_line_width(cr, 0.7 * sketch->look->line);
    for (double at = -box.height; at < box.width; at += step)
        bead_sketch_line(sketch, box.x + at, box.y + box.height, box.x + at + box.height, box.y);
    cairo_restore(cr);
}

/* Labels first..last, which touch each other. */
struct cluster {
    size_t first, last;
    double x, width;
};

/* Moves a cluster so that its labels' mean distance from their anchors is 0. */
static void sketch_settle(struct cluster *cluster, const struct bead_label *labels, double gap, double low, double high)
{
    double sum = 0, at = 0;
    for (size_t i = cluster->first; i <= cluster->last; i++) {
        sum += labels[i].anchor - labels[i].width / 2 - at;
        at += labels[i].width + gap;
    }
    cluster->width = at - gap;
    cluster->x = fmax(low, fmin(sum / (double)(cluster->last - cluster->first + 1), high - cluster->width));
}

bool bead_labels_spread(struct bead_label *labels, size_t count, double gap, double low, double high)
{
    double total = -gap;
    for (size_t i = 0; i < count; i++)
        total += labels[i].width + gap;
    if (count == 0)
        return true;
    struct cluster cluster[BEAD_LABELS];
    if (count > BEAD_LABELS || total > high - low)
        return false;
    size_t used = 0;
    for (size_t i = 0; i < count; i++) {
        cluster[used] = (struct cluster){i, i, 0, 0};
        sketch_settle(&cluster[used++], labels, gap, low, high);
        while (used > 1 && cluster[used - 2].x + cluster[used - 2].width + gap > cluster[used - 1].x) {
            cluster[used - 2].last = cluster[used - 1].last;
            sketch_settle(&cluster[--used - 1], labels, gap, low, high);
        }
    }
    for (size_t c = 0; c < used; c++) {
        double x = cluster[c].x;
        for (size_t i = cluster[c].first; i <= cluster[c].last; i++) {
            labels[i].x = x;
            x += labels[i].width + gap;
        }
    }
    return true;
}

/* In units of the label's font size. */
static const double line_height = 1.45, piece_gap = 1.6, ball_radius = 0.42;

bool bead_sketch_pieces(struct bead_sketch *s, struct bead_box *area, const struct bead_piece *pieces, size_t count, bool centred)
{
    double em = s->look->label, used = 0;
    struct bead_text_style style = bead_sketch_style(s, em);
    enum { MOST = 64 };
    double width[MOST], line_width[MOST] = {0};
    size_t line[MOST], lines = 0;
    if (count > MOST)
        return false;
    for (size_t i = 0; i < count; i++) {
        width[i] = bead_sketch_width(&style, pieces[i].markup) + (pieces[i].colour ? (2 * ball_radius + 0.4) * em : 0);
        if (width[i] > area->width)
            return false;
        if (lines == 0 || used + piece_gap * em + width[i] > area->width) {
            lines++;
            used = -piece_gap * em;
        }
        used += piece_gap * em + width[i];
        line[i] = lines - 1;
        line_width[lines - 1] = used;
    }
    double height = line_height * em * (double)lines, x = 0;
    if (height > area->height)
        return false;
    area->height -= height + (lines > 0 ? 0.4 * em : 0);
    double top = area->y + area->height + (lines > 0 ? 0.4 * em : 0);
    for (size_t i = 0; i < count; i++) {
        double y = top + line_height * em * ((double)line[i] + 0.5);
        if (i == 0 || line[i] != line[i - 1])
            x = area->x + (centred ? 0.5 * (area->width - line_width[line[i]]) : 0);
        double text = x;
        if (pieces[i].colour) {
            bead_sketch_ball(s, x + ball_radius * em, y, ball_radius * em, pieces[i].colour);
            text += (2 * ball_radius + 0.4) * em;
        }
        bead_sketch_text(s, &style, text, y, pieces[i].markup);
        x += width[i] + piece_gap * em;
    }
    return true;
}
