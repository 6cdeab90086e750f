/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the time from which two runs differ visibly at each bead, and draws the line through these times. Used by pictures with
 * `trust`. */
#include "render/view/horizon.h"
#include "sim/base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

/* In widths of axis lines: the line itself, and its dark edges that make it visible on bright colours. */
static const double core = 1, seam = 3;

struct bead_horizon {
    struct bead_area_setup setup; /* places: beads, or pixels if these are fewer */
    struct bead_area *area;       /* of the difference */
    double *difference;           /* [last bead + 1] */
    double *means;                /* [places] */
    int *first;                   /* [places]: column; INT_MAX: none yet */
    int done, earliest;           /* columns */
};

enum bead_error bead_horizon_create(const struct bead_area_setup *setup, struct bead_horizon **horizon, struct bead_message *msg)
{
    BEAD_TRY(bead_new(horizon, 1, msg, "a horizon"));
    struct bead_horizon *h = *horizon;
    size_t beads = setup->beads.last - setup->beads.first + 1;
    h->setup = *setup;
    h->setup.places = beads < (size_t)setup->places ? (int)beads : setup->places;
    h->earliest = INT_MAX;
    BEAD_TRY(bead_new(&h->difference, setup->beads.last + 1, msg, "a horizon"));
    BEAD_TRY(bead_new(&h->means, (size_t)h->setup.places, msg, "a horizon"));
    BEAD_TRY(bead_new(&h->first, (size_t)h->setup.places, msg, "a horizon"));
    for (int p = 0; p < h->setup.places; p++)
        h->first[p] = INT_MAX;
    return bead_area_create(&h->setup, &h->area, msg);
}

void bead_horizon_destroy(struct bead_horizon *horizon)
{
    if (!horizon)
        return;
    bead_area_destroy(horizon->area);
    free(horizon->difference);
    free(horizon->means);
    free(horizon->first);
    free(horizon);
}

void bead_horizon_feed(struct bead_horizon *h, double time, const double *first, const double *second, size_t active)
{
    size_t end = active <= h->setup.beads.last ? active : h->setup.beads.last + 1;
    for (size_t j = h->setup.beads.first; j < end; j++)
        h->difference[j] = first[j] - second[j];
    bead_area_feed(h->area, time, h->difference, active); /* means of differences are differences of means */
}

/* Neighbours considered on each side: a single quiet bead makes no spike in the line. */
static int neighbours(const struct bead_horizon *h)
{
    return 1 + h->setup.places / 48;
}

/* The earliest column of this place and `side` neighbours on each side. */
static int earliest_near(const struct bead_horizon *h, int place, int side)
{
    int earliest = INT_MAX, last = place + side;
    for (int p = place > side ? place - side : 0; p <= last && p < h->setup.places; p++)
        earliest = h->first[p] < earliest ? h->first[p] : earliest;
    return earliest;
}

/* Column of the line at a place. */
static int line_at(const struct bead_horizon *h, int place)
{
    return earliest_near(h, place, neighbours(h));
}

/* The first column where the line changes when a place gets its horizon, which moves its neighbours' points and the lines to
 * them. */
static int changed_from(const struct bead_horizon *h, int place)
{
    return earliest_near(h, place, 2 * neighbours(h) + 1);
}

int bead_horizon_find(struct bead_horizon *h, double threshold, int to)
{
    int changed = INT_MAX;
    for (int c = h->done; c < to; c++) {
        if (!bead_area_column(h->area, c, h->means))
            continue;
        for (int p = 0; p < h->setup.places; p++) {
            if (h->first[p] < INT_MAX || !(fabs(h->means[p]) > threshold))
                continue;
            h->first[p] = c;
            h->earliest = c < h->earliest ? c : h->earliest;
            int from = changed_from(h, p);
            changed = from < changed ? from : changed;
        }
    }
    h->done = to > h->done ? to : h->done;
    return changed;
}

double bead_horizon_time(const struct bead_horizon *h)
{
    const double *time = h->setup.time;
    return h->earliest == INT_MAX ? INFINITY : time[0] + (time[1] - time[0]) * h->earliest / h->setup.columns;
}

double bead_horizon_reach(const struct bead_look *look)
{
    return seam * look->line / 2;
}

void bead_horizon_stroke(cairo_t *cr, const struct bead_look *look)
{
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_source_rgb(cr, 0.08, 0.08, 0.1);
    cairo_set_line_width(cr, seam * look->line);
    cairo_stroke_preserve(cr);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_set_line_width(cr, core * look->line);
    cairo_stroke(cr);
}

/* Adds a point of the line: `place` and `time` from 0 to 1 along the chain and in the image. */
static void horizon_add_point(cairo_t *cr, struct bead_rect plot, enum bead_orientation lies, double place, double time, bool begin)
{
    double x = plot.x + plot.width * (lies == BEAD_TIME_DOWN ? place : time);
    double y = plot.y + plot.height * (lies == BEAD_TIME_DOWN ? time : lies == BEAD_MATRIX ? place : 1 - place);
    if (begin)
        cairo_move_to(cr, x, y);
    else
        cairo_line_to(cr, x, y);
}

void bead_horizon_draw(const struct bead_horizon *h, cairo_t *cr, const struct bead_look *look, struct bead_rect plot,
                       enum bead_orientation orientation, bool closed)
{
    int places = h->setup.places;
    bool drawing = false;
    if (h->earliest == INT_MAX)
        return;
    cairo_save(cr);
    cairo_rectangle(cr, plot.x, plot.y, plot.width, plot.height);
    cairo_clip(cr);
    cairo_new_path(cr);
    for (int p = 0; p < places; p++) {
        int column = line_at(h, p);
        double reach = 2 * bead_horizon_reach(look); /* beyond the end, invisible */
        double beyond = 1 + reach / (orientation == BEAD_TIME_DOWN ? plot.height : plot.width);
        double end = column < INT_MAX ? (double)column / h->setup.columns : beyond;
        if (column == INT_MAX && !closed) {
            drawing = false;
            continue;
        }
        if (p == 0 || !drawing) /* from the edge of the chain, or of the bead */
            horizon_add_point(cr, plot, orientation, (double)p / places, end, true);
        horizon_add_point(cr, plot, orientation, (p + 0.5) / places, end, false);
        if (p + 1 == places)
            horizon_add_point(cr, plot, orientation, 1, end, false);
        drawing = true;
    }
    bead_horizon_stroke(cr, look);
    cairo_restore(cr);
}
