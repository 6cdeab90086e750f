/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A graph onto a page: frames, bands, curves, rulers and words, and the styles of its words and lines. The last step: the layout is
 * known. */
#include "render/plot/graph_private.h"

static const double title_size = 1.2;                          /* of the look's */
static const double band_share = 0.16, band_share_dark = 0.25; /* share of the accent colour in bands */

struct bead_text_style graph_text(const struct bead_look *look)
{
    return (struct bead_text_style){
        .family = look->family, .size = look->label, .colour = look->ink, .across = BEAD_ALIGN_START, .down = BEAD_ALIGN_START};
}

double graph_title_size(const struct bead_look *look)
{
    return title_size * look->title;
}

void graph_ruler_style(cairo_t *cr, const struct bead_look *look, const struct bead_ruler *ruler)
{
    const double on = ruler->vertical ? 5 : 1.2, off = ruler->vertical ? 3 : 2.2; /* thresholds, plateaus */
    double dashes[] = {on * look->line, off * look->line};
    graph_set_colour(cr, look->faint);
    cairo_set_line_width(cr, look->line);
    cairo_set_dash(cr, dashes, 2, 0);
}

static double place_on(const struct graph_cell *cell, const struct bead_ruler *ruler, double value)
{
    return bead_axis_place(&cell->axis[ruler->vertical ? 0 : 1], value);
}

static void draw_ruler(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, const struct bead_ruler *ruler)
{
    const struct bead_rect *plot = &cell->plot;
    double place = place_on(cell, ruler, ruler->value);
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

static void graph_draw_bands(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell)
{
    struct bead_rgb ground = look->dark ? look->panel : look->background;
    graph_set_colour(cr, graph_mix(ground, look->accent, look->dark ? band_share_dark : band_share));
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        const struct bead_ruler *ruler = &cell->panel->rulers[r];
        const struct bead_rect *plot = &cell->plot;
        if (!(ruler->low < ruler->high))
            continue;
        double low = within(place_on(cell, ruler, ruler->low)), high = within(place_on(cell, ruler, ruler->high));
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

static void graph_draw_words(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell)
{
    struct bead_text_style style = graph_text(look);
    style.colour = graph_mix(look->ink, look->faint, 0.6);
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        const struct graph_word *word = &cell->words[r];
        if (word->state == GRAPH_WORD_PLACED)
            bead_text_draw(cr, &style, word->box.x, word->box.y, word->markup);
    }
}

static void graph_draw_head(cairo_t *cr, const struct graph_layout *layout, const struct graph_cell *cell)
{
    struct bead_text_style style = graph_text(layout->look);
    if (cell->head)
        bead_text_draw_lines(cr, &style, cell->plot.width, cell->plot.x, cell->plot.y - layout->head[cell->row], cell->head);
}

static void draw_cell(cairo_t *cr, const struct graph_layout *layout, const struct graph_cell *cell)
{
    const struct bead_look *look = layout->look;
    const struct bead_rect *plot = &cell->plot;
    if (look->dark)
        bead_look_paint_panel(look, cr, plot->x, plot->y, plot->width, plot->height);
    graph_draw_bands(cr, look, cell);
    if (!look->dark)
        bead_box_draw(cr, look, *plot);
    graph_draw_contents(cr, look, cell);
    bead_axis_draw(cr, look, &cell->axis[0], *plot, BEAD_SIDE_BOTTOM, false, cell->labelled[0], cell->panel->x.title);
    bead_axis_draw(cr, look, &cell->axis[1], *plot, BEAD_SIDE_LEFT, false, cell->labelled[1], cell->panel->y.title);
    graph_draw_words(cr, look, cell);
    graph_legend_draw(&cell->legend, look, cr);
    graph_draw_head(cr, layout, cell);
}

double graph_title_x(const struct bead_text_style *style, const char *markup, double axes, double left, double right)
{
    double width, height;
    bead_text_size(NULL, style, markup, &width, &height);
    return axes + width <= right ? axes : left;
}

void graph_draw_all(cairo_t *cr, const struct graph_layout *layout)
{
    const struct bead_look *look = layout->look;
    double margin = layout->frame.margin;
    struct bead_text_style style = graph_text(look);
    if (!look->clear) {
        graph_set_colour(cr, look->background);
        cairo_rectangle(cr, 0, 0, layout->width, layout->height);
        cairo_fill(cr);
    }
    for (size_t p = 0; p < layout->graph->panel_count; p++)
        draw_cell(cr, layout, &layout->cells[p]);
    graph_legend_draw(&layout->legend, look, cr);
    double wrap = layout->width - 2 * margin;
    if (layout->caption)
        bead_text_draw_lines(cr, &style, wrap, margin, layout->height - margin - layout->caption_height, layout->caption);
    style.size = graph_title_size(look);
    style.bold = true;
    if (layout->title)
        bead_text_draw_lines(
            cr, &style, wrap,
            graph_title_x(&style, layout->title, layout->cells[0].plot.x, margin, layout->width - layout->frame.margin), margin,
            layout->title);
}
