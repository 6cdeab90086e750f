/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planes as images: see sweep_plot.h. */
#include "render/plot/sweep_plot.h"

#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"

/* Finer than the pixels of most pictures. */
enum { COLUMNS = 1024, ROWS = 1024 };

static int by_place(const void *a, const void *b)
{
    const struct bead_plane_point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

static double along(enum bead_scale scale, double value)
{
    return scale == BEAD_SCALE_LOG ? log(value) : value;
}

static double back(enum bead_scale scale, double place)
{
    return scale == BEAD_SCALE_LOG ? exp(place) : place;
}

/* Points of one x, from `first`. */
static size_t alike(const struct bead_plane_point *points, size_t count, size_t first)
{
    size_t end = first;
    while (end < count && points[end].x == points[first].x)
        end++;
    return end - first;
}

/* Widens a range to half a step beyond its first and last place. A single place has width 1. */
static void widen(double ends[2], const double *places, size_t count)
{
    const double low = count > 1 ? places[1] - places[0] : 1, high = count > 1 ? places[count - 1] - places[count - 2] : 1;
    ends[0] = fmin(ends[0], places[0] - low / 2);
    ends[1] = fmax(ends[1], places[count - 1] + high / 2);
}

/* The nearest of ascending places. */
static size_t nearest(const double *places, size_t count, double at)
{
    size_t i = 0;
    while (i + 1 < count && at > (places[i] + places[i + 1]) / 2)
        i++;
    return i;
}

/* The places of the points on the axes: [columns] of x, and [count] of y. */
struct places {
    double *x, *y;
    size_t *first; /* [columns + 1] points of each */
    size_t columns;
};

static enum bead_error find_places(const struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                   struct places *places, double ends[2][2], struct bead_message *msg)
{
    *places = (struct places){.columns = 0};
    BEAD_TRY(bead_new(&places->x, 2 * count + 1, msg, "a plane"));
    BEAD_TRY(bead_new(&places->first, count + 1, msg, "a plane"));
    places->y = places->x + count;
    for (size_t k = 0; k < 2; k++) {
        ends[k][0] = INFINITY;
        ends[k][1] = -INFINITY;
    }
    for (size_t i = 0, n; i < count; i += n) {
        n = alike(points, count, i);
        places->x[places->columns] = along(scales[0], points[i].x);
        for (size_t k = i; k < i + n; k++)
            places->y[k] = along(scales[1], points[k].y);
        widen(ends[1], places->y + i, n);
        places->first[++places->columns] = i + n;
    }
    widen(ends[0], places->x, places->columns);
    return BEAD_OK;
}

static void fill(const struct bead_plane_point *points, const struct places *places, double ends[2][2], double *values)
{
    for (size_t c = 0; c < COLUMNS; c++) {
        const double x = ends[0][0] + ((double)c + 0.5) / COLUMNS * (ends[0][1] - ends[0][0]);
        const size_t column = nearest(places->x, places->columns, x), first = places->first[column];
        for (size_t r = 0; r < ROWS; r++) {
            const double y = ends[1][0] + ((double)r + 0.5) / ROWS * (ends[1][1] - ends[1][0]);
            values[c * ROWS + r] = points[first + nearest(places->y + first, places->first[column + 1] - first, y)].value;
        }
    }
}

enum bead_error bead_plane_make(struct bead_plane_point *points, size_t count, const enum bead_scale scales[2],
                                struct bead_graph_image *image, double ends[2][2], struct bead_message *msg)
{
    struct places places;
    double *values = NULL;
    qsort(points, count, sizeof *points, by_place);
    enum bead_error err = find_places(points, count, scales, &places, ends, msg);
    if (!err)
        err = bead_new(&values, (size_t)COLUMNS * ROWS, msg, "a plane");
    if (!err) {
        fill(points, &places, ends, values);
        *image = (struct bead_graph_image){.columns = COLUMNS, .rows = ROWS, .values = values, .low = INFINITY, .high = -INFINITY};
        for (size_t i = 0; i < count; i++) {
            image->low = fmin(image->low, points[i].value);
            image->high = fmax(image->high, points[i].value);
        }
        for (size_t k = 0; k < 2; k++) {
            double *middle = k ? image->y : image->x;
            const double half = (ends[k][1] - ends[k][0]) / (2 * (k ? ROWS : COLUMNS));
            middle[0] = back(scales[k], ends[k][0] + half);
            middle[1] = back(scales[k], ends[k][1] - half);
            ends[k][0] = back(scales[k], ends[k][0]);
            ends[k][1] = back(scales[k], ends[k][1]);
        }
    }
    free(places.x);
    free(places.first);
    return err;
}
