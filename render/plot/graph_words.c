/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places the words of rulers beside their lines, where they hide nothing. A mask of curves, points and rulers shows the free room
 * for words and legends. */
#include <math.h>
#include <stdlib.h>

#include "render/plot/graph_private.h"

/* In units of the label's font size. */
static const double cell_size = 0.18, word_air = 0.28;

double graph_air(const struct bead_look *look)
{
    return word_air * look->label;
}

static void sum(struct graph_mask *mask, const unsigned char *covered, size_t stride)
{
    size_t across = (size_t)mask->width + 1;
    for (size_t y = 0; y < (size_t)mask->height; y++) {
        unsigned row = 0;
        for (size_t x = 0; x < (size_t)mask->width; x++) {
            row += covered[y * stride + x] > 0;
            mask->sums[(y + 1) * across + x + 1] = mask->sums[y * across + x + 1] + row;
        }
    }
}

/* Draws the cell's contents at a small scale; every pixel touched is covered. */
enum bead_error graph_mask_make(const struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask,
                                struct bead_message *msg)
{
    double size = fmax(1, cell_size * look->label);
    *mask = (struct graph_mask){.width = (int)fmax(1, floor(cell->plot.width / size)),
                                .height = (int)fmax(1, floor(cell->plot.height / size)),
                                .cell = size,
                                .x = cell->plot.x,
                                .y = cell->plot.y};
    mask->sums = calloc(((size_t)mask->width + 1) * ((size_t)mask->height + 1), sizeof *mask->sums);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, mask->width, mask->height);
    cairo_t *cr = cairo_create(surface);
    cairo_scale(cr, 1 / size, 1 / size);
    cairo_translate(cr, -mask->x, -mask->y);
    struct graph_cell whole = *cell;
    whole.undashed = true;
    graph_draw_contents(cr, look, &whole);
    cairo_surface_flush(surface);
    const unsigned char *covered = cairo_image_surface_get_data(surface);
    bool drawn = mask->sums && covered && cairo_status(cr) == CAIRO_STATUS_SUCCESS;
    if (drawn)
        sum(mask, covered, (size_t)cairo_image_surface_get_stride(surface));
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    if (!drawn) {
        graph_mask_free(mask);
        return bead_fail(msg, BEAD_ERROR_MEMORY, "out of memory for the layout of a graph");
    }
    return BEAD_OK;
}

void graph_mask_free(struct graph_mask *mask)
{
    free(mask->sums);
    mask->sums = NULL;
}

/* Cells from..to (not included) that the box touches. */
static void cells_of(const struct graph_mask *mask, struct graph_box box, int from[2], int to[2])
{
    from[0] = (int)fmax(0, floor((box.x - mask->x) / mask->cell));
    from[1] = (int)fmax(0, floor((box.y - mask->y) / mask->cell));
    to[0] = (int)fmin(mask->width, ceil((box.x + box.width - mask->x) / mask->cell));
    to[1] = (int)fmin(mask->height, ceil((box.y + box.height - mask->y) / mask->cell));
}

unsigned graph_mask_covered(const struct graph_mask *mask, struct graph_box box)
{
    int from[2], to[2];
    size_t across = (size_t)mask->width + 1;
    if (box.x < mask->x || box.y < mask->y || box.x + box.width > mask->x + mask->width * mask->cell ||
        box.y + box.height > mask->y + mask->height * mask->cell)
        return 1u << 30;
    cells_of(mask, box, from, to);
    size_t x0 = (size_t)from[0], y0 = (size_t)from[1], x1 = (size_t)to[0], y1 = (size_t)to[1];
    return mask->sums[y1 * across + x1] + mask->sums[y0 * across + x0] - mask->sums[y0 * across + x1] -
           mask->sums[y1 * across + x0];
}

void graph_mask_cover(struct graph_mask *mask, struct graph_box box)
{
    int from[2], to[2];
    size_t across = (size_t)mask->width + 1;
    cells_of(mask, box, from, to);
    for (int y = from[1]; y < mask->height; y++) {
        for (int x = from[0]; x < mask->width; x++) {
            int rows = (y < to[1] ? y + 1 : to[1]) - from[1], columns = (x < to[0] ? x + 1 : to[0]) - from[0];
            if (rows > 0 && columns > 0) /* may count a cell twice, which does no harm */
                mask->sums[((size_t)y + 1) * across + (size_t)x + 1] += (unsigned)(rows * columns);
        }
    }
}

