/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws a graph onto a page: panels with their axes, words and legends. The last step: the layout is known. */
#include "render/draw/words.h"
#include "render/plot/graph_private.h"

static void graph_draw_words(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell)
{
    struct bead_text_style style = graph_text(look);
    style.colour = bead_rgb_mix(look->ink, look->faint, 0.6);
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        const struct graph_word *word = &cell->words[r];
        if (word->state == GRAPH_WORD_PLACED)
            bead_text_draw(cr, &style, word->box.x, word->box.y, word->markup);
    }
}

static void graph_draw_head(cairo_t *cr, const struct graph_layout *layout, const struct graph_cell *cell)
{
    struct bead_text_style style = graph_text(layout->look);
    style.down = BEAD_ALIGN_BASELINE; /* as high as headings of images */
    if (cell->head)
        bead_text_draw_lines(cr, &style, -cell->plot.width, cell->plot.x, cell->plot.y - bead_heading_drop * layout->look->label,
                             cell->head);
}

static enum bead_error draw_cell(cairo_t *cr, const struct graph_layout *layout, const struct graph_cell *cell,
                                 struct bead_message *msg)
{
    const struct bead_look *look = layout->look;
    const struct bead_rect *plot = &cell->plot;
    if (look->dark)
        bead_look_paint_panel(look, cr, plot->x, plot->y, plot->width, plot->height);
    BEAD_TRY(graph_draw_image(cr, look, cell, msg));
    graph_draw_bands(cr, look, cell);
    if (!look->dark)
        bead_box_draw(cr, look, *plot);
    graph_draw_contents(cr, look, cell);
    bead_axis_draw(cr, look, &cell->axis[0], *plot, BEAD_SIDE_BOTTOM, false, cell->labelled[0], cell->panel->x.title);
    bead_axis_draw(cr, look, &cell->axis[1], *plot, BEAD_SIDE_LEFT, false, cell->labelled[1], cell->panel->y.title);
    graph_draw_words(cr, look, cell);
    if (cell->panel->image)
        graph_legend_back(&cell->legend, look, cr);
    graph_legend_draw(&cell->legend, look, cr);
    graph_ends_draw(cell, look, cr);
    graph_draw_head(cr, layout, cell);
    return graph_draw_bar(cr, look, cell, msg);
}

enum bead_error graph_draw_all(cairo_t *cr, const struct graph_layout *layout, struct bead_message *msg)
{
    const struct bead_look *look = layout->look;
    if (!look->clear) {
        bead_rgb_set(cr, look->background);
        cairo_rectangle(cr, 0, 0, layout->width, layout->height);
        cairo_fill(cr);
    }
    for (size_t p = 0; p < layout->graph->panel_count; p++)
        BEAD_TRY(draw_cell(cr, layout, &layout->cells[p], msg));
    graph_legend_draw(&layout->legend, look, cr);
    graph_page_draw(&layout->page, look, cr, layout->cells[0].plot.x);
    return BEAD_OK;
}
