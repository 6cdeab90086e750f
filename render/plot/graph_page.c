/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Title and caption of a page with plots: their room, and drawing them. */
#include <math.h>

#include "render/plot/graph_private.h"

static const double title_size = 1.2;                   /* of the look's */
static const double title_gap = 0.7, caption_gap = 0.5; /* in units of the label's font size */

static struct bead_text_style title_style(const struct bead_look *look)
{
    struct bead_text_style style = graph_text(look);
    style.size = title_size * look->title;
    style.bold = true;
    return style;
}

void graph_page_measure(struct graph_page *page, const struct bead_look *look, double width, double height)
{
    struct bead_text_style title = title_style(look), caption = graph_text(look);
    double wrap = width - 2 * look->margin, across, down;
    page->width = width;
    page->height = height;
    if (page->title) {
        bead_text_size_lines(NULL, &title, wrap, page->title, &across, &down);
        page->above = ceil(down + title_gap * look->label);
    }
    if (page->caption) {
        bead_text_size_lines(NULL, &caption, wrap, page->caption, &across, &page->caption_height);
        page->below = ceil(page->caption_height + caption_gap * look->label);
    }
}

void graph_page_draw(const struct graph_page *page, const struct bead_look *look, cairo_t *cr, double axes)
{
    struct bead_text_style title = title_style(look), caption = graph_text(look);
    double margin = look->margin, wrap = page->width - 2 * margin, width, height;
    if (page->caption)
        bead_text_draw_lines(cr, &caption, wrap, margin, page->height - margin - page->caption_height, page->caption);
    if (!page->title)
        return;
    bead_text_size(NULL, &title, page->title, &width, &height);
    bool fits = axes + width <= page->width - margin;
    bead_text_draw_lines(cr, &title, wrap, fits ? axes : margin, margin, page->title);
}
