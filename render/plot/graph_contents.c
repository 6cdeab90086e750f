/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contents of a plot's frame: bands, curves, points and rulers; and the styles of words and rulers. */
#include "render/plot/graph_private.h"

static const double band_share = 0.16, band_share_dark = 0.25; /* share of the accent colour in bands */

struct bead_text_style graph_text(const struct bead_look *look)
{
    return (struct bead_text_style){
        .family = look->family, .size = look->label, .colour = look->ink, .across = BEAD_ALIGN_START, .down = BEAD_ALIGN_START};
}

void graph_ruler_style(cairo_t *cr, const struct bead_look *look, const struct bead_ruler *ruler)
{
    const double on = ruler->vertical ? 5 : 1.2, off = ruler->vertical ? 3 : 2.2; /* thresholds, plateaus */
    double dashes[] = {on * look->line, off * look->line};
    bead_rgb_set(cr, look->faint);
    cairo_set_line_width(cr, look->line);
    cairo_set_dash(cr, dashes, 2, 0);
}

double graph_ruler_place(const struct graph_cell *cell, const struct bead_ruler *ruler, double value)
{
    return bead_axis_place(&cell->axis[ruler->vertical ? 0 : 1], value);
}

static void draw_ruler(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_ruler *ruler)
{
    const struct bead_rect *plot = &cell->plot;
    double place = graph_ruler_place(cell, ruler, ruler->value);
    if (!(place >= 0 && place <= 1))
        return;
    cairo_new_path(cr);
    if (ruler->vertical) {
        cairo_move_to(cr, plot->x + place * plot->width, plot->y);
        cairo_rel_line_to(cr, 0, plot->height);
    } else {
        cairo_move_to(cr, plot->x, plot->y + (1 - place) * plot->height);
        cairo_rel_line_to(cr, plot->width, 0);
    }
    graph_ruler_style(cr, look, ruler);
    cairo_stroke(cr);
    cairo_set_dash(cr, NULL, 0, 0);
}

static double within(double place)
{
    return place > 0 ? place < 1 ? place : 1 : 0;
}

void graph_draw_bands(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell)
{
    bead_rgb_set(cr, bead_rgb_mix(bead_look_ground(look), look->accent, look->dark ? band_share_dark : band_share));
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        const struct bead_ruler *ruler = &cell->panel->rulers[r];
        const struct bead_rect *plot = &cell->plot;
        if (!(ruler->low < ruler->high))
            continue;
        double low = within(graph_ruler_place(cell, ruler, ruler->low)), high = within(graph_ruler_place(cell, ruler, ruler->high));
        if (ruler->vertical)
            cairo_rectangle(cr, plot->x + low * plot->width, plot->y, (high - low) * plot->width, plot->height);
        else
            cairo_rectangle(cr, plot->x, plot->y + (1 - high) * plot->height, plot->width, (high - low) * plot->height);
        cairo_fill(cr);
    }
}

void graph_draw_contents(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell)
{
    const struct bead_panel *panel = cell->panel;
    for (int pass = 0; pass < 2; pass++) { /* faint ones below */
        for (size_t s = 0; s < panel->series_count; s++) {
            if (panel->series[s].faint == (pass == 0))
                graph_draw_series(cr, look, cell, &panel->series[s]);
        }
        for (size_t r = 0; pass == 0 && r < panel->ruler_count; r++)
            draw_ruler(cr, look, cell, &panel->rulers[r]);
    }
}
