/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws the bar beside a picture that explains its colours, and measures it for layouts. */

#include <math.h>

#include "beadreel/view.h"
#include "render/draw/axis.h"

/* In units of the label's font size and of the look's gap; movies leave more to the picture. */
static const struct {
    double labels, gaps;
} bar_width[] = {[BEAD_BAR_OF_FIGURE] = {1.05, 0}, [BEAD_BAR_OF_SHEET] = {0.8, 0}, [BEAD_BAR_OF_MOVIE] = {0, 1.3}};

double bead_colour_bar_width(const struct bead_look *look, enum bead_bar_of place)
{
    return bar_width[place].labels * look->label + bar_width[place].gaps * look->gap;
}

static void set_colour(cairo_t *cr, const uint8_t rgb[3])
{
    cairo_set_source_rgb(cr, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/* Bands without seams: each reaches down to the bottom, the next paints over it. */
static void draw_bands(cairo_t *cr, const struct bead_colours *colours, struct bead_rect bar)
{
    cairo_antialias_t before = cairo_get_antialias(cr);
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
    for (int i = 255; i >= 0; i--) {
        double top = bar.y + bar.height * (255 - i) / 256.0;
        set_colour(cr, colours->map->rgb[i]);
        cairo_rectangle(cr, bar.x, top, bar.width, bar.y + bar.height - top);
        cairo_fill(cr);
    }
    cairo_set_antialias(cr, before);
}

void bead_colour_axis_draw(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                           const struct bead_axis *axis, struct bead_rect bar)
{
    const bool log = axis->scale == BEAD_SCALE_LOG;
    for (int y = 0; bar.width > 0 && y < bar.height; y++) {
        const double place = 1 - (y + 0.5) / bar.height,
                     value = log ? axis->low * pow(axis->high / axis->low, place) : axis->low + place * (axis->high - axis->low);
        set_colour(cr, colours->map->rgb[bead_colours_index(colours, value)]);
        cairo_rectangle(cr, bar.x, bar.y + y, bar.width, 1);
        cairo_fill(cr);
    }
    if (bar.width > 0)
        bead_box_draw(cr, look, bar);
}

/* Length of the pointed ends of a bar, px. */
static double point_length(struct bead_rect bar)
{
    return 0.9 * bar.width;
}

/* The outline just outside the bar's bands, with pointed ends if wanted; the same path fills these ends. */
static void outline(cairo_t *cr, const struct bead_rect *bar, double out, bool over, bool under)
{
    double left = bar->x - out, right = bar->x + bar->width + out, top = bar->y - out, bottom = bar->y + bar->height + out;
    double middle = bar->x + bar->width / 2.0;
    cairo_move_to(cr, left, top);
    if (over)
        cairo_line_to(cr, middle, top - point_length(*bar));
    cairo_line_to(cr, right, top);
    cairo_line_to(cr, right, bottom);
    if (under)
        cairo_line_to(cr, middle, bottom + point_length(*bar));
    cairo_line_to(cr, left, bottom);
    cairo_close_path(cr);
}

static void draw_point(cairo_t *cr, const struct bead_colours *colours, struct bead_rect bar, bool up)
{
    double base = up ? bar.y : bar.y + bar.height, tip = up ? base - point_length(bar) : base + point_length(bar);
    set_colour(cr, colours->map->rgb[up ? 255 : 0]);
    cairo_move_to(cr, bar.x, base);
    cairo_line_to(cr, bar.x + bar.width / 2.0, tip);
    cairo_line_to(cr, bar.x + bar.width, base);
    cairo_close_path(cr);
    cairo_fill(cr);
}

/* The bar, upright. */
static void draw_bar(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours, struct bead_rect bar, bool over,
                     bool under)
{
    draw_bands(cr, colours, bar);
    if (over)
        draw_point(cr, colours, bar, true);
    if (under)
        draw_point(cr, colours, bar, false);
    cairo_set_source_rgb(cr, look->axis.r, look->axis.g, look->axis.b);
    cairo_set_line_width(cr, look->line);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    outline(cr, &bar, look->line / 2, over, under);
    cairo_stroke(cr);
}

double bead_colour_bar_draw(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours, const char *si_unit,
                            const char *title, struct bead_rect bar, bool over, bool under)
{
    struct bead_axis axis;
    bead_axis_make(&axis, colours->low, colours->high, si_unit, colours->scale, bar.height, look->tick, false);
    if (cr)
        draw_bar(cr, look, colours, bar, over, under);
    return bead_axis_draw(cr, look, &axis, bar, BEAD_SIDE_RIGHT, false, true, title);
}

double bead_colour_bar_draw_lying(cairo_t *cr, const struct bead_look *look, const struct bead_colours *colours,
                                  const char *si_unit, struct bead_rect bar, bool over, bool under)
{
    struct bead_axis axis;
    bead_axis_make(&axis, colours->low, colours->high, si_unit, colours->scale, bar.width, look->tick, true);
    if (cr) { /* up becomes right, right becomes down */
        cairo_matrix_t turn;
        cairo_matrix_init(&turn, 0, 1, -1, 0, bar.x + bar.width, bar.y);
        cairo_save(cr);
        cairo_transform(cr, &turn);
        draw_bar(cr, look, colours, (struct bead_rect){0, 0, bar.height, bar.width}, over, under);
        cairo_restore(cr);
    }
    return bead_axis_draw(cr, look, &axis, bar, BEAD_SIDE_BOTTOM, false, true, NULL);
}
