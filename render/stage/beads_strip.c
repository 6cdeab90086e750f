/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of beads too small to be drawn: each column of pixels shows the exact mean of the field over its beads, as a colour over the
 * materials' colours, and the background in their gaps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/stage/beads.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"

/* The share of light that a ball reflects, compared with a flat square of its colour. */
static const double shading = 0.62;

/* The contents of one column of pixels. */
struct column {
    double cover, value; /* parts of the pixel; integral of the field over them */
};

/* Integral of the tent of half width `h` around 0, up to x; 0..1. */
static double tent(double x, double h)
{
    double part = fmin(1, fmax(-1, x / h));
    return part < 0 ? 0.5 * (1 + part) * (1 + part) : 1 - 0.5 * (1 - part) * (1 - part);
}

/* Averages materials over two beads on either side; without that, cells of two beads show moire against the pixels. */
bool bead_beads_prepare_strip(struct bead_view *v)
{
    size_t width = (size_t)v->plot.width;
    const double h = fmax(1, 2 * v->plot.width / (double)v->count);
    BEAD_FREED double *weight = calloc(width, sizeof *weight);
    v->base = calloc(width, sizeof *v->base);
    for (size_t i = 0; v->base && weight && i < v->count; i++) {
        const double *own = bead_chain_colour(v->setup.chain, v->first + i);
        double middle = bead_window_x(&v->row, v->position[i]) - (v->plot.x - v->area.x), r = v->radius[i] * v->row.scale;
        for (double x = fmax(0, floor(middle - r - h)); x < fmin((double)width, middle + r + h); x++) {
            double part = tent(middle + r - (x + 0.5), h) - tent(middle - r - (x + 0.5), h);
            for (int c = 0; c < 3; c++)
                v->base[(size_t)x][c] += part * own[c];
            weight[(size_t)x] += part;
        }
    }
    for (size_t x = 0; v->base && weight && x < width; x++) {
        for (int c = 0; c < 3; c++)
            v->base[x][c] *= weight[x] > 0 ? shading / weight[x] : 0;
    }
    return v->base && weight;
}

/* Beads count as blocks as wide as their diameter. */
static struct column find_column(const struct bead_view *v, double x, size_t *next)
{
    struct column column = {0, 0};
    for (size_t i = *next; i < v->count; i++) {
        double middle = bead_window_x(&v->row, v->position[i] + v->shift[i]), r = v->radius[i] * v->row.scale;
        if (middle - r > x + 1)
            break;
        if (i == *next && middle + r < x)
            ++*next;
        double part = fmin(middle + r, x + 1) - fmax(middle - r, x);
        if (part <= 0)
            continue;
        column.cover += part;
        column.value += part * v->shown[i];
    }
    return column;
}

/* Colour of a column's beads, 0..1. */
static void find_colour(const struct bead_view *v, const struct column *column, const double base[3], double rgb[3])
{
    double mean = column->cover > 0 ? column->value / column->cover : 0, weight = bead_colour_weight(v, mean);
    const uint8_t *field = v->map.rgb[bead_colours_index(&v->setup.colours, mean)];
    for (int c = 0; c < 3; c++)
        rgb[c] = (1 - weight) * fmin(1, fmax(0, base[c])) + weight * field[c] / 255.0;
}

/* True if column x of the frame has changed. */
static bool paint_column(const struct bead_view *v, int x, double cover, const double rgb[3], struct bead_frame *frame,
                         const struct bead_frame *background)
{
    int top = v->area.y + v->row.rect.y, bottom = top + v->row.rect.height;
    bool changed = false;
    for (int y = top; y < bottom; y++) {
        size_t at = (size_t)y * frame->stride + 4 * (size_t)x;
        uint8_t pixel[4];
        for (int c = 0; c < 4; c++)
            pixel[c] = (uint8_t)lround((1 - cover) * background->pixels[at + (size_t)c] + cover * 255 * (c < 3 ? rgb[2 - c] : 1));
        changed = changed || memcmp(pixel, frame->pixels + at, frame->alpha ? 4 : 3) != 0;
        memcpy(frame->pixels + at, pixel, 4);
    }
    return changed;
}

void bead_beads_strip(struct bead_view *v, struct bead_frame *frame, const struct bead_frame *background,
                      struct bead_changes *changes)
{
    int from = frame->width, to = -1;
    size_t next = 0;
    for (int i = 0; i < v->plot.width; i++) {
        int x = v->plot.x + i;
        struct column column = find_column(v, x - v->area.x, &next);
        double rgb[3];
        find_colour(v, &column, v->base[i], rgb);
        if (paint_column(v, x, fmin(1, column.cover), rgb, frame, background)) {
            from = x < from ? x : from;
            to = x;
        }
    }
    if (to >= from)
        bead_changes_add(changes, (struct bead_rect){from, v->area.y + v->row.rect.y, to - from + 1, v->row.rect.height});
}
