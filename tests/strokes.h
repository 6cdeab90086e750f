/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strokes and fills through cairo, as numbers: a program that includes this has its own versions of these functions in front of the
 * library's, which record the path in pixels of the surface and then draw as usual. */
#ifndef BEADREEL_TESTS_STROKES_H
#define BEADREEL_TESTS_STROKES_H

#include <cairo.h>
#include <dlfcn.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "beadreel/view.h"

enum { STROKES_MOST = 40000, STROKE_POINTS_MOST = 800000 };

/* One path. A point is where a line goes, or begins; a curve gives its end. */
struct stroke {
    bool filled, closed; /* closed: its last part ends where it begins */
    cairo_surface_type_t surface;
    double width, rgb[3], dash[6], dash_offset;
    int dashes;
    cairo_line_join_t join;
    size_t count, begun; /* points, parts that begin anew */
    const struct stroke_point {
        double x, y;
        bool begins;
    } * at;
    double low[2], high[2];           /* of its points */
    double clip_low[2], clip_high[2]; /* nothing is drawn beyond */
};

static struct strokes {
    bool on;
    size_t count, points;
    struct stroke list[STROKES_MOST];
    struct stroke_point at[STROKE_POINTS_MOST];
} strokes;

static void strokes_begin(void)
{
    strokes.on = true;
    strokes.count = strokes.points = 0;
}

static void strokes_take(struct stroke *s, cairo_t *cr, const cairo_path_data_t *data)
{
    const int type = data->header.type, last = data->header.length - 1;
    s->closed = type == CAIRO_PATH_CLOSE_PATH;
    if (type == CAIRO_PATH_CLOSE_PATH)
        return;
    struct stroke_point *p = &strokes.at[strokes.points++];
    assert_true(strokes.points < STROKE_POINTS_MOST);
    *p = (struct stroke_point){data[last].point.x, data[last].point.y, type == CAIRO_PATH_MOVE_TO};
    cairo_user_to_device(cr, &p->x, &p->y);
    s->low[0] = fmin(s->low[0], p->x);
    s->low[1] = fmin(s->low[1], p->y);
    s->high[0] = fmax(s->high[0], p->x);
    s->high[1] = fmax(s->high[1], p->y);
    s->begun += p->begins;
    s->count++;
}

static void strokes_note(cairo_t *cr, bool filled)
{
    double alpha, unit = 1, none = 0;
    if (!strokes.on)
        return;
    assert_true(strokes.count < STROKES_MOST);
    struct stroke *s = &strokes.list[strokes.count];
    cairo_user_to_device_distance(cr, &unit, &none);
    *s = (struct stroke){.filled = filled,
                         .surface = cairo_surface_get_type(cairo_get_target(cr)),
                         .width = cairo_get_line_width(cr) * hypot(unit, none),
                         .dashes = cairo_get_dash_count(cr),
                         .join = cairo_get_line_join(cr),
                         .at = &strokes.at[strokes.points],
                         .low = {INFINITY, INFINITY},
                         .high = {-INFINITY, -INFINITY}};
    if (s->dashes > 0 && s->dashes <= 6)
        cairo_get_dash(cr, s->dash, &s->dash_offset);
    (void)cairo_pattern_get_rgba(cairo_get_source(cr), &s->rgb[0], &s->rgb[1], &s->rgb[2], &alpha);
    cairo_clip_extents(cr, &s->clip_low[0], &s->clip_low[1], &s->clip_high[0], &s->clip_high[1]);
    cairo_user_to_device(cr, &s->clip_low[0], &s->clip_low[1]);
    cairo_user_to_device(cr, &s->clip_high[0], &s->clip_high[1]);
    cairo_path_t *path = cairo_copy_path(cr);
    for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
        const bool trails = path->data[i].header.type == CAIRO_PATH_MOVE_TO && i + path->data[i].header.length == path->num_data;
        if (!trails) /* a closed path ends with a new beginning */
            strokes_take(s, cr, &path->data[i]);
    }
    cairo_path_destroy(path);
    strokes.count += s->count > 0;
}

#define STROKES_INSTEAD(function, filled)                  \
    void function(cairo_t *cr)                             \
    {                                                      \
        static void (*next)(cairo_t *);                    \
        if (!next)                                         \
            *(void **)&next = dlsym(RTLD_NEXT, #function); \
        strokes_note(cr, filled);                          \
        next(cr);                                          \
    }
STROKES_INSTEAD(cairo_stroke, false)
STROKES_INSTEAD(cairo_stroke_preserve, false)
STROKES_INSTEAD(cairo_fill, true)
STROKES_INSTEAD(cairo_fill_preserve, true)

static inline bool stroke_has(const struct stroke *s, bool filled, struct bead_rgb ink)
{
    return s->filled == filled && fabs(s->rgb[0] - ink.r) < 1e-4 && fabs(s->rgb[1] - ink.g) < 1e-4 &&
           fabs(s->rgb[2] - ink.b) < 1e-4;
}

#define assert_at(got, expected)                                                                \
    do {                                                                                        \
        const double at_got = (got), at_expected = (expected);                                  \
        if (!(fabs(at_got - at_expected) < 0.02)) /* paths have 256 places in a pixel */        \
            fail_msg("%s:%d: %s is %g, not %g", __FILE__, __LINE__, #got, at_got, at_expected); \
    } while (0)

static inline void assert_bounds(const struct stroke *s, double left, double top, double right, double bottom)
{
    if (fabs(s->low[0] - left) > 0.02 || fabs(s->low[1] - top) > 0.02 || fabs(s->high[0] - right) > 0.02 ||
        fabs(s->high[1] - bottom) > 0.02)
        fail_msg("reaches from %g, %g to %g, %g, not from %g, %g to %g, %g", s->low[0], s->low[1], s->high[0], s->high[1], left,
                 top, right, bottom);
}

#endif
