/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Legends: grids of entries that identify curves. The layout measures and places them, graph_draw.c draws them. */
#include <math.h>

#include "render/plot/graph_private.h"

/* In units of the label's font size. */
static const double sample_length = 2.6, sample_gap = 0.5, between_columns = 1.3, least_row = 1.32, narrowest_words = 3;
/* Places tried inside a panel, across and down. */
enum { ACROSS = 17, DOWN = 13 };

/* Font sizes to try if a legend takes too much room. */
static const double smaller[] = {1, 0.87, 0.75};
enum { SIZES = sizeof smaller / sizeof *smaller };

static double type_of(const struct graph_legend *legend, const struct bead_look *look)
{
    return (legend->shrunk > 0 ? legend->shrunk : 1) * look->label;
}

static double sample_width(double em)
{
    return (sample_length + sample_gap) * em;
}

static struct bead_text_style legend_style_of(const struct graph_legend *legend, const struct bead_look *look)
{
    struct bead_text_style style = graph_text(look);
    style.size *= type_of(legend, look) / look->label;
    return style;
}

/* Returns the height of the highest entry. */
static double measure_entries(struct graph_legend *legend, const struct bead_look *look, double width)
{
    double em = type_of(legend, look), highest = least_row * em, limit = fmax(width - sample_width(em), narrowest_words * em);
    struct bead_text_style style = legend_style_of(legend, look);
    legend->wrap = 0;
    for (size_t i = 0; i < legend->count; i++) {
        struct graph_entry *entry = &legend->entries[i];
        bead_text_size(NULL, &style, entry->markup, &entry->width, &entry->height);
        entry->wraps = entry->width > limit && !legend->cut;
        if (entry->width > limit) {
            legend->wrap = legend->cut ? -limit : limit;
            bead_text_size_lines(NULL, &style, legend->wrap, entry->markup, &entry->width, &entry->height);
        }
        highest = fmax(highest, entry->height);
    }
    return ceil(highest);
}

/* Columns as wide as their entries; returns the total width. */
static double put_entries(struct graph_legend *legend, const struct bead_look *look, size_t columns, double row)
{
    size_t rows = (legend->count + columns - 1) / columns;
    double em = type_of(legend, look), x = 0, widest = 0, gap = between_columns * em;
    for (size_t i = 0; i < legend->count; i++) {
        struct graph_entry *entry = &legend->entries[i];
        if (i > 0 && i % rows == 0) {
            x += ceil(widest) + gap;
            widest = 0;
        }
        widest = fmax(widest, sample_width(em) + entry->width);
        entry->x = x;
        entry->y = ((double)(i % rows) + 0.5) * row;
    }
    legend->columns = (legend->count + rows - 1) / rows;
    legend->box = (struct graph_box){0, 0, x + ceil(widest), (double)rows * row};
    return legend->box.width;
}

void graph_legend_measure(struct graph_legend *legend, const struct bead_look *look, double width, size_t columns)
{
    double row = measure_entries(legend, look, width);
    size_t most = columns > 0 ? columns : legend->count;
    while (most > 0 && put_entries(legend, look, most, row) > width && columns == 0 && most > 1)
        most--;
}

/* Columns of equal width, with words cut to fit. */
static void cut_to_fit(struct graph_legend *legend, const struct bead_look *look, double width, double height)
{
    double em = type_of(legend, look), row = ceil(least_row * em), gap = between_columns * em;
    size_t rows = (size_t)fmax(1, floor(height / row)), columns = (legend->count + rows - 1) / rows;
    legend->cut = true;
    for (; columns > 1 && (width - (double)(columns - 1) * gap) / (double)columns < sample_width(em) + narrowest_words * em;
         columns--)
        ;
    row = measure_entries(legend, look, floor((width - (double)(columns - 1) * gap) / (double)columns));
    (void)put_entries(legend, look, columns, row);
}

void graph_legend_fit(struct graph_legend *legend, const struct bead_look *look, double width, double height)
{
    legend->cut = false;
    for (size_t i = 0; i < SIZES; i++) {
        legend->shrunk = smaller[i];
        graph_legend_measure(legend, look, width, 0);
        if (legend->box.height <= height)
            return;
    }
    for (size_t i = 0; i < SIZES; i++) {
        legend->shrunk = smaller[i];
        cut_to_fit(legend, look, width, height);
        if (legend->columns == 1 || i + 1 == SIZES)
            return;
    }
}

/* Preference of a place: corners first, then borders, then the middle; less is better. */
static double oddness(double across, double down)
{
    double x = fmin(across, 1 - across), y = fmin(down, 1 - down);
    return x + 1.3 * y + (x > 0.02 && y > 0.02 ? 0.6 : 0) + 0.02 * down - 0.01 * across;
}

