/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of curves at the right ends of their lines, in the lines' colours: instead of a legend, if every line ends at the frame and
 * no two end in one place. */
#include <math.h>

#include "render/plot/graph_private.h"

/* In units of the label's font size: from frame to name, and the greatest distance of a line's end from the frame (axes with marks
 * are wider than their lines). */
static const double gap = 0.45, farthest = 2.5;
/* The largest part of a panel's share of the page that names may take. */
static const double widest_names = 0.2;
/* As a part of the lines' heights: names closer than this touch; below 1, because few letters fill their line. */
static const double closest = 0.85;

static void size_of(const struct graph_cell *cell, const struct bead_look *look, size_t s, double *width, double *height)
{
    struct bead_text_style style = graph_text(look);
    bead_text_size(NULL, &style, cell->labels[s], width, height);
}

/* Is there a line with the same name elsewhere? One entry of a legend explains both. */
static bool is_shared(const struct graph_layout *l, size_t p, size_t s)
{
    const struct bead_series *series = &l->graph->panels[p].series[s];
    for (size_t q = 0; q < l->graph->panel_count; q++) {
        for (size_t i = 0; i < l->graph->panels[q].series_count; i++) {
            if ((q != p || i != s) && l->cells[q].labels[i] && strcmp(l->cells[q].labels[i], l->cells[p].labels[s]) == 0 &&
                graph_look_alike(&l->graph->panels[q].series[i], series))
                return true;
        }
    }
    return false;
}

double graph_ends_reach(const struct graph_cell *cell, const struct bead_look *look)
{
    double widest = 0, width, height;
    for (size_t s = 0; cell->ends && s < cell->panel->series_count; s++) {
        if (!cell->labels[s])
            continue;
        size_of(cell, look, s, &width, &height);
        widest = fmax(widest, width);
    }
    return widest > 0 ? ceil(widest + gap * look->label) : 0;
}

bool graph_ends_wanted(const struct graph_layout *l, size_t p)
{
    struct graph_cell named = l->cells[p];
    const struct bead_panel *panel = named.panel;
    named.ends = true;
    if (l->part || panel->image)
        return false;
    for (size_t s = 0; s < panel->series_count; s++) {
        const struct bead_series *series = &panel->series[s];
        const bool line = series->mark == BEAD_MARK_LINE || series->mark == BEAD_MARK_LINE_POINTS;
        if (named.labels[s] && (!line || series->faint || is_shared(l, p, s)))
            return false;
    }
    const double reach = graph_ends_reach(&named, l->look);
    return reach > 0 && reach <= widest_names * l->width / (double)l->columns;
}

/* The middle of a name: level with its line's end, within the frame. */
static double middle_of(const struct graph_cell *cell, double end, double height)
{
    return fmax(cell->plot.y + height / 2, fmin(cell->plot.y + cell->plot.height - height / 2, end));
}

bool graph_ends_fit(const struct graph_cell *cell, const struct bead_look *look)
{
    for (size_t s = 0; s < cell->panel->series_count; s++) {
        double end[2], width, height;
        if (!cell->labels[s])
            continue;
        if (!graph_series_end(cell, &cell->panel->series[s], end) ||
            cell->plot.x + cell->plot.width - end[0] > farthest * look->label)
            return false;
        size_of(cell, look, s, &width, &height);
        for (size_t i = 0; i < s; i++) {
            double other[2], above;
            if (!cell->labels[i] || !graph_series_end(cell, &cell->panel->series[i], other))
                continue;
            size_of(cell, look, i, &width, &above);
            if (fabs(middle_of(cell, end[1], height) - middle_of(cell, other[1], above)) < closest * (height + above) / 2)
                return false;
        }
    }
    return true;
}

void graph_ends_draw(const struct graph_cell *cell, const struct bead_look *look, cairo_t *cr)
{
    struct bead_text_style style = graph_text(look);
    style.down = BEAD_ALIGN_MIDDLE;
    for (size_t s = 0; cell->ends && s < cell->panel->series_count; s++) {
        double end[2], width, height;
        if (!cell->labels[s] || !graph_series_end(cell, &cell->panel->series[s], end))
            continue;
        size_of(cell, look, s, &width, &height);
        style.colour = bead_look_curve(look, cell->panel->series[s].colour);
        bead_text_draw(cr, &style, cell->plot.x + cell->plot.width + gap * look->label, middle_of(cell, end[1], height),
                       cell->labels[s]);
    }
}
