/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values as colours in a plot's frame, and the bar beside it. */
#include <math.h>
#include <stdlib.h>

#include "render/draw/raster.h"
#include "render/plot/graph_private.h"
#include "sim/base/memory.h"

static const double bar_gap = 0.9; /* in units of the label's font size, as beside images */

static struct bead_rect bar_of(const struct bead_look *look, const struct graph_cell *cell)
{
    return (struct bead_rect){cell->plot.x + cell->plot.width + (int)lround(bar_gap * look->label), cell->plot.y,
                              (int)lround(bead_colour_bar_width(look, BEAD_BAR_OF_FIGURE)), cell->plot.height};
}

static enum bead_error load(const struct bead_look *look, struct bead_colormap *map, struct bead_message *msg)
{
    return bead_colormap_load(look->dark ? "inferno" : "ember", map, msg);
}

static struct bead_colours colours_of(const struct bead_graph_image *image, const struct bead_colormap *map)
{
    return (struct bead_colours){map, BEAD_SCALE_LINEAR, image->low, image->high, 0};
}

double graph_image_reach(const struct bead_look *look, const struct graph_cell *cell)
{
    const struct bead_graph_image *image = cell->panel->image;
    if (!image)
        return 0;
    const struct bead_rect bar = bar_of(look, cell);
    const struct bead_colours colours = colours_of(image, NULL);
    return bar.x + bar.width - cell->plot.x - cell->plot.width +
           bead_colour_bar_draw(NULL, look, &colours, image->unit, image->title, bar, false, false);
}

/* The columns, or rows, that a pixel between two places shows: those with their middles in it, or the nearest. */
static void span_of(const double axis[2], const double ends[2], size_t count, double from, double to, size_t span[2])
{
    const double per = (double)(count - 1) / (ends[1] - ends[0]);
    const double a = (axis[0] + from * (axis[1] - axis[0]) - ends[0]) * per,
                 b = (axis[0] + to * (axis[1] - axis[0]) - ends[0]) * per, first = ceil(a), last = ceil(b) - 1,
                 nearest = round((a + b) / 2), most = (double)(count - 1);
    span[0] = (size_t)fmin(most, fmax(0, first <= last ? first : nearest));
    span[1] = (size_t)fmin(most, fmax(0, first <= last ? last : nearest));
}

static double largest(const struct bead_graph_image *image, const size_t columns[2], const size_t rows[2])
{
    double most = -INFINITY;
    for (size_t c = columns[0]; c <= columns[1]; c++) {
        for (size_t r = rows[0]; r <= rows[1]; r++)
            most = fmax(most, image->values[c * image->rows + r]);
    }
    return most;
}

/* Two values of an axis, where they are along it. */
static void places_on(const struct bead_graph_axis *axis, const double values[2], double places[2])
{
    for (size_t i = 0; i < 2; i++)
        places[i] = axis->scale == BEAD_SCALE_LOG ? log(values[i]) : values[i];
}

static void fill(const struct graph_cell *cell, const struct bead_colours *colours, uint8_t *indices)
{
    const struct bead_graph_image *image = cell->panel->image;
    const double w = cell->plot.width, h = cell->plot.height;
    double x[2], y[2], across[2], up[2];
    places_on(&cell->panel->x, (const double[]){cell->low[0], cell->high[0]}, x);
    places_on(&cell->panel->y, (const double[]){cell->low[1], cell->high[1]}, y);
    places_on(&cell->panel->x, image->x, across);
    places_on(&cell->panel->y, image->y, up);
    for (int j = 0; j < cell->plot.height; j++) {
        size_t rows[2], columns[2];
        span_of(y, up, image->rows, 1 - (j + 1) / h, 1 - j / h, rows);
        for (int i = 0; i < cell->plot.width; i++) {
            span_of(x, across, image->columns, i / w, (i + 1) / w, columns);
            indices[(size_t)j * (size_t)cell->plot.width + (size_t)i] = bead_colours_index(colours, largest(image, columns, rows));
        }
    }
}

enum bead_error graph_draw_image(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, struct bead_message *msg)
{
    const struct bead_graph_image *image = cell->panel->image;
    BEAD_FREED uint8_t *indices = NULL;
    struct bead_colormap map;
    if (!image)
        return BEAD_OK;
    BEAD_TRY(load(look, &map, msg));
    const struct bead_colours colours = colours_of(image, &map);
    BEAD_TRY(bead_new(&indices, (size_t)cell->plot.width * (size_t)cell->plot.height, msg, "an image"));
    fill(cell, &colours, indices);
    return bead_raster_indices(cr, cell->plot, indices, &map, msg);
}

enum bead_error graph_draw_bar(cairo_t *cr, const struct bead_look *look, const struct graph_cell *cell, struct bead_message *msg)
{
    const struct bead_graph_image *image = cell->panel->image;
    struct bead_colormap map;
    if (!image)
        return BEAD_OK;
    BEAD_TRY(load(look, &map, msg));
    const struct bead_colours colours = colours_of(image, &map);
    bead_colour_bar_draw(cr, look, &colours, image->unit, image->title, bar_of(look, cell), false, false);
    return BEAD_OK;
}