static bool try_columns(struct graph_legend *legend, const struct bead_look *look, const struct graph_mask *mask, double *best)
{
    double air = graph_air(look), inset = 1.6 * air, width = legend->box.width, height = legend->box.height;
    double room_x = mask->width * mask->cell - width - 2 * inset, room_y = mask->height * mask->cell - height - 2 * inset;
    struct graph_box found = legend->box;
    bool better = false;
    for (int i = 0; i < ACROSS * DOWN && room_x >= 0 && room_y >= 0; i++) {
        double across = (i % ACROSS) / (ACROSS - 1.0), down = (i / ACROSS) / (DOWN - 1.0);
        struct graph_box box = {mask->x + inset + across * room_x, mask->y + inset + down * room_y, width, height};
        struct graph_box airy = {box.x - air, box.y - air, width + 2 * air, height + 2 * air};
        if (oddness(across, down) >= *best || graph_mask_covered(mask, airy) > 0)
            continue;
        *best = oddness(across, down);
        found = box;
        better = true;
    }
    legend->box = found;
    return better;
}

bool graph_legend_place(struct graph_legend *legend, const struct bead_look *look, struct graph_mask *mask)
{
    struct graph_legend best = {.count = 0};
    double least = INFINITY, width = mask->width * mask->cell;
    for (size_t columns = 1; columns <= legend->count; columns++) {
        struct graph_legend tried = *legend;
        double penalty = 0.1 * (double)(columns - 1); /* one column if it is as good */
        graph_legend_measure(&tried, look, 0.9 * width, columns);
        double limit = least - penalty;
        if (tried.wrap != 0 || tried.columns != columns || !try_columns(&tried, look, mask, &limit))
            continue;
        least = limit + penalty;
        best = tried;
    }
    if (best.count == 0) {
        legend->box.width = 0;
        return false;
    }
    graph_legend_measure(legend, look, 0.9 * width, best.columns);
    legend->box = best.box;
    graph_mask_cover(mask, legend->box);
    return true;
}

static void draw_band_sample(const struct graph_entry *entry, const struct bead_look *look, double em, cairo_t *cr, double x,
                             double y)
{
    double length = sample_length * em, half = 0.35 * em;
    cairo_new_path(cr);
    cairo_rectangle(cr, x, y - half, length, 2 * half);
    bead_rgb_set(cr, graph_band_colour(look, entry->series));
    cairo_fill(cr);
    graph_stroke_style(cr, look, entry->series, true);
    for (int side = -1; side <= 1; side += 2) {
        cairo_move_to(cr, x, y + side * half);
        cairo_rel_line_to(cr, length, 0);
        cairo_stroke(cr);
    }
    cairo_set_dash(cr, NULL, 0, 0);
}

static void draw_sample(const struct graph_entry *entry, const struct bead_look *look, double em, cairo_t *cr, double x, double y)
{
    const double length = sample_length * em;
    const enum bead_mark mark = entry->ruler ? BEAD_MARK_LINE : entry->series->mark;
    if (mark == BEAD_MARK_BAND) {
        draw_band_sample(entry, look, em, cr, x, y);
        return;
    }
    if (entry->ruler)
        graph_ruler_style(cr, look, entry->ruler);
    else
        graph_stroke_style(cr, look, entry->series, graph_is_guide(entry->cell, look, entry->series));
    cairo_new_path(cr);
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + length, y);
    if (mark != BEAD_MARK_POINTS)
        cairo_stroke(cr);
    cairo_set_dash(cr, NULL, 0, 0);
    if (mark != BEAD_MARK_LINE)
        graph_draw_point(cr, look, entry->series, x + length / 2, y, graph_full_point(look));
}

/* Letters on the colours of an image would be illegible. */
void graph_legend_back(const struct graph_legend *legend, const struct bead_look *look, cairo_t *cr)
{
    const double pad = 0.25 * type_of(legend, look);
    if (legend->box.width <= 0)
        return;
    cairo_new_path(cr);
    cairo_rectangle(cr, legend->box.x - pad, legend->box.y - pad, legend->box.width + 2 * pad, legend->box.height + 2 * pad);
    bead_rgb_set(cr, bead_look_ground(look));
    cairo_fill(cr);
}

void graph_legend_draw(const struct graph_legend *legend, const struct bead_look *look, cairo_t *cr)
{
    struct bead_text_style style = legend_style_of(legend, look);
    double em = type_of(legend, look);
    for (size_t i = 0; i < legend->count && legend->box.width > 0; i++) {
        const struct graph_entry *entry = &legend->entries[i];
        double x = legend->box.x + entry->x, y = legend->box.y + entry->y;
        draw_sample(entry, look, em, cr, x, y);
        /* Lines with mathematical letters are higher; entries of a row are still written on one line. */
        style.down = entry->wraps ? BEAD_ALIGN_START : BEAD_ALIGN_MIDDLE;
        bead_text_draw_lines(cr, &style, legend->wrap, x + sample_width(em), y - (entry->wraps ? entry->height / 2 : 0),
                             entry->markup);
    }
}
