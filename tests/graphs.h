/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the tests of graphs: made-up curves, a picture in memory. */
#ifndef BEADREEL_TESTS_GRAPHS_H
#define BEADREEL_TESTS_GRAPHS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "pictures.h"
#include "render/draw/markup.h"
#include "render/plot/graph_private.h"

enum { N = 21, CURVES = 7 };

/* Seven curves with error bars that cross each other. */
struct data {
    double x[N], y[CURVES][N], error[N];
    char labels[CURVES][64];
    struct bead_series series[CURVES];
};

static inline void make_data(struct data *d)
{
    memset(d, 0, sizeof *d);
    for (int i = 0; i < N; i++) {
        d->x[i] = i / 20.0;
        d->error[i] = 0.4 + 0.3 * sin(i);
        for (int k = 0; k < CURVES; k++)
            d->y[k][i] = 20 - 10 * d->x[i] + 6 * d->x[i] * d->x[i] + 3 * k + 2 * sin(3 * i + k);
    }
    for (size_t k = 0; k < CURVES; k++) {
        snprintf(d->labels[k], sizeof d->labels[k], "*N*_{total} = %d, configuration %d", 16 << k, (int)k);
        d->series[k] = (struct bead_series){.x = d->x,
                                            .y = d->y[k],
                                            .error = k < 3 ? d->error : NULL,
                                            .count = N,
                                            .mark = BEAD_MARK_LINE_POINTS,
                                            .colour = k,
                                            .shape = k,
                                            .label = d->labels[k]};
    }
}

static inline struct bead_panel make_panel(const struct data *d, size_t curves)
{
    return (struct bead_panel){.x = {"magnetism *M*", "", NAN, NAN, BEAD_SCALE_LINEAR, false},
                               .y = {"peak force *F*_m", "N", NAN, NAN, BEAD_SCALE_LINEAR, true},
                               .series = d->series,
                               .series_count = curves};
}

struct canvas {
    cairo_surface_t *surface;
    cairo_t *cr;
    int width, height;
};

static inline struct canvas make_canvas(int width, int height)
{
    struct canvas c = {cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), NULL, width, height};
    c.cr = cairo_create(c.surface);
    return c;
}

static inline void free_canvas(struct canvas *c)
{
    cairo_destroy(c->cr);
    cairo_surface_destroy(c->surface);
}

static inline uint32_t pixel(const struct canvas *c, int x, int y)
{
    const unsigned char *row =
        cairo_image_surface_get_data(c->surface) + (size_t)y * (size_t)cairo_image_surface_get_stride(c->surface);
    uint32_t value;
    memcpy(&value, row + 4 * (size_t)x, 4);
    return value & 0xFFFFFF;
}

static inline uint32_t packed(struct bead_rgb colour)
{
    return (uint32_t)lround(255 * colour.r) << 16 | (uint32_t)lround(255 * colour.g) << 8 | (uint32_t)lround(255 * colour.b);
}

static inline bool near(uint32_t a, uint32_t b)
{
    int apart = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        int difference = abs((int)(a >> shift & 255) - (int)(b >> shift & 255));
        apart = difference > apart ? difference : apart;
    }
    return apart <= 2;
}

static inline void draw(const struct bead_graph *graph, const struct bead_look *look, struct canvas *c)
{
    struct bead_message msg = {""};
    if (bead_graph_draw(graph, look, c->cr, c->width, c->height, &msg))
        fail_msg("%s", msg.text);
    cairo_surface_flush(c->surface);
}

static inline struct graph_layout lay_out(const struct bead_graph *graph, const struct bead_look *look, double width, double height)
{
    struct bead_message msg = {""};
    struct graph_layout layout;
    if (graph_layout_make(graph, look, width, height, NULL, &layout, &msg))
        fail_msg("%s", msg.text);
    return layout;
}

#endif