/* Places tried along a ruler. */
enum { ALONG = 24 };

/* The place, 0..1, that words beside a ruler keep away from: its line or, for a band without one, its end on this side, or the
 * middle if they fit into the band (*inside). */
static double reference(const struct graph_cell *cell, const struct bead_ruler *ruler, int side, double part, bool *inside)
{
    const double low = graph_ruler_place(cell, ruler, ruler->low), high = graph_ruler_place(cell, ruler, ruler->high);
    *inside = isnan(ruler->value) && high - low >= part;
    if (!isnan(ruler->value))
        return graph_ruler_place(cell, ruler, ruler->value);
    return *inside ? 0.5 * (low + high) : side == ruler->vertical ? high : low;
}

/* A box beside the ruler, on `side` 0 or 1, or in its band, at the fraction `way` along it (from the top, or from the right). */
static struct graph_box beside(const struct graph_cell *cell, const struct bead_look *look, const struct bead_ruler *ruler,
                               double width, double height, int side, double way)
{
    const struct bead_rect *plot = &cell->plot;
    double gap = graph_air(look) + 0.6 * look->line, inset = 0.6 * graph_air(look);
    bool inside;
    if (ruler->vertical) {
        double x = plot->x + reference(cell, ruler, side, (width + gap) / plot->width, &inside) * plot->width;
        return (struct graph_box){inside ? x - 0.5 * width
                                  : side ? x - gap - width
                                         : x + gap,
                                  plot->y + inset + way * (plot->height - height - 2 * inset), width, height};
    }
    double y = plot->y + (1 - reference(cell, ruler, side, height / plot->height, &inside)) * plot->height;
    return (struct graph_box){plot->x + plot->width - inset - width - way * (plot->width - width - 2 * inset),
                              inside ? y - 0.5 * height
                              : side ? y + gap
                                     : y - gap - height,
                              width, height};
}

/* Boxes of text have room above and below the letters, so only a part of the clear distance is kept there. */
static struct graph_box with_air(struct graph_box box, double air)
{
    return (struct graph_box){box.x - 0.8 * air, box.y - 0.3 * air, box.width + 1.6 * air, box.height + 0.6 * air};
}

/* False: there is no free room. */
static bool place_word(struct graph_word *word, const struct graph_cell *cell, const struct bead_look *look,
                       const struct bead_ruler *ruler, const struct graph_mask *mask)
{
    double width, height;
    struct bead_text_style style = graph_text(look);
    bead_text_size(NULL, &style, word->markup, &width, &height);
    for (int i = 0; i < 2 * ALONG; i++) {
        word->box = beside(cell, look, ruler, width, height, i % 2, (i / 2) / (ALONG - 1.0));
        if (graph_mask_covered(mask, with_air(word->box, graph_air(look))) == 0)
            return true;
    }
    return false;
}

bool graph_words_place(struct graph_cell *cell, const struct bead_look *look, struct graph_mask *mask)
{
    bool moved = false;
    for (size_t r = 0; r < cell->panel->ruler_count; r++) {
        struct graph_word *word = &cell->words[r];
        const struct bead_ruler *ruler = &cell->panel->rulers[r];
        const bool band = isnan(ruler->value); /* for which legends have no sign */
        double place = graph_ruler_place(cell, ruler, band ? 0.5 * (ruler->low + ruler->high) : ruler->value);
        if (!word->markup || !(place >= 0 && place <= 1)) {
            word->state = GRAPH_WORD_NONE;
            continue;
        }
        if (word->state == GRAPH_WORD_IN_LEGEND)
            continue;
        bool placed = place_word(word, cell, look, ruler, mask);
        word->state = placed ? GRAPH_WORD_PLACED : band ? GRAPH_WORD_NONE : GRAPH_WORD_IN_LEGEND;
        moved = moved || word->state == GRAPH_WORD_IN_LEGEND;
        if (placed)
            graph_mask_cover(mask, with_air(word->box, graph_air(look)));
    }
    return moved;
}
